"""From state to state of one muscle through any points of the box of elbow angle and activation.

Every state starts from a solved one that is kept: the angle is swept at rest, outwards from the reference pose, and at
every angle the activation rises from the nearest smaller one. Where that fails, the state is tried from the nearest
activation at the nearest other angle. A slack muscle resists turning, for it folds: where that costs too much at rest,
it is turned at its largest known activation, and relaxed afterwards.
"""

from collections.abc import Iterable, Iterator
from itertools import islice

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError, NotConvergedError
from myograph.mechanics.continuation import Solved
from myograph.mechanics.muscle import FailedState, FiniteElementMuscle, MuscleState

_SAME = 9
"""Decimals of an angle [rad] up to which two are one."""
_PATIENCE = 50
"""Tangents after which a turn at rest is given up."""
_STARTS = 3
"""From how many resting states a turn is tried at last: a slack muscle folds one way from here, another from there."""


class Walk:
    """A muscle and the states of it that are solved; further points start from these."""

    def __init__(self, muscle: FiniteElementMuscle) -> None:
        self.muscle = muscle
        self._columns: dict[float, dict[float, Solved]] = {}

    def remember(self, angle: float, activation: float, vector: Float[np.ndarray, " unknowns"]) -> None:
        """Take in a state that was solved in an earlier run, by its unknowns."""
        self._column(angle)[activation] = self.muscle.restored(activation, angle, vector)

    def vector(self, angle: float, activation: float) -> Float[np.ndarray, " unknowns"]:
        """Unknowns of a solved state; raise InputError where there is none."""
        solved = self._columns.get(round(angle, _SAME), {}).get(activation)
        if solved is None:
            raise InputError(
                f"expected a point that is solved, got angle {angle:g} rad, activation {activation:g}; walk there first"
            )
        return solved.vector

    def states(self, points: Float[np.ndarray, "points 2"]) -> Iterator[tuple[int, MuscleState | FailedState]]:
        """States at points of (angle [rad], activation), each with its number, in the order of the walk.

        A state that fails from all its starts is yielded with the reason.
        """
        if len(points) and not any(0.0 in column for column in self._columns.values()):
            self._column(self.muscle.arm.reference_angle)[0.0] = self.muscle.at_rest()
        for angle, numbers in self._route(points):
            failure = self._sweep(angle)
            for number in numbers:
                activation = float(points[number, 1])
                outcome = self._outcome(angle, activation, failure)
                if isinstance(outcome, Solved):
                    yield number, self.muscle.read(outcome)
                else:
                    yield number, FailedState(self.muscle.name, activation, angle, str(outcome))

    def _route(self, points: np.ndarray) -> Iterator[tuple[float, list[int]]]:
        """Angles, outwards from the reference pose to both sides, each with its points by rising activation."""
        columns: dict[float, list[int]] = {}
        for number in np.lexsort((points[:, 1], points[:, 0])).tolist():
            columns.setdefault(round(float(points[number, 0]), _SAME), []).append(number)
        reference = self.muscle.arm.reference_angle
        up = [angle for angle in columns if angle >= reference]
        down = [angle for angle in reversed(columns) if angle < reference]
        return ((float(points[columns[angle][0], 0]), columns[angle]) for angle in (*up, *down))

    def _sweep(self, angle: float) -> NotConvergedError | None:
        """The muscle at rest at an angle, from the nearest ones at rest; the failure, if it is one."""
        column = self._column(angle)
        if 0.0 in column:
            return None
        resting = list(islice((states[0.0] for states in self._nearest(angle) if 0.0 in states), _STARTS))
        taut = next((states[max(states)] for states in self._nearest(angle) if max(states, default=0.0) > 0), None)
        result = None if taut is None else self._quickly(angle, resting[0], taut)
        if result is None or isinstance(result, NotConvergedError):
            result = self._first(0.0, angle, resting)
        return result if isinstance(result, NotConvergedError) else None

    def _quickly(self, angle: float, resting: Solved, taut: Solved) -> Solved | NotConvergedError:
        """The muscle at rest at an angle: turned at rest if that is cheap, or else contracted."""
        result = self._first(0.0, angle, [resting], _PATIENCE)
        return self._relaxed(angle, taut) if isinstance(result, NotConvergedError) else result

    def _relaxed(self, angle: float, taut: Solved) -> Solved | NotConvergedError:
        """The muscle at rest at an angle, from a contracted one that is turned there first."""
        turned = self._first(taut.controls.activation, angle, [taut])
        return turned if isinstance(turned, NotConvergedError) else self._first(0.0, angle, [turned])

    def _outcome(
        self, angle: float, activation: float, at_rest: NotConvergedError | None
    ) -> Solved | NotConvergedError:
        """The state, from a smaller activation here or else from the nearest one at the nearest other angle."""
        column = self._column(angle)
        if activation in column:
            return column[activation]
        if at_rest is not None and activation == 0.0:
            return at_rest
        smaller = [known for known in column if known < activation]
        starts = [column[max(smaller)]] if smaller else []
        beside = next((states for states in self._nearest(angle) if any(known > 0 for known in states)), {})
        if beside:
            starts.append(beside[min(beside, key=lambda known: abs(known - activation))])
        if not starts and at_rest is not None:
            return at_rest
        return self._first(activation, angle, starts)

    def _first(
        self, activation: float, angle: float, starts: Iterable[Solved], most: int | None = None
    ) -> Solved | NotConvergedError:
        """The state reached from the first start that leads there, now remembered; or the first failure."""
        failures = []
        for start in starts:
            try:
                solved = self.muscle.reach(start, activation, angle, most)
            except NotConvergedError as failure:
                failures.append(failure)
            else:
                self._column(angle)[activation] = solved
                return solved
        return failures[0]

    def _column(self, angle: float) -> dict[float, Solved]:
        return self._columns.setdefault(round(angle, _SAME), {})

    def _nearest(self, angle: float) -> Iterator[dict[float, Solved]]:
        """Solved states at the other angles, the nearest angle first."""
        here = round(angle, _SAME)
        for other in sorted(self._columns, key=lambda other: abs(other - here)):
            if other != here:
                yield self._columns[other]
