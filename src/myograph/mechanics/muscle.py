"""One muscle by finite elements: ask for an activation and an angle, get the deformed, stressed muscle."""

from collections.abc import Mapping
from dataclasses import dataclass

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm
from myograph.case import check_activation, check_muscle
from myograph.errors import InputError
from myograph.mechanics.continuation import Controls, Solved, at_rest, reach, set_controls, settled
from myograph.mechanics.problem import MuscleProblem
from myograph.mechanics.soundness import Soundness, check_clear, soundness
from myograph.mechanics.stress import FieldReader
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.presets import preset_mesh
from myograph.units import degrees


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
        self.mesh = preset_mesh(arm, name, preset) if mesh is None else mesh
        self._problem = MuscleProblem(arm, name, self.mesh)
        check_clear(self._problem)
        self._reader = FieldReader(self._problem)

    @property
    def name(self) -> str:
        """Which muscle."""
        return self._problem.name

    def solve(self, activation: float, angle: float) -> MuscleState:
        """State at an activation in [0, 1] and an elbow flexion [rad] inside the arm's range.

        Raises InputError outside the box, NotConvergedError where Newton's method fails.
        """
        check_activation(activation, self._problem.name)
        relaxed = self.reach(self.at_rest(), 0.0, angle)
        return self.read(self.reach(relaxed, activation, angle))

    def at_rest(self) -> Solved:
        """The start of every walk: the reference pose, pre-stretched, not activated."""
        return at_rest(self._problem)

    def reach(self, start: Solved, activation: float, angle: float, most: int | None = None) -> Solved:
        """State at an activation and an elbow flexion [rad], on the straight way from a solved one.

        Raises InputError outside the box, NotConvergedError where the way ends or `most` tangents are used up.
        """
        check_activation(activation, self._problem.name)
        return reach(self._problem, start, Controls(1.0, activation, self._flexion(angle)), most=most)

    def settled(self, activation: float, angle: float, guess: Float[np.ndarray, " unknowns"]) -> Solved:
        """State at an activation and an elbow flexion [rad], straight from a guess of its unknowns.

        Raises InputError outside the box, NotConvergedError where Newton's method does not lead there.
        """
        start = self.restored(check_activation(activation, self._problem.name), angle, guess)
        return settled(self._problem, start.vector, start.controls)

    def restored(self, activation: float, angle: float, vector: Float[np.ndarray, " unknowns"]) -> Solved:
        """A state that was solved before, from its unknowns; raise InputError for those of another mesh."""
        if len(vector) != self._problem.vector_size:
            raise InputError(f"{self.name}: expected {self._problem.vector_size} unknowns, got {len(vector)}")
        return Solved(Controls(1.0, activation, self._flexion(angle)), vector, 0)

    def moment(self, solved: Solved) -> float:
        """Moment about the hinge [N*mm] of a solved state; positive flexes."""
        set_controls(self._problem, solved.controls)
        return self._problem.moment(solved.vector, solved.controls.flexion)

    def read(self, solved: Solved) -> MuscleState:
        """What a solved state tells."""
        moment = self.moment(solved)
        return MuscleState(
            muscle=self._problem.name,
            activation=solved.controls.activation,
            angle=self.arm.reference_angle + solved.controls.flexion,
            moment=moment,
            fields=self._reader.read(solved.vector),
            newton_steps=solved.newton_steps,
            soundness=soundness(self._problem, solved.vector, solved.controls.flexion),
        )

    def _flexion(self, angle: float) -> float:
        low, high = self.arm.hinge.range_deg
        if not np.isfinite(angle) or not low - 1e-9 <= degrees(angle) <= high + 1e-9:
            raise InputError(f"elbow angle: expected {low:g} to {high:g} degrees, got {degrees(angle):g}")
        return angle - self.arm.reference_angle
