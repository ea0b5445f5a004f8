"""One muscle by finite elements: ask for an activation and an angle, get the deformed, stressed muscle."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import ngsolve as ngs
import numpy as np

from myograph.anatomy.model import Arm
from myograph.case import check_activation, check_muscle
from myograph.errors import InputError, NotConvergedError
from myograph.mechanics.continuation import Controls, Solved, at_rest, reach, set_controls
from myograph.mechanics.problem import MuscleProblem
from myograph.mechanics.soundness import Soundness, check_clear, soundness
from myograph.mechanics.stress import FieldReader
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.presets import muscle_mesh, resolution
from myograph.units import degrees

_MANY_CELLS = 300
"""Elements from which on machine code for the energy is worth the time that it takes to make."""


@dataclass(frozen=True)
class MuscleState:
    """A muscle in equilibrium.

    Parameters
    ----------
    muscle, activation, angle
        Which, how active, at which elbow flexion [rad].
    moment
        About the hinge [N*mm]; positive flexes.
    fields
        Field name (see `myograph.fields`) -> values at the nodes.
    newton_steps
        Steps from the state before.
    soundness
        Volume, Jacobian and penetration.
    """

    muscle: str
    activation: float
    angle: float
    moment: float
    fields: Mapping[str, np.ndarray]
    newton_steps: int
    soundness: Soundness


@dataclass(frozen=True)
class FailedState:
    """A state that could not be solved from any of its neighbours, and why."""

    muscle: str
    activation: float
    angle: float
    reason: str


class FiniteElementMuscle:
    """The named muscle of an arm on the mesh of a preset, or on one of your own; one thread, one process.

    Raises InputError for an unknown muscle or preset, for a body that cannot be meshed or starts inside a bone.
    """

    def __init__(self, arm: Arm, name: str, preset: str = "quick", mesh: MuscleMesh | None = None) -> None:
        check_muscle(name)
        ngs.SetNumThreads(1)
        ngs.ngsglobals.msg_level = 0
        self.arm = arm
        self.mesh = muscle_mesh(arm, name, resolution(preset)) if mesh is None else mesh
        self._problem = MuscleProblem(arm, name, self.mesh, native=len(self.mesh.cells) > _MANY_CELLS)
        check_clear(self._problem)
        self._reader = FieldReader(self._problem)

    def solve(self, activation: float, angle: float) -> MuscleState:
        """State at an activation in [0, 1] and an elbow flexion [rad] inside the arm's range.

        Raises InputError outside the box, NotConvergedError where Newton's method fails.
        """
        check_activation(activation, self._problem.name)
        flexion = self._flexion(angle)
        relaxed = reach(self._problem, at_rest(self._problem), Controls(1.0, 0.0, flexion))
        return self._state(reach(self._problem, relaxed, Controls(1.0, activation, flexion)))

    def walk(
        self, angles: Sequence[float], activations: Sequence[float]
    ) -> Iterator[tuple[int, int, MuscleState | FailedState]]:
        """All states of the grid angles [rad] x activations (rising from 0), each from a solved neighbour.

        The angle is swept at rest, outwards from the reference pose; at every angle the activation rises. Where that
        fails, the state is tried from the same activation at the angle before. Yields (angle's index, activation's
        index, state); a state that fails all the same is yielded with its reason.
        """
        start = at_rest(self._problem)
        reference = self.arm.reference_angle
        up = [k for k, angle in enumerate(angles) if angle >= reference]
        down = [k for k, angle in reversed(list(enumerate(angles))) if angle < reference]
        for side in (up, down):
            column: dict[int, Solved] = {-1: start}
            for k in side:
                before, flexion = column, self._flexion(angles[k])
                rest = self._try(Controls(1.0, 0.0, flexion), [before[-1]])
                column = {-1: rest if isinstance(rest, Solved) else before[-1]}
                here = rest
                for j, activation in enumerate(activations):
                    starts = [start for start in (here, before.get(j)) if isinstance(start, Solved)]
                    here = self._try(Controls(1.0, activation, flexion), starts) if starts else here
                    if isinstance(here, Solved):
                        column[j] = here
                    yield k, j, self._outcome(here, activation, angles[k])

    def _try(self, target: Controls, starts: list[Solved]) -> Solved | NotConvergedError:
        """The target reached from the first start that leads there, or the first failure."""
        failures = []
        for start in starts:
            try:
                return reach(self._problem, start, target)
            except NotConvergedError as failure:
                failures.append(failure)
        return failures[0]

    def _outcome(
        self, solved: Solved | NotConvergedError, activation: float, angle: float
    ) -> MuscleState | FailedState:
        if isinstance(solved, Solved):
            return self._state(solved)
        return FailedState(self._problem.name, activation, angle, str(solved))

    def _flexion(self, angle: float) -> float:
        low, high = self.arm.hinge.range_deg
        if not np.isfinite(angle) or not low - 1e-9 <= degrees(angle) <= high + 1e-9:
            raise InputError(f"elbow angle: expected {low:g} to {high:g} degrees, got {degrees(angle):g}")
        return angle - self.arm.reference_angle

    def _state(self, solved: Solved) -> MuscleState:
        set_controls(self._problem, solved.controls)
        return MuscleState(
            muscle=self._problem.name,
            activation=solved.controls.activation,
            angle=self.arm.reference_angle + solved.controls.flexion,
            moment=self._problem.moment(solved.vector, solved.controls.flexion),
            fields=self._reader.read(solved.vector),
            newton_steps=solved.newton_steps,
            soundness=soundness(self._problem, solved.vector, solved.controls.flexion),
        )
