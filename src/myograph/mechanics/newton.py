"""Newton's method for one load step of a muscle, each factored tangent used for as long as it serves.

The prescribed displacement enters the first linear solve (r + K d), so that the whole body follows the boundary; put
straight into the boundary nodes it would invert the next elements. That first step is always accepted; later ones with
a tangent of their own are halved until the residual is below twice the last one or a hundredth of the reaction, and
after some steps, where it may be going round in a circle between contacts, until it is below the largest of the last
three. In between the last tangent goes on, corrected by Broyden's rank-one updates, while a step of it brings the
residual well down: that costs a residual, about a tenth of a tangent.

Source: Kelley, Solving Nonlinear Equations with Newton's Method (2003), section 4.2, Broyden's method by its steps.
"""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from jaxtyping import Float

from myograph.mechanics.algebra import Tangent
from myograph.mechanics.problem import MuscleProblem

TOLERANCE = 1e-7
"""Residual force over the reaction at which a state counts as solved."""
MOST_STEPS = 25
CONTRACTION = 0.2
"""Residual over the last one up to which a factored tangent is used again."""
_MOST_HALVINGS = 6
_PATIENCE = 6
"""Steps after which the residual must fall."""
_SMALLEST_REACTION = 1.0
_PRESSURE_SCALE = 0.01
"""Force per volume [N/mm³] that makes the residual of the volume constraint comparable to forces."""
Unknowns = Float[np.ndarray, " unknowns"]


@dataclass(frozen=True)
class NewtonResult:
    """Where Newton's method ended.

    Parameters
    ----------
    vector
        The unknowns.
    residuals
        Residual over reaction after each step.
    tangents
        How many were assembled and factored.
    failure
        Why it stopped early; empty where it did not.
    """

    vector: Unknowns
    residuals: tuple[float, ...]
    tangents: int
    failure: str = ""


@dataclass(frozen=True)
class _Secant:
    """A factored tangent, with Broyden's corrections by the steps that were taken with it."""

    tangent: Tangent
    steps: list[Unknowns] = field(default_factory=list)

    def step(self, residual: Unknowns) -> Unknowns:
        """The next change of the unknowns; `residual` after the last of `steps`."""
        step = self.tangent.solve(-residual)
        for before, after in pairwise(self.steps):
            step = step + after * (before @ step) / (before @ before)
        if self.steps:
            last = self.steps[-1]
            step = step / (1 - (last @ step) / (last @ last))
        return step


def newton(
    problem: MuscleProblem, vector: Unknowns, increment: Unknowns, contraction: float = CONTRACTION
) -> NewtonResult:
    """Solve at the problem's present controls, from `vector`, moving the boundary by `increment` [mm].

    With a `contraction` of 0 every step has a tangent of its own.
    """
    residual = problem.residual(vector)
    if not np.isfinite(residual).all():
        return NewtonResult(vector, (), 0, "the guess turned an element inside out")
    tangent, tangents = problem.tangent(vector), 1
    vector = vector + increment + tangent.solve(-(residual + tangent.times(increment)))
    residual, secant = problem.residual(vector), _Secant(tangent)
    history: list[float] = []
    while True:
        size, reaction = _norms(problem, residual)
        history.append(size / reaction)
        if not np.isfinite(size):
            return NewtonResult(vector, tuple(history), tangents, "the residual became infinite")
        if size <= TOLERANCE * reaction:
            smallest = smallest_volume_ratio(problem, vector)
            failure = "" if smallest > 0 else f"an element turned inside out (J = {smallest:.3f})"
            return NewtonResult(vector, tuple(history), tangents, failure)
        if tangents > MOST_STEPS:
            return NewtonResult(vector, tuple(history), tangents, f"no convergence in {MOST_STEPS} steps")
        again = _again(problem, vector, residual, secant, contraction * size)
        if again is None:
            secant, tangents = _Secant(problem.tangent(vector)), tangents + 1
            bound = max(2 * size, 1e-2 * reaction) if tangents <= _PATIENCE else 0.95 * max(history[-3:]) * reaction
            again = _damped(problem, vector, secant.step(residual), bound)
        secant.steps.append(again[0] - vector)
        vector, residual = again


def _again(
    problem: MuscleProblem, vector: Unknowns, residual: Unknowns, secant: _Secant, bound: float
) -> tuple[Unknowns, Unknowns] | None:
    """Unknowns and residual after a step with a tangent factored before; None where it misses the bound."""
    if bound == 0:
        return None
    moved = vector + secant.step(residual)
    after = problem.residual(moved)
    size, _ = _norms(problem, after)
    return (moved, after) if np.isfinite(size) and size <= bound else None


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
