"""The arm by finite elements: every muscle solved at the angle at which all moments cancel; slow and the truth.

The balance is followed from a first guess towards the side to which the net moment turns the elbow, until it changes
its sign, and is closed in by a bracketed search. Tables of the arm spare most of the way: they guess the angle, and the
unknowns that are kept beside them, interpolated, are where Newton's method starts.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path

import numpy as np
from scipy.optimize import root_scalar

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES, Case, Solution
from myograph.errors import InputError, NotConvergedError
from myograph.interpolation import Interpolant
from myograph.limb.moments import WeightsAndStops
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.unknowns import interpolated_unknowns
from myograph.mechanics.continuation import Solved
from myograph.mechanics.muscle import FiniteElementMuscle, MuscleState
from myograph.units import degrees, newton_metres, radians

ACCURACY = radians(0.005)
"""Of an equilibrium's angle [rad]."""
_BALANCED = 0.5
"""Net moment [N*mm] that counts as none; where the elbow rests, a degree is worth about 300."""
_FIRST_STEP, _LARGEST_STEP, _GROWTH = radians(0.3), radians(15.0), 3
_NEAR = 0.2
"""Change of activation plus change of angle [rad] up to which a state is reached straight from another."""
_MEMORY = 40
"""Active states that are kept of each muscle."""
Balance = Callable[[float], float]


class DirectArm:
    """Simulator that solves every muscle at a case's equilibrium; one thread, one process.

    Parameters
    ----------
    preset
        Size of the meshes.
    gravity
        Whether the forearm's own weight acts.
    guess
        Angle [rad] from which a case's equilibrium is sought; the reference pose where none is given.
    starts
        Muscle -> unknowns over (angle [rad], activation), from which its states are tried first.
    """

    def __init__(
        self,
        arm: Arm,
        preset: str = "quick",
        *,
        gravity: bool = True,
        guess: Callable[[Case], float] | None = None,
        starts: Mapping[str, Interpolant] | None = None,
    ) -> None:
        self.arm, self._guess = arm, guess
        self._outside = WeightsAndStops(arm.load, arm.stops, gravity)
        self._muscles = {
            name: _Remembering(FiniteElementMuscle(arm, name, preset), (starts or {}).get(name)) for name in MUSCLES
        }

    @classmethod
    def beside_tables(
        cls, folder: Path, arm: Arm, tables: Mapping[str, MuscleTable], preset: str, *, gravity: bool = True
    ) -> "DirectArm":
        """The arm that starts from tables of any preset, and from the states kept in their folder if of this one."""
        starts = interpolated_unknowns(folder, arm, tables, preset)
        return cls(arm, preset, gravity=gravity, guess=TableArm(arm, tables, gravity).angle, starts=starts)

    def __call__(self, case: Case) -> Solution:
        """Fields of all muscles at the case's angle, or at the equilibrium next to the guess.

        Raises InputError where there is no equilibrium in the arm's range, NotConvergedError where a muscle fails.
        """
        angle = self._rest(case) if case.elbow_angle is None else case.elbow_angle
        states = {name: self._muscles[name].state(_activation(case, name), angle) for name in MUSCLES}
        moments = {name: state.moment for name, state in states.items()}
        return Solution(case, angle, moments, {name: state.fields for name, state in states.items()}, "direct")

    def forget(self) -> None:
        """Start the next case as the first one, whatever was solved before."""
        for muscle in self._muscles.values():
            muscle.forget()

    def net_moment(self, case: Case, angle: float) -> float:
        """Sum of all moments about the elbow [N*mm] at an angle [rad]."""
        muscles = sum(self._muscles[name].moment(_activation(case, name), angle) for name in MUSCLES)
        return muscles + float(self._outside(np.array([angle]), case.hand_load)[0])

    def _balance(self, case: Case, angle: float) -> float:
        moment = self.net_moment(case, angle)
        return moment if abs(moment) > _BALANCED else 0.0

    def _rest(self, case: Case) -> float:
        low, high = (radians(bound) for bound in self.arm.hinge.range_deg)
        start = self.arm.reference_angle if self._guess is None else self._guess(case)
        try:
            return stable_root(lambda angle: self._balance(case, angle), start, low, high)
        except InputError as problem:
            raise InputError(
                f"activations {case.activations} with {case.hand_load:g} N in the hand: {problem}; change the load or"
                " the activations"
            ) from None


def _activation(case: Case, name: str) -> float:
    return case.activations[MUSCLES.index(name)]


def stable_root(balance: Balance, start: float, low: float, high: float) -> float:
    """The angle [rad] in [low, high] to which a net moment turns the elbow from a start.

    Raises InputError where it turns it to the end of the range.
    """
    here, moment = min(max(start, low), high), balance(min(max(start, low), high))
    upwards, step = moment > 0, _FIRST_STEP
    while moment != 0:
        beyond = min(here + step, high) if upwards else max(here - step, low)
        if beyond == here:
            raise InputError(
                f"expected an angle at rest from {degrees(low):g} to {degrees(high):g} degrees, got a net moment of"
                f" {newton_metres(moment):.2f} N·m at {degrees(here):g} degrees"
            )
        after = balance(beyond)
        if (after > 0) != upwards:
            return float(root_scalar(balance, bracket=(here, beyond), xtol=ACCURACY).root)
        here, moment, step = beyond, after, min(_GROWTH * step, _LARGEST_STEP)
    return here


class _Remembering:
    """A muscle whose states start from interpolated ones, from a near one solved before, else by way of rest."""

    def __init__(self, muscle: FiniteElementMuscle, starts: Interpolant | None) -> None:
        self._muscle, self._starts = muscle, starts
        self._reference = muscle.arm.reference_angle
        self._rest: dict[float, Solved] = {}
        self._active: dict[tuple[float, float], Solved] = {}

    def forget(self) -> None:
        """Keep nothing but the muscle at rest in the reference pose."""
        self._rest = {angle: state for angle, state in self._rest.items() if angle == self._reference}
        self._active.clear()

    def state(self, activation: float, angle: float) -> MuscleState:
        """State at an activation and an angle [rad]."""
        return self._muscle.read(self._solved(activation, angle))

    def moment(self, activation: float, angle: float) -> float:
        """Moment about the hinge [N*mm] of that state."""
        return self._muscle.moment(self._solved(activation, angle))

    def _solved(self, activation: float, angle: float) -> Solved:
        if (activation, angle) not in self._active:
            self._active[activation, angle] = self._reached(activation, angle)
            if len(self._active) > _MEMORY:
                del self._active[next(iter(self._active))]
        return self._active[activation, angle]

    def _reached(self, activation: float, angle: float) -> Solved:
        if self._starts is not None:
            with suppress(NotConvergedError):
                return self._muscle.settled(activation, angle, self._starts(np.array([angle, activation])))
        near = [known for known in self._active if abs(known[0] - activation) + abs(known[1] - angle) < _NEAR]
        if near:
            nearest = min(near, key=lambda known: abs(known[0] - activation) + abs(known[1] - angle))
            try:
                return self._muscle.reach(self._active[nearest], activation, angle)
            except NotConvergedError:
                del self._active[nearest]
        return self._muscle.reach(self._at_rest(angle), activation, angle)

    def _at_rest(self, angle: float) -> Solved:
        if not self._rest:
            self._rest[self._reference] = self._muscle.at_rest()
        place = min(self._rest, key=lambda known: abs(known - angle))
        if abs(place - angle) > _NEAR / 2:
            self._rest[angle] = self._muscle.reach(self._rest[place], 0.0, angle)
            place = angle
        return self._rest[place]
