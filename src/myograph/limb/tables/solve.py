"""States of one muscle by finite elements at any points of the box; those in a store are not solved again."""

import time
from collections.abc import Callable
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Int

from myograph.anatomy.model import Arm
from myograph.errors import InputError
from myograph.limb.tables.state import FIELDS_IN_TABLE, State, StateStore, state_key
from myograph.mesh.presets import preset_mesh

if TYPE_CHECKING:
    from myograph.mechanics.muscle import FailedState, MuscleState
    from myograph.mechanics.walk import Walk

Progress = Callable[[str], None]


class FiniteElementStates:
    """Answers points with states, in the points' order; `progress` hears the muscle's name after each.

    With a folder, every state is kept there as soon as it is solved.
    """

    def __init__(self, arm: Arm, name: str, preset: str, progress: Progress, folder: Path | None = None) -> None:
        self.arm, self.name, self.preset, self._progress = arm, name, preset, progress
        self.mesh = preset_mesh(arm, name, preset)
        self._kept: list[State] = []
        self._store = None if folder is None else StateStore(states_folder(folder, name), state_key(arm, name, preset))

    @property
    def reference(self) -> Float[np.ndarray, "nodes 3"]:
        """Nodes in the reference body [mm]."""
        return self.mesh.points

    @property
    def skin(self) -> Int[np.ndarray, "quads 4"]:
        """Quadrilaterals of the surface."""
        return self.mesh.skin

    def __call__(self, points: Float[np.ndarray, "points 2"]) -> list[State]:
        """States at points of (angle [rad], activation); failed ones with their reason."""
        found: dict[int, State] = {}
        for number, (angle, activation) in enumerate(points.tolist()):
            state = None if self._store is None else self._store.get(angle, activation, len(self.mesh.points))
            if state is not None:
                found[number] = state
                self._progress(self.name)
        self._kept += found.values()
        missing = np.array([number for number in range(len(points)) if number not in found], dtype=np.int64)
        if len(missing):
            self._recall()
            self._solve(points, missing, found)
        return [found[number] for number in range(len(points))]

    def _recall(self) -> None:
        """Let the walk start from what was kept; unknowns that do not fit this mesh are no start."""
        for state in self._kept:
            with suppress(InputError):
                self._walk.remember(state.angle, state.activation, state.vector)
        self._kept.clear()

    def _solve(self, points: np.ndarray, missing: np.ndarray, found: dict[int, State]) -> None:
        started = time.process_time()
        for number, solved in self._walk.states(points[missing]):
            now = time.process_time()
            state = self._state(points[missing[number]], solved, now - started)
            started = now
            if self._store is not None and not state.failure:
                self._store.put(state)
            found[int(missing[number])] = state
            self._progress(self.name)

    def _state(self, point: Float[np.ndarray, "2"], solved: "MuscleState | FailedState", seconds: float) -> State:
        from myograph.mechanics.muscle import FailedState

        angle, activation = point.tolist()
        if isinstance(solved, FailedState):
            return State(angle, activation, solved.reason, seconds=seconds)
        return State(
            angle,
            activation,
            failure="",
            moment=solved.moment,
            newton_steps=solved.newton_steps,
            volume_change=solved.soundness.volume_change,
            smallest_jacobian=solved.soundness.smallest_jacobian,
            penetration=solved.soundness.penetration,
            seconds=seconds,
            fields={name: np.array(solved.fields[name]) for name in FIELDS_IN_TABLE},
            vector=self._walk.vector(angle, activation),
        )

    @cached_property
    def _walk(self) -> "Walk":
        from myograph.mechanics.muscle import FiniteElementMuscle
        from myograph.mechanics.walk import Walk

        return Walk(FiniteElementMuscle(self.arm, self.name, self.preset))


def states_folder(folder: Path, name: str) -> Path:
    """Where the states of a muscle are kept beside its table."""
    return folder / "states" / name
