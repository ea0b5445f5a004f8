"""One field as mean and modes at the nodes, the modes' amounts as a surface over (x, u)."""

from typing import NamedTuple

import torch
from jaxtyping import Float, Int
from torch import Tensor, nn

from myograph.learning.modes.chebyshev import products
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

    def __init__(self, shape: FieldShape, nodes: int) -> None:
        super().__init__()
        self.shape = shape
        terms = (shape.degrees[0] + 1) * (shape.degrees[1] + 1)
        self.register_buffer("mean", torch.zeros(nodes, shape.components))
        self.register_buffer("modes", torch.zeros(nodes, shape.components, shape.modes))
        self.register_buffer("weights", torch.zeros(terms, shape.modes))
        self.register_buffer("spread", torch.ones(shape.modes))
        self.register_buffer("left_over", torch.ones(shape.modes))
        self.register_buffer("misfit", torch.zeros(nodes))

    def tangent(self, place: Float[Tensor, "batch 2"]) -> Tangent:
        """Amounts and slopes."""
        return Tangent(*(terms @ self.weights.double() for terms in products(place, self.shape.degrees)))

    def at(self, nodes: Int[Tensor, " points"]) -> Shapes:
        """Mean and modes at these nodes."""
        modes = self.modes[nodes].flatten(0, 1)
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
