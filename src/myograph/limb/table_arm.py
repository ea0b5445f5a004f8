"""The arm from its tables: any activations and load in milliseconds."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES, Case, Solution
from myograph.errors import InputError
from myograph.limb.equilibrium import Equilibrium, equilibria
from myograph.limb.moments import load_moment, stop_moment
from myograph.limb.table import MuscleTable
from myograph.units import degrees, newton_metres, radians


@dataclass(frozen=True)
class TableArm:
    """Simulator that interpolates tabulated muscles; muscles act on each other only through the elbow's angle.

    Parameters
    ----------
    gravity
        Whether the forearm's own weight acts.
    """

    arm: Arm
    tables: Mapping[str, MuscleTable]
    gravity: bool = True

    def __call__(self, case: Case) -> Solution:
        """Fields of all muscles at the case's angle, or at the equilibrium nearest to the reference pose.

        Raises InputError where there is no equilibrium in the arm's range.
        """
        angle, notes = (case.elbow_angle, ()) if case.elbow_angle is not None else self._rest(case)
        activations = dict(zip(MUSCLES, case.activations, strict=True))
        moments = {name: float(self.tables[name].moment(np.array([angle]), activations[name])[0]) for name in MUSCLES}
        fields = {name: self.tables[name].at(angle, activations[name]) for name in MUSCLES}
        return Solution(case, angle, moments, fields, "table", notes)

    def net_moment(self, case: Case, angles: Float[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        """Sum of all moments about the elbow [N*mm] at angles [rad]."""
        pairs = zip(MUSCLES, case.activations, strict=True)
        muscles = np.sum([self.tables[muscle].moment(angles, activation) for muscle, activation in pairs], axis=0)
        weights = load_moment(self.arm.load, angles, case.hand_load, self.gravity)
        return muscles + weights + stop_moment(self.arm.stops, angles)

    def equilibria(self, case: Case) -> tuple[Equilibrium, ...]:
        """All angles at which the elbow could rest."""
        low, high = (radians(bound) for bound in self.arm.hinge.range_deg)
        return equilibria(lambda angles: self.net_moment(case, angles), low, high)

    def _rest(self, case: Case) -> tuple[float, tuple[str, ...]]:
        stable = [e.angle for e in self.equilibria(case) if e.stable]
        if not stable:
            raise InputError(self._no_equilibrium(case))
        chosen = min(stable, key=lambda angle: abs(angle - self.arm.reference_angle))
        others = [f"{degrees(angle):.1f}" for angle in stable if angle != chosen]
        return chosen, (f"also at rest at {', '.join(others)} degrees",) if others else ()

    def _no_equilibrium(self, case: Case) -> str:
        low, high = self.arm.hinge.range_deg
        ends = self.net_moment(case, np.radians([low, high]))
        moments = " and ".join(
            f"{newton_metres(moment):.2f} N·m at {angle:g} degrees"
            for moment, angle in zip(ends, (low, high), strict=True)
        )
        return (
            f"activations {case.activations} with {case.hand_load:g} N in the hand: expected an angle at rest from"
            f" {low:g} to {high:g} degrees, got none (net moment {moments}); change the load or the activations"
        )
