"""Graph convolution of Kipf & Welling on nodes that have a place and a state.

    GCN(cat(x, h)) = Â cat(x, h) W + b = Â x W_x + b + Â h W_h,   Â = D^-1/2 (A + 1) D^-1/2

The places x do not change between the rounds of a processor, so that their part is computed once.
Convention: states lie as (nodes, batch, latent), which makes Â h one sparse product.
Source: Kipf & Welling 2017.
"""

import warnings
from typing import Any

import torch
from jaxtyping import Float
from scipy.sparse import csr_array
from torch import Tensor, nn


class _SymmetricProduct(torch.autograd.Function):
    """A x for a fixed symmetric sparse A. Its derivative is A again, which spares torch the transposition."""

    @staticmethod
    def forward(ctx: Any, matrix: Tensor, x: Tensor) -> Tensor:
        ctx.matrix = matrix
        return matrix @ x

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[None, Tensor]:
        return None, ctx.matrix @ gradients[0]


def product(matrix: Tensor, x: Float[Tensor, "nodes columns"]) -> Float[Tensor, "nodes columns"]:
    """A x for a fixed symmetric sparse A (nodes, nodes); differentiable in x."""
    return _SymmetricProduct.apply(matrix, x)  # pyright: ignore[reportReturnType]


def symmetric_matrix(matrix: csr_array) -> Tensor:
    """The symmetric sparse matrix in torch's own format, float32."""
    values = torch.tensor(matrix.data, dtype=torch.float32)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Sparse")
        rows, columns = torch.tensor(matrix.indptr), torch.tensor(matrix.indices)
        return torch.sparse_csr_tensor(rows, columns, values, matrix.shape, check_invariants=True)


class GraphConvolution(nn.Module):
    """One layer, from (axes + latent) to latent features.

    Parameters
    ----------
    gain
        Factor on the first weights: 1 / rounds keeps many rounds of one layer from washing the states out.
    """

    def __init__(self, axes: int, latent: int, gain: float) -> None:
        super().__init__()
        self.axes = axes
        self.weight = nn.Parameter(nn.init.xavier_uniform_(torch.empty(axes + latent, latent), gain))
        self.bias = nn.Parameter(torch.zeros(latent))

    def places(self, nodes: Float[Tensor, "nodes axes"], adjacency: Tensor) -> Float[Tensor, "nodes 1 latent"]:
        """What places and bias add in every round."""
        return (product(adjacency, nodes @ self.weight[: self.axes]) + self.bias)[:, None, :]

    def forward(
        self, state: Float[Tensor, "nodes batch latent"], places: Float[Tensor, "nodes 1 latent"], adjacency: Tensor
    ) -> Float[Tensor, "nodes batch latent"]:
        """One convolution; `places` come from the method of that name."""
        mixed = state @ self.weight[self.axes :]
        return product(adjacency, mixed.flatten(1)).view_as(mixed) + places
