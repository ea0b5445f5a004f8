"""The arm from its tables: any activations and load in milliseconds."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES, Case, Solution
from myograph.limb.equilibrium import Equilibrium
from myograph.limb.limb import Limb, arm_limb
from myograph.limb.spline_moment import on_common_breaks
from myograph.limb.tables.table import MuscleTable
from myograph.units import degrees


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

        Raises InputError where there is no equilibrium in the arm's range, NotConvergedError for tables with failed
        states.
        """
        angle, notes = (case.elbow_angle, ()) if case.elbow_angle is not None else self._rest(case)
        activations = dict(zip(MUSCLES, case.activations, strict=True))
        moments = {name: float(self.tables[name].moment(np.array([angle]), activations[name])[0]) for name in MUSCLES}
        fields = {name: self.tables[name].at(angle, activations[name]) for name in MUSCLES}
        return Solution(case, angle, moments, fields, "table", notes)

    @cached_property
    def limb(self) -> Limb:
        """The tables' moments about the elbow, the load and the stops."""
        moments = on_common_breaks({name: self.tables[name].spline_moment for name in MUSCLES})
        return arm_limb(self.arm, moments, self.gravity)

    def equilibria(self, case: Case) -> tuple[Equilibrium, ...]:
        """All angles at which the elbow could rest."""
        return self.limb.equilibria(case.activations, case.hand_load)

    def angle(self, case: Case) -> float:
        """Elbow angle [rad] of a case: its own, or that of the equilibrium nearest to the reference pose."""
        if case.elbow_angle is not None:
            return case.elbow_angle
        return self.limb.rest(case.activations, case.hand_load, self.arm.reference_angle).angle

    def _rest(self, case: Case) -> tuple[float, tuple[str, ...]]:
        chosen = self.angle(case)
        others = [f"{degrees(e.angle):.1f}" for e in self.equilibria(case) if e.stable and e.angle != chosen]
        return chosen, (f"also at rest at {', '.join(others)} degrees",) if others else ()
