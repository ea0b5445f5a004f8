"""A muscle's moment as one spline over (angle, activation), prepared for the search of equilibria."""

from functools import cached_property

import numpy as np
from jaxtyping import Float

from myograph.interpolation import Interpolant
from myograph.interpolation.section import Section, Sections


class SplineMoment:
    """A `MuscleMoment` from an interpolant over (angle [rad], activation) with one component [N*mm].

    Raises InputError for an interpolant of another number of coordinates or components.
    """

    def __init__(self, interpolant: Interpolant) -> None:
        self.interpolant = interpolant
        _ = self._sections

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

    @cached_property
    def _sections(self) -> Sections:
        return Sections(self.interpolant)
