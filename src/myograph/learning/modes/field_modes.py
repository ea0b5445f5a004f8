"""One field as mean and modes at the nodes, the modes' amounts as a surface over (x, u)."""

from typing import NamedTuple

import torch
from jaxtyping import Float, Int
from torch import Tensor, nn

from myograph.learning.modes.chebyshev import chebyshev, products
from myograph.learning.modes.config import FieldShape


class Tangent(NamedTuple):
    """Amounts of the modes at a place (x, u), and their slopes along x and along u."""

    amounts: Float[Tensor, "batch modes"]
    along_x: Float[Tensor, "batch modes"]
    along_u: Float[Tensor, "batch modes"]


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

    def tangent(self, place: Float[Tensor, "batch 2"]) -> Tangent:
        """Amounts and slopes."""
        return Tangent(*(terms @ self.weights for terms in products(place, self.shape.degrees)))

    def grid(self, x: Float[Tensor, " first"], u: Float[Tensor, " second"]) -> Float[Tensor, "points modes"]:
        """Amounts at all places (x, u) of a grid, those of the first x first; no product of all terms is kept."""
        first, second = chebyshev(x, self.shape.degrees[0])[0], chebyshev(u, self.shape.degrees[1])[0]
        along_u = second @ self.weights.unflatten(0, (self.shape.degrees[0] + 1, -1))
        return torch.tensordot(first, along_u, dims=1).flatten(0, 1)

    def at(self, nodes: Int[Tensor, " points"]) -> Shapes:
        """Mean and modes at these nodes."""
        modes = self.modes[nodes].flatten(0, 1).float()
        return Shapes(self.mean[nodes].flatten(), modes, self.misfit[nodes])

    def values(self, amounts: Float[Tensor, "batch modes"], shapes: Shapes) -> Float[Tensor, "batch points components"]:
        """The field of these amounts."""
        flat = torch.addmm(shapes.mean, amounts, shapes.modes.T)
        return flat.unflatten(-1, (-1, self.shape.components))

    def changes(
        self, amounts: Float[Tensor, "batch modes"], shapes: Shapes
    ) -> Float[Tensor, "batch points components"]:
        """What these changes of the amounts change."""
        flat = amounts @ shapes.modes.T
        return flat.unflatten(-1, (-1, self.shape.components))
