r"""The joint level: muscles about one elbow, a weight in the hand, and where all of it comes to rest.

Net moment  M(θ, a) = Σ_i M_i(θ, a_i) + M_outside(θ, weight);  equilibrium where M = 0, stable where ∂M/∂θ < 0.
Along a branch of equilibria dθ/da_i = -(∂M_i/∂a_i) / (∂M/∂θ).
Convention: positive moments flex, N*mm; angles in rad, 0 = straight. The muscles are independent given the angle.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm
from myograph.case import check_activation
from myograph.errors import InputError
from myograph.interpolation.section import Section
from myograph.limb.equilibrium import Equilibrium, equilibria
from myograph.limb.moment import MomentCurve, MuscleMoment, curve_of
from myograph.limb.moments import OutsideMoment, WeightsAndStops
from myograph.units import degrees, newton_metres, radians


@dataclass(frozen=True)
class Limb:
    """Any number of muscles about one joint.

    Parameters
    ----------
    muscles
        By name, in the order of every activation vector of this limb.
    outside
        All moments that no muscle makes.
    low, high
        Range of angles [rad].
    """

    muscles: Mapping[str, MuscleMoment]
    outside: OutsideMoment
    low: float
    high: float

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the muscles, in order."""
        return tuple(self.muscles)

    def check(self, activations: Sequence[float], hand_load: float) -> tuple[float, ...]:
        """The activations; raises InputError unless there is one in [0, 1] per muscle and the load is a number."""
        if len(activations) != len(self.muscles):
            raise InputError(
                f"expected {len(self.muscles)} activations ({', '.join(self.muscles)}), got {len(activations)}"
            )
        if not math.isfinite(hand_load):
            raise InputError(f"load at the hand: expected a number of newtons, got {hand_load!r}")
        return tuple(check_activation(a, name) for a, name in zip(activations, self.muscles, strict=True))

    def muscle_moments(
        self, activations: Sequence[float], angles: Float[np.ndarray, " points"]
    ) -> Float[np.ndarray, "points muscles"]:
        """Moment [N*mm] of each muscle at angles [rad]."""
        pairs = zip(self.muscles.values(), activations, strict=True)
        return np.stack([muscle.moment(angles, activation) for muscle, activation in pairs], axis=1)

    def net_moment(
        self, activations: Sequence[float], hand_load: float, angles: Float[np.ndarray, " points"]
    ) -> Float[np.ndarray, " points"]:
        """Sum of all moments [N*mm] at angles [rad]."""
        return self.muscle_moments(activations, angles).sum(axis=1) + self.outside(angles, hand_load)

    def moment_gradient(
        self, activations: Sequence[float], hand_load: float, angle: float
    ) -> tuple[float, float, Float[np.ndarray, " muscles"]]:
        """Net moment [N*mm] at one angle [rad], its derivative by the angle, and those by the activations."""
        pairs = zip(self.muscles.values(), activations, strict=True)
        rows = np.array([muscle.moment_gradient(angle, activation) for muscle, activation in pairs])
        moment, slope = self.outside.gradient(angle, hand_load)
        return moment + float(rows[:, 0].sum()), slope + float(rows[:, 1].sum()), rows[:, 2]

    def equilibria(self, activations: Sequence[float], hand_load: float = 0.0) -> tuple[Equilibrium, ...]:
        """All angles at which the elbow could rest, in rising order, with their stability."""
        checked = self.check(activations, hand_load)
        curves = [curve_of(muscle, a) for muscle, a in zip(self.muscles.values(), checked, strict=True)]
        net = _Net(_merged(curves), self.outside, hand_load)
        return equilibria(net, self.low, self.high, net.at)

    def rest(self, activations: Sequence[float], hand_load: float, near: float) -> Equilibrium:
        """The stable equilibrium nearest to an angle [rad].

        Raises InputError where there is none, with the net moment at both ends of the range.
        """
        found = self.equilibria(activations, hand_load)
        stable = [one for one in found if one.stable]
        if not stable:
            raise InputError(self._no_rest(activations, hand_load, found))
        return min(stable, key=lambda one: abs(one.angle - near))

    def sensitivity(
        self, activations: Sequence[float], hand_load: float, angle: float
    ) -> Float[np.ndarray, " muscles"]:
        """How an equilibrium [rad] moves with each activation; infinite where the balance is flat.

        `angle` is the equilibrium's.
        """
        _, slope, by_activation = self.moment_gradient(activations, hand_load, angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            return -by_activation / slope

    def _no_rest(self, activations: Sequence[float], hand_load: float, found: tuple[Equilibrium, ...]) -> str:
        ends = np.array([self.low, self.high])
        moments = " and ".join(
            f"{newton_metres(moment):.2f} N·m at {degrees(angle):g} degrees"
            for moment, angle in zip(self.net_moment(activations, hand_load, ends), ends, strict=True)
        )
        unstable = ", ".join(f"{degrees(one.angle):.1f}" for one in found)
        but = f"; unstable at {unstable} degrees" if found else ""
        values = ", ".join(f"{value:g}" for value in activations)
        return (
            f"activations ({values}) with {hand_load:g} N in the hand: expected an angle at rest from"
            f" {degrees(self.low):g} to {degrees(self.high):g} degrees, got none (net moment {moments}{but});"
            " change the load or the activations"
        )


@dataclass(frozen=True)
class _Net:
    """Net moment over the angle at fixed activations and load."""

    curves: Sequence[MomentCurve]
    outside: OutsideMoment
    hand_load: float

    def __call__(self, angles: Float[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        total = self.outside(angles, self.hand_load)
        for curve in self.curves:
            total = total + curve(angles)
        return total

    def at(self, angle: float) -> float:
        """The same at one angle."""
        return sum((curve.at(angle) for curve in self.curves), self.outside.gradient(angle, self.hand_load)[0])


def _merged(curves: Sequence[MomentCurve]) -> list[MomentCurve]:
    """The same sum from fewer curves: sections with the same breaks become one."""
    sections: dict[tuple[bytes, tuple[int, ...]], Section] = {}
    others: list[MomentCurve] = []
    for curve in curves:
        if isinstance(curve, Section):
            key = (curve.cells.breaks.tobytes(), curve.coefficients.shape)
            sections[key] = sections[key] + curve if key in sections else curve
        else:
            others.append(curve)
    return [*sections.values(), *others]


def arm_limb(arm: Arm, muscles: Mapping[str, MuscleMoment], gravity: bool = True) -> Limb:
    """The limb of an arm: its load, its stops and, with `gravity`, the weight of its forearm."""
    low, high = (radians(bound) for bound in arm.hinge.range_deg)
    return Limb(dict(muscles), WeightsAndStops(arm.load, arm.stops, gravity), low, high)
