r"""Barycentric coordinates of points in the simplices of a triangulation.

    p = sum_c w_c x_c,  sum_c w_c = 1   over the corners c of the simplex around p

A point outside of all takes the simplex in which its smallest coordinate is largest, its coordinates clamped at zero
and made to sum to one. SciPy walks to the simplex of each point; while torch exports, all simplices are tried instead,
and their corners are constants.
"""

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor

from myograph.learning.gen.mesh import Triangulation
from myograph.learning.gen.representer import FewShares


def barycentric_shares(
    points: Float[Tensor, "batch points axes"], nodes: Float[Tensor, "nodes axes"], triangulation: Triangulation
) -> FewShares:
    """Shares of the points in the corners of their simplices; differentiable in points and nodes."""
    simplices = torch.tensor(triangulation.simplices.astype(np.int64), device=nodes.device)
    if torch.compiler.is_exporting():
        chosen = _by_trying_all(points, _maps(triangulation).to(points))
        maps = _maps(triangulation).to(points)[chosen]
    else:
        chosen = _by_walking(points, triangulation)
        corners = nodes[simplices]
        maps = torch.linalg.inv(_with_ones(corners))[chosen]
    weights = (_with_ones(points)[..., None, :] @ maps)[..., 0, :].clamp_min(0)
    weights = weights / weights.sum(dim=-1, keepdim=True)
    return FewShares(weights, simplices[chosen], len(nodes))


def _with_ones(x: Float[Tensor, "*batch axes"]) -> Float[Tensor, "*batch corners"]:
    return torch.cat([x, torch.ones_like(x[..., :1])], dim=-1)


def _maps(triangulation: Triangulation) -> Float[Tensor, "simplices corners corners"]:
    """What takes (p, 1) to the coordinates of p, in each simplex."""
    corners = triangulation.points[triangulation.simplices]
    inverse = np.linalg.inv(np.concatenate([corners, np.ones_like(corners[..., :1])], axis=-1))
    return torch.tensor(inverse, dtype=torch.float32)


def _by_walking(
    points: Float[Tensor, "batch points axes"], triangulation: Triangulation
) -> Int[Tensor, "batch points"]:
    places = points.detach().cpu().double().numpy()
    chosen = triangulation.find_simplex(places).astype(np.int64)
    outside = chosen < 0
    if outside.any():
        lost = torch.tensor(places[outside], dtype=torch.float32)
        chosen[outside] = _by_trying_all(lost, _maps(triangulation)).numpy()
    return torch.tensor(chosen, device=points.device)


def _by_trying_all(
    points: Float[Tensor, "*batch axes"], maps: Float[Tensor, "simplices corners corners"]
) -> Int[Tensor, "*batch"]:
    coordinates = torch.einsum("...a,sac->...sc", _with_ones(points), maps)
    return coordinates.amin(dim=-1).argmax(dim=-1)
