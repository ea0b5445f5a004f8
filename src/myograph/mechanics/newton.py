"""Newton's method for one load step of a muscle.

The prescribed displacement enters the first linear solve (r + K d), so that the whole body follows the boundary; put
straight into the boundary nodes it would invert the next elements. That first step is always accepted; later ones are
halved until the residual is below twice the last one or a hundredth of the reaction, and after some steps, where it
may be going round in a circle between contacts, until it is below the largest of the last three.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.mechanics.problem import MuscleProblem

TOLERANCE = 1e-7
"""Residual force over the reaction at which a state counts as solved."""
MOST_STEPS = 25
_MOST_HALVINGS = 6
_PATIENCE = 6
"""Steps after which the residual must fall."""
_SMALLEST_REACTION = 1.0
_PRESSURE_SCALE = 0.01
"""Force per volume [N/mm³] that makes the residual of the volume constraint comparable to forces."""


@dataclass(frozen=True)
class NewtonResult:
    """Where Newton's method ended: the unknowns, residual over reaction after each step, and why it stopped early."""

    vector: Float[np.ndarray, " unknowns"]
    residuals: tuple[float, ...]
    failure: str = ""


def newton(
    problem: MuscleProblem, vector: Float[np.ndarray, " unknowns"], increment: Float[np.ndarray, " unknowns"]
) -> NewtonResult:
    """Solve at the problem's present controls, from `vector`, moving the boundary by `increment` [mm]."""
    if not np.isfinite(problem.residual(vector)).all():
        return NewtonResult(vector, (), "the guess turned an element inside out")
    tangent = problem.tangent(vector)
    change = increment + tangent.solve(-(problem.residual(vector) + tangent.times(increment)))
    vector = vector + change
    residual = problem.residual(vector)
    history: list[float] = []
    while True:
        size, reaction = _norms(problem, residual)
        history.append(size / reaction)
        if not np.isfinite(size):
            return NewtonResult(vector, tuple(history), "the residual became infinite")
        if size <= TOLERANCE * reaction:
            smallest = smallest_volume_ratio(problem, vector)
            failure = "" if smallest > 0 else f"an element turned inside out (J = {smallest:.3f})"
            return NewtonResult(vector, tuple(history), failure)
        if len(history) > MOST_STEPS:
            return NewtonResult(vector, tuple(history), f"no convergence in {MOST_STEPS} steps")
        change = problem.tangent(vector).solve(-residual)
        bound = max(2 * size, 1e-2 * reaction) if len(history) <= _PATIENCE else 0.95 * max(history[-3:]) * reaction
        vector, residual = _damped(problem, vector, change, bound)


def _damped(
    problem: MuscleProblem, vector: np.ndarray, change: np.ndarray, bound: float
) -> tuple[Float[np.ndarray, " unknowns"], Float[np.ndarray, " unknowns"]]:
    """Unknowns and residual after 1, 1/2, 1/4 ... of the change: the first under the bound, or the smallest tried."""
    moved = vector + change
    residual = problem.residual(moved)
    for _ in range(_MOST_HALVINGS):
        size, _ = _norms(problem, residual)
        if np.isfinite(size) and size <= bound:
            break
        change = 0.5 * change
        moved = vector + change
        residual = problem.residual(moved)
    return moved, residual


def _norms(problem: MuscleProblem, residual: Float[np.ndarray, " unknowns"]) -> tuple[float, float]:
    """Norm of the residual on the free unknowns [N], and of the reaction on the fixed ones [N]."""
    forces = 3 * problem.space.scalar.ndof
    free = np.where(problem.free, residual, 0.0)
    size = np.hypot(np.linalg.norm(free[:forces]), _PRESSURE_SCALE * np.linalg.norm(free[forces:]))
    reaction = np.linalg.norm(residual[~problem.free])
    return float(size), float(max(reaction, _SMALLEST_REACTION))


def smallest_volume_ratio(problem: MuscleProblem, vector: Float[np.ndarray, " unknowns"]) -> float:
    """Smallest J = det F over all integration points."""
    return float(problem.mesh.volume_ratios(problem.positions(vector)).min())
