"""Equilibrium of a specimen: Newton's method in load steps that are halved where it fails.

A step has converged when a whole Newton correction moves no point by more than TOLERANCE of the body's size; as the
method is quadratic, what is left is then of round-off's size.
"""

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.errors import InputError, NotConvergedError
from myograph.mechanics.specimen.description import Load, Specimen
from myograph.mechanics.specimen.problem import SpecimenProblem
from myograph.mechanics.specimen.state import LoadStep, SpecimenState, read_state, smallest_volume_ratio

TOLERANCE = 1e-10
"""Largest correction of the displacement over the body's size at which a state counts as solved."""
MOST_CORRECTIONS = 20
SMALLEST_SHARE = 1 / 256
_TOO_FAR = 10.0
"""Correction over the body's size that no equilibrium asks for."""


def solve(specimen: Specimen, load: Load, steps: int = 1) -> SpecimenState:
    """Equilibrium under the load, which is applied in `steps` equal steps, halved where one fails.

    Raises
    ------
    InputError
        For unknown faces, prescribed values that contradict each other, supports that leave a rigid motion.
    NotConvergedError
        Where even steps of 1/256 of the load fail; carries the residuals of the last one.
    """
    if steps < 1:
        raise InputError(f"load steps: expected a whole number from 1 on, got {steps}")
    ngs.ngsglobals.msg_level = 0
    problem = SpecimenProblem(specimen, load)
    vector, history = np.zeros(problem.unknowns.ndof), []
    done, share = 0.0, 1 / steps
    while done < 1:
        target = 1.0 if done + share > 1 - 1e-9 else done + share
        tried, step, failure = _newton(problem, vector, (done, target))
        if not failure:
            vector, done = tried, target
            history.append(step)
        elif share / 2 < SMALLEST_SHARE:
            raise _failed(specimen, step, failure)
        else:
            share /= 2
    return read_state(problem, vector, tuple(history))


def _newton(
    problem: SpecimenProblem, vector: Float[np.ndarray, " unknowns"], shares: tuple[float, float]
) -> tuple[Float[np.ndarray, " unknowns"], LoadStep, str]:
    """One load step between two shares: the unknowns, the history, and why it failed or nothing."""
    problem.share.Set(shares[1])
    increment = (shares[1] - shares[0]) * problem.prescribed
    size, forces = float(np.ptp(problem.body.vertices)), 3 * problem.size
    residuals: list[float] = []
    corrections: list[float] = []
    failure = ""
    while not failure:
        change = problem.linear_step(vector, increment)
        residuals.append(float(np.linalg.norm(problem.residual(vector)[:forces][problem.free[:forces]])))
        vector, increment = vector + change, 0.0 * increment
        corrections.append(float(np.abs(change[:forces]).max()) / size)
        if corrections[-1] <= TOLERANCE:
            smallest = smallest_volume_ratio(problem, vector)
            failure = "" if smallest > 0 else f"an element turned inside out (J = {smallest:.1e})"
            break
        failure = _trouble(corrections)
    return vector, LoadStep(shares[1], tuple(residuals), tuple(corrections)), failure


def _trouble(corrections: list[float]) -> str:
    if not np.isfinite(corrections[-1]):
        return "a correction became infinite"
    if corrections[-1] > _TOO_FAR:
        return f"a correction of {corrections[-1]:.0f} times the specimen's size"
    return f"no convergence in {MOST_CORRECTIONS} corrections" if len(corrections) >= MOST_CORRECTIONS else ""


def _failed(specimen: Specimen, step: LoadStep, failure: str) -> NotConvergedError:
    history = ", ".join(f"{correction:.1e}" for correction in step.corrections)
    kind = f"{type(specimen.shape).__name__} of {type(specimen.law).__name__}"
    message = f"{kind} at {step.share:.1%} of its load: {failure}; corrections over its size: {history}"
    return NotConvergedError(message, residuals=step.residuals)
