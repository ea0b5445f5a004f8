"""One field as mean and modes at the nodes, the modes' amounts as a surface over (x, u)."""

from typing import NamedTuple

import torch
from jaxtyping import Float, Int
from torch import Tensor, nn

from myograph.learning.modes.chebyshev import chebyshev, products
from myograph.learning.modes.config import FieldShape


class Shapes(NamedTuple):
    """Mean and modes at some nodes, flattened, and what neither explains there: root mean square over the cases."""

    mean: Float[Tensor, " values"]
    modes: Float[Tensor, "values modes"]
    misfit: Float[Tensor, " points"]


class FieldModes(nn.Module):
    """Blank until its buffers are filled."""

    mean: Tensor
    modes: Tensor
    weights: Tensor
    spread: Tensor
    left_over: Tensor
    misfit: Tensor

    def __init__(self, shape: FieldShape, nodes: int, kept: torch.dtype = torch.float32) -> None:
        super().__init__()
        self.shape = shape
        terms = (shape.degrees[0] + 1) * (shape.degrees[1] + 1)
        self.register_buffer("mean", torch.zeros(nodes, shape.components))
        self.register_buffer("modes", torch.zeros(nodes, shape.components, shape.modes, dtype=kept))
        self.register_buffer("weights", torch.zeros(terms, shape.modes, dtype=torch.float64))
        self.register_buffer("spread", torch.ones(shape.modes))
        self.register_buffer("left_over", torch.ones(shape.modes))
        self.register_buffer("misfit", torch.zeros(nodes))

    def tangent(self, place: Float[Tensor, "batch 2"]) -> Float[Tensor, "batch 3 modes"]:
        """Amounts of the modes at a place (x, u), and their slopes along x and along u."""
        return products(place, self.shape.degrees) @ self.weights

    def grid(self, x: Float[Tensor, " first"], u: Float[Tensor, " second"]) -> Float[Tensor, "points modes"]:
        """Amounts at all places (x, u) of a grid, those of the first x first; no product of all terms is kept."""
        first, second = chebyshev(x, self.shape.degrees[0])[0], chebyshev(u, self.shape.degrees[1])[0]
        along_u = second @ self.weights.unflatten(0, (self.shape.degrees[0] + 1, -1))
        return torch.tensordot(first, along_u, dims=1).flatten(0, 1)

    def at(self, nodes: Int[Tensor, " points"]) -> Shapes:
        """Mean and modes at these nodes."""
        mean, modes, misfit = (part.index_select(0, nodes) for part in (self.mean, self.modes, self.misfit))
        return Shapes(mean.flatten(), modes.flatten(0, 1).float(), misfit)

    def carried(self, amounts: Float[Tensor, "batch some modes"]) -> Float[Tensor, "batch some nodes components"]:
        """What these amounts of the modes, or changes of them, make of the field at all nodes; without its mean.

        A product with constants is the fastest that a network can do: nodes that are asked are taken out of the result.
        """
        flat = amounts.flatten(0, 1) @ self.modes.flatten(0, 1).float().T
        return flat.reshape(-1, amounts.shape[1], *self.mean.shape)
