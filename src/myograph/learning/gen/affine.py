"""The affine map that suits the sensors best, as a step of a network: differentiable, and understood by ONNX.

    u(q) = mean(u) + C_uy C_yy^-1 y(q),   y = (p - mean(p)) / deviation of each axis,   C_yy = cov(y) + ridge

The inverse of the symmetric 3 x 3 matrix is written out by cofactors. The ridge keeps sensors in one plane, or fewer
than four of them, from doing harm.
"""

import torch
from jaxtyping import Float
from torch import Tensor

RIDGE = 1e-3
"""On the diagonal, over the variance [-]."""
TINY = 1e-9
"""Smallest variance along an axis [mm²], for a single sensor."""


def affine_map(
    points: Float[Tensor, "batch sensors 3"], values: Float[Tensor, "batch sensors 3"], queries: Tensor
) -> Float[Tensor, "batch queries 3"]:
    """Values at the queries (batch, queries, 3) by least squares on those at the points."""
    middle, mean = points.mean(dim=1, keepdim=True), values.mean(dim=1, keepdim=True)
    spread = (points - middle).square().mean(dim=1, keepdim=True).clamp_min(TINY).sqrt()
    y, u = (points - middle) / spread, values - mean
    among = y.transpose(1, 2) @ y / y.shape[1] + RIDGE * torch.eye(3, device=y.device)
    across = y.transpose(1, 2) @ u / y.shape[1]
    return mean + (queries - middle) / spread @ (inverse(among) @ across)


def inverse(matrix: Float[Tensor, "batch 3 3"]) -> Float[Tensor, "batch 3 3"]:
    """Inverse of 3 x 3 matrices: rows of the cofactors are cross products of the columns."""
    a, b, c = matrix.unbind(dim=-1)
    cofactors = torch.stack([_cross(b, c), _cross(c, a), _cross(a, b)], dim=-2)
    return cofactors / (a * cofactors[..., 0, :]).sum(dim=-1)[..., None, None]


def _cross(a: Float[Tensor, "batch 3"], b: Float[Tensor, "batch 3"]) -> Float[Tensor, "batch 3"]:
    return a.roll(-1, dims=-1) * b.roll(1, dims=-1) - a.roll(1, dims=-1) * b.roll(-1, dims=-1)
