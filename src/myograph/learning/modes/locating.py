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

from myograph.learning.modes.chebyshev import RANGE
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
    """The place of a grid whose shape is nearest to the sensors."""
    x, u = (torch.linspace(-RANGE, RANGE, count, dtype=moved.dtype, device=moved.device) for count in GRID)
    places = torch.cartesian_prod(x, u)
    shapes = field.grid(x, u) @ sensors.modes.T
    apart = shapes.square().sum(dim=-1) - 2 * moved @ shapes.T
    return places[apart.argmin(dim=-1)]


def locate(
    moved: Float[Tensor, "batch values"],
    start: Float[Tensor, "batch 2"],
    known: Known,
    field: FieldModes,
    sensors: Shapes,
    noise: float,
) -> Located:
    """The place after the last step."""
    place, normal, largest = start, known.precision, start.new_tensor([LIMIT, RANGE])
    longest = start.new_tensor(LONGEST)
    for _ in range(STEPS):
        tangent = field.tangent(place)
        missed = (moved - tangent.amounts @ sensors.modes.T) / noise
        along_x, along_u = (slope @ sensors.modes.T / noise for slope in tangent[1:])
        normal = _normal(along_x, along_u, known.precision)
        pull = torch.stack([(along_x * missed).sum(dim=-1), (along_u * missed).sum(dim=-1)], dim=-1)
        step = _solve(normal, pull + known.precision * (known.place - place))
        place = place + step.clamp(-longest, longest)
        place = place.clamp(-largest, largest)
    return Located(place, _root_of_inverse(normal))


def _normal(
    along_x: Float[Tensor, "batch values"], along_u: Float[Tensor, "batch values"], precision: Float[Tensor, "batch 2"]
) -> Float[Tensor, "batch 3"]:
    """Of the symmetric matrix: 1 1, 2 1, 2 2."""
    return torch.stack(
        [
            along_x.square().sum(dim=-1) + precision[:, 0],
            (along_x * along_u).sum(dim=-1),
            along_u.square().sum(dim=-1) + precision[:, 1],
        ],
        dim=-1,
    )


def _solve(normal: Float[Tensor, "batch 3"], right: Float[Tensor, "batch 2"]) -> Float[Tensor, "batch 2"]:
    a, b, c = normal.unbind(dim=-1)
    first, second = right.unbind(dim=-1)
    slope = b / a
    y = (second - slope * first) / (c - slope * b)
    return torch.stack([(first - b * y) / a, y], dim=-1)


def _root_of_inverse(normal: Float[Tensor, "batch 3"]) -> Float[Tensor, "batch 3"]:
    """L of L Lᵀ = inverse."""
    a, b, c = normal.unbind(dim=-1)
    left = c - b * b / a
    first = (1 / a + (b / a).square() / left).sqrt()
    return torch.stack([first, -b / a / left / first, c.rsqrt()], dim=-1)
