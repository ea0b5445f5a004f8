r"""Small networks of two hidden layers, fitted by Levenberg-Marquardt steps in double precision.

    y(x) = v · tanh(W₂ tanh(W₁ x + b₁) + b₂) + d
    (JᵀJ + (μ + ε) I) δ = -(Jᵀ r + ε p),   r = y - target

Where a step lowers |r|² + ε |p|², μ falls to a third; where not, μ is quadrupled and the step is tried again. For a
thousand weights and a few thousand cases this ends far below what gradient descent reaches, in seconds.
Sources: Marquardt 1963; Hagan & Menhaj 1994.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.linalg import cho_factor, cho_solve

FIRST_DAMPING, LEAST_DAMPING, TRIES = 1e-2, 1e-12, 10
ENOUGH = 1e-4
"""Relative gain over TEN steps below which it has come to rest."""
TEN = 10


class Course(NamedTuple):
    """Units of each hidden layer, steps at most, and ε."""

    width: int
    steps: int
    decay: float


@dataclass(frozen=True)
class Weights:
    """Of one network."""

    first: Float[np.ndarray, "width inputs"]
    first_offset: Float[np.ndarray, " width"]
    second: Float[np.ndarray, "width width"]
    second_offset: Float[np.ndarray, " width"]
    last: Float[np.ndarray, " width"]
    last_offset: float


def fit_network(
    inputs: Float[np.ndarray, "cases inputs"],
    target: Float[np.ndarray, " cases"],
    course: Course,
    seed: tuple[int, ...],
    progress: Callable[[int, float], None] | None = None,
) -> Weights:
    """The network after its last step; each step is reported with the root mean square of r."""
    width, decay = course.width, course.decay
    generator = np.random.default_rng(seed)
    parameters = _start(generator, inputs.shape[1], width)
    damping = FIRST_DAMPING
    residual, jacobian = _linearised(parameters, inputs, target, width)
    costs = [_cost(residual, parameters, decay)]
    for step in range(1, course.steps + 1):
        square, slope = jacobian.T @ jacobian, jacobian.T @ residual + decay * parameters
        found = None
        for _ in range(TRIES):
            factor = cho_factor(square + (damping + decay) * np.eye(len(parameters)), overwrite_a=True)
            moved = parameters - cho_solve(factor, slope)
            if _cost(_values(moved, inputs, width) - target, moved, decay) < costs[-1]:
                found, damping = moved, max(damping / 3, LEAST_DAMPING)
                break
            damping *= 4
        if found is None:
            break
        parameters = found
        residual, jacobian = _linearised(parameters, inputs, target, width)
        costs.append(_cost(residual, parameters, decay))
        if progress is not None:
            progress(step, float(np.sqrt(np.square(residual).mean())))
        if len(costs) > TEN and costs[-1] > (1 - ENOUGH) * costs[-1 - TEN]:
            break
    return _unpacked(parameters, inputs.shape[1], width)


def _cost(residual: np.ndarray, parameters: np.ndarray, decay: float) -> float:
    return float(residual @ residual + decay * parameters @ parameters)


def _start(generator: np.random.Generator, inputs: int, width: int) -> np.ndarray:
    first = generator.normal(size=(width, inputs)) / np.sqrt(inputs)
    second = generator.normal(size=(width, width)) / np.sqrt(width)
    offsets = generator.normal(size=(2, width))
    last = generator.normal(size=width) / width
    return np.concatenate([first.ravel(), offsets[0], second.ravel(), offsets[1], last, [0.0]])


def _unpacked(parameters: np.ndarray, inputs: int, width: int) -> Weights:
    ends = np.cumsum([width * inputs, width, width * width, width, width])
    first, first_offset, second, second_offset, last, last_offset = np.split(parameters, ends)
    shaped = first.reshape(width, inputs), first_offset, second.reshape(width, width), second_offset
    return Weights(*shaped, last, float(last_offset[0]))


def _values(parameters: np.ndarray, inputs: np.ndarray, width: int) -> np.ndarray:
    p = _unpacked(parameters, inputs.shape[1], width)
    hidden = np.tanh(np.tanh(inputs @ p.first.T + p.first_offset) @ p.second.T + p.second_offset)
    return hidden @ p.last + p.last_offset


def _linearised(
    parameters: np.ndarray, inputs: np.ndarray, target: np.ndarray, width: int
) -> tuple[Float[np.ndarray, " cases"], Float[np.ndarray, "cases parameters"]]:
    """Residuals and their derivatives by the parameters."""
    p, cases = _unpacked(parameters, inputs.shape[1], width), len(inputs)
    first = np.tanh(inputs @ p.first.T + p.first_offset)
    second = np.tanh(first @ p.second.T + p.second_offset)
    at_second = (1 - second**2) * p.last
    at_first = (at_second @ p.second) * (1 - first**2)
    parts = [
        (at_first[:, :, None] * inputs[:, None, :]).reshape(cases, -1),
        at_first,
        (at_second[:, :, None] * first[:, None, :]).reshape(cases, -1),
        at_second,
        second,
        np.ones((cases, 1)),
    ]
    return second @ p.last + p.last_offset - target, np.concatenate(parts, axis=1)
