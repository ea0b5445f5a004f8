"""What the joint level asks of a muscle: its moment about the elbow, and the derivatives of that.

Anything that answers these calls is a muscle: a table of finite-element states, or published forces times a lever
arm. All speak of the same function M(angle, activation), twice continuously differentiable inside its range.

A muscle may also offer `curve(activation)`, its moment over the angle alone, prepared for many values (`SplineMoment`
does). The search for an equilibrium uses it where it is there; without it the search is right but ten times slower.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float


@runtime_checkable
class MomentCurve(Protocol):
    """Moment [N*mm] over the angle [rad] at one activation."""

    def __call__(self, angles: Float[np.ndarray, " points"], /) -> Float[np.ndarray, " points"]:
        """Moments at many angles."""
        ...

    def at(self, angle: float, /) -> float:
        """Moment at one angle."""
        ...


@runtime_checkable
class MuscleMoment(Protocol):
    """One muscle's moment about the elbow [N*mm]; positive flexes."""

    def moment(self, angles: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad], all at one activation [-].

        Raises InputError for an angle or an activation outside the muscle's range.
        """
        ...

    def moment_gradient(self, angle: float, activation: float) -> tuple[float, float, float]:
        """M [N*mm], dM/dangle [N*mm/rad] and dM/dactivation [N*mm]: exact derivatives of `moment`."""
        ...


@dataclass(frozen=True)
class PlainCurve:
    """The curve of a muscle that offers none."""

    moment: Callable[[Float[np.ndarray, " points"], float], Float[np.ndarray, " points"]]
    activation: float

    def __call__(self, angles: Float[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad]."""
        return self.moment(angles, self.activation)

    def at(self, angle: float) -> float:
        """Moment [N*mm] at one angle [rad]."""
        return float(self.moment(np.array([angle]), self.activation)[0])


def curve_of(muscle: MuscleMoment, activation: float) -> MomentCurve:
    """The muscle's own curve at this activation, or one made of its `moment`."""
    own = getattr(muscle, "curve", None)
    return PlainCurve(muscle.moment, activation) if own is None else own(activation)
