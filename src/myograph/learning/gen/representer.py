"""How points share in the nodes of a graph: the representer.

    dense         r(p, n) = softmax over the nodes n of -exp(s_n) |p - x_n|²
    nearest       the same, over the k nodes with the largest score
    barycentric   coordinates of p in the simplex of the triangulation around it

Shares of a point sum to one. `collect` gives points the mean of the nodes by their shares; `spread` gives every node
the sum of the points by their shares, or that sum over the shares that it received.
Trap: thesis listing 5.2 takes the softmax of *plus* distance, so that the farthest node wins (`legacy_sign`).
Sources: Alet et al. 2019.
"""

from dataclasses import dataclass
from typing import Literal

from jaxtyping import Float, Int
from torch import Tensor

SMALLEST = 1e-12
"""Received shares count as this at least; not added, as an exporter to ONNX takes such a summand for zero."""


@dataclass(frozen=True)
class DenseShares:
    """Shares in all nodes, from their scores: softmax over the nodes, or over the points (`over_points`, a trap).

    The mean is computed with logarithms, as shares may underflow.
    """

    scores: Float[Tensor, "batch points nodes"]
    over_points: bool = False

    @property
    def weights(self) -> Float[Tensor, "batch points nodes"]:
        """The shares [-]."""
        return self.scores.softmax(dim=1 if self.over_points else 2)

    def collect(self, state: Float[Tensor, "nodes batch latent"]) -> Float[Tensor, "batch points latent"]:
        """What the nodes say at the points."""
        return self.weights @ state.transpose(0, 1)

    def spread(
        self, encoded: Float[Tensor, "batch points latent"], aggregation: Literal["sum", "mean"]
    ) -> Float[Tensor, "nodes batch latent"]:
        """What the points say to the nodes."""
        sums = aggregation == "sum" or self.over_points
        weights = self.weights if sums else self.scores.log_softmax(dim=2).softmax(dim=1)
        return (weights.transpose(1, 2) @ encoded).transpose(0, 1)


@dataclass(frozen=True)
class FewShares:
    """Shares in some nodes of `count`, by their indices; nodes in which no point shares get zero."""

    weights: Float[Tensor, "batch points some"]
    indices: Int[Tensor, "batch points some"]
    count: int

    def collect(self, state: Float[Tensor, "nodes batch latent"]) -> Float[Tensor, "batch points latent"]:
        """What the nodes say at the points."""
        by_pair = state.transpose(0, 1)
        index = self.indices.flatten(1)[..., None].expand(-1, -1, state.shape[-1])
        found = by_pair.gather(1, index).view(*self.indices.shape, state.shape[-1])
        return (self.weights[..., None] * found).sum(dim=2)

    def spread(
        self, encoded: Float[Tensor, "batch points latent"], aggregation: Literal["sum", "mean"]
    ) -> Float[Tensor, "nodes batch latent"]:
        """What the points say to the nodes."""
        told = (self.weights[..., None] * encoded[:, :, None, :]).flatten(1, 2)
        state = self._sums(told)
        if aggregation == "mean":
            state = state / self._sums(self.weights.flatten(1)[..., None]).clamp_min(SMALLEST)
        return state.transpose(0, 1)

    def _sums(self, told: Float[Tensor, "batch told latent"]) -> Float[Tensor, "batch nodes latent"]:
        zeros = told.new_zeros(told.shape[0], self.count, told.shape[2])
        return zeros.scatter_add(1, self.indices.flatten(1)[..., None].expand_as(told), told)


Shares = DenseShares | FewShares


def scores(
    points: Float[Tensor, "batch points axes"], nodes: Float[Tensor, "nodes axes"], sharpness: Float[Tensor, "*nodes"]
) -> Float[Tensor, "batch points nodes"]:
    """-exp(s_n) |p - x_n|² [-]; a negative `sharpness` exp(s) lets the farthest node win."""
    squares = points.square().sum(dim=-1, keepdim=True) + nodes.square().sum(dim=-1)
    return sharpness * (2 * points @ nodes.T - squares)


def nearest_shares(scored: Float[Tensor, "batch points nodes"], nearest: int) -> FewShares:
    """Softmax over the nodes with the largest scores."""
    largest, indices = scored.topk(min(nearest, scored.shape[-1]), dim=-1)
    return FewShares(largest.softmax(dim=-1), indices, scored.shape[-1])
