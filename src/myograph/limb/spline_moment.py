"""A muscle's moment as one spline over (angle, activation), prepared for the search of equilibria."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from myograph.interpolation import Interpolant
from myograph.interpolation.section import Section, Sections


class SplineMoment:
    """A `MuscleMoment` from an interpolant over (angle [rad], activation) with one component [N*mm].

    Parameters
    ----------
    breaks
        Where the polynomials of its curves shall meet, too, in [0, 1] of the range of angles.

    Raises InputError for an interpolant of another number of coordinates or components.
    """

    def __init__(self, interpolant: Interpolant, breaks: Float[np.ndarray, " breaks"] | None = None) -> None:
        self.interpolant = interpolant
        self._sections = Sections(interpolant, breaks)

    def moment(self, angles: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad]; raises InputError outside the spline's range."""
        return self.curve(activation)(angles)

    def moment_gradient(self, angle: float, activation: float) -> tuple[float, float, float]:
        """M [N*mm], dM/dangle [N*mm/rad] and dM/dactivation [N*mm]."""
        here = self.curve(activation)
        return here.at(angle), here.slope(angle), self._sections.held(activation, derivative=1).at(angle)

    def curve(self, activation: float) -> Section:
        """The moment over the angle alone."""
        return self._sections.held(activation)

    @property
    def breaks(self) -> Float[np.ndarray, " breaks"]:
        """Where the polynomials of its curves meet, in (0, 1) of the range of angles."""
        return self._sections.breaks


def on_common_breaks(moments: Mapping[str, SplineMoment]) -> dict[str, SplineMoment]:
    """The same moments, whose curves add up to one piecewise polynomial; all have the same range of angles."""
    breaks = np.concatenate([moment.breaks for moment in moments.values()])
    return {name: SplineMoment(moment.interpolant, breaks) for name, moment in moments.items()}
