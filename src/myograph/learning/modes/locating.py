r"""Where on the surface of all shapes a muscle is: Gauss-Newton on (x, u) from what is known of both and of sensors.

    minimise  |y - Φ c(x, u)|² / σ² + (x - x₀)² p_x + (u - u₀)² p_u

y is how far sensors are from their mean places [mm], σ their noise; (x₀, u₀) and the precisions p say what is known
beforehand: what the activations say, or, without them, that training cases lie within ±1. The number of steps is
fixed, so that the whole can be differentiated and exported; the inverse of the last matrix is the covariance of (x, u).

Trap: far from the answer Gauss-Newton may run off to another shape, or beyond training; without activations the start
is the best of a grid, and no step is longer than two of its cells.
"""

from typing import NamedTuple

import torch
from jaxtyping import Float
from torch import Tensor

from myograph.learning.modes.chebyshev import RANGE, products
from myograph.learning.modes.field_modes import FieldModes, Shapes

STEPS = 6
GRID = (25, 9)
LONGEST = (0.15, 0.45)
"""Of a step, along x and u: two cells of the grid."""
LIMIT = 1.1 * RANGE
"""How far x may go, a little beyond training; u may not leave its range at all."""


class Known(NamedTuple):
    """What is known of (x, u) before sensors are looked at, and one over its variance."""

    place: Float[Tensor, "batch 2"]
    precision: Float[Tensor, "batch 2"]


class Located(NamedTuple):
    """(x, u), and the lower triangle of the root of its covariance: (ll, 2 1, 2 2)."""

    place: Float[Tensor, "batch 2"]
    root: Float[Tensor, "batch 3"]


def nothing_known(like: Float[Tensor, "batch ..."]) -> Known:
    """Only that cases lie around zero, within about one."""
    return Known(like.new_zeros(like.shape[0], 2), like.new_ones(like.shape[0], 2))


def best_of_grid(moved: Float[Tensor, "batch values"], field: FieldModes, sensors: Shapes) -> Float[Tensor, "batch 2"]:
    """The place of a grid whose shape is nearest to the sensors; single precision is enough for a start."""
    x, u = (torch.linspace(-RANGE, RANGE, count, dtype=moved.dtype, device=moved.device) for count in GRID)
    places = torch.cartesian_prod(x, u)
    shapes = field.grid(x, u).float() @ sensors.modes.float().T
    apart = shapes.square().sum(dim=-1) - 2 * moved.float() @ shapes.T
    return places[apart.argmin(dim=-1)]


def locate(
    moved: Float[Tensor, "batch values"],
    start: Float[Tensor, "batch 2"],
    known: Known,
    field: FieldModes,
    sensors: Shapes,
    noise: float,
) -> Located:
    """The place after the last step.

    With  R = (Φ c - y) / σ  and its slopes along x and u, a step takes the products of the slopes with all three.
    """
    seen = field.weights @ sensors.modes.T / noise
    told = torch.nn.functional.pad(moved.unsqueeze(1) / noise, (0, 0, 0, 2))
    prior = known.precision.unsqueeze(-1) * start.new_tensor([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    place, normal, largest = start, prior, start.new_tensor([LIMIT, RANGE])
    longest = start.new_tensor(LONGEST)
    for _ in range(STEPS):
        missed = products(place, field.shape.degrees) @ seen - told
        normal = (missed[:, 1:].unsqueeze(2) * missed.unsqueeze(1)).sum(dim=-1) + prior
        step = _solve(normal, known.precision * (place - known.place))
        place = place - step.clamp(-longest, longest)
        place = place.clamp(-largest, largest)
    return Located(place, _root_of_inverse(normal))


def _solve(normal: Float[Tensor, "batch 2 3"], pull: Float[Tensor, "batch 2"]) -> Float[Tensor, "batch 2"]:
    """Of the symmetric matrix in the last two columns, for the sum of the first column and the pull."""
    first, a, b, second, _, c = normal.flatten(1).split(1, dim=1)
    beside = pull.split(1, dim=1)
    slope = b / a
    y = (second + beside[1] - slope * (first + beside[0])) / (c - slope * b)
    return torch.cat([(first + beside[0] - b * y) / a, y], dim=1)


def _root_of_inverse(normal: Float[Tensor, "batch 2 3"]) -> Float[Tensor, "batch 3"]:
    """L of L Lᵀ = inverse of the matrix in the last two columns."""
    _, a, b, _, _, c = normal.flatten(1).split(1, dim=1)
    left = c - b * b / a
    first = (1 / a + (b / a).square() / left).sqrt()
    return torch.cat([first, -b / a / left / first, c.rsqrt()], dim=1)
