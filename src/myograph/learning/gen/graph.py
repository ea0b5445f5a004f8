"""The graph in torch: edges, adjacency and simplices of nodes where they are now; built anew after they move.

Trap: a sparse product cannot be exported; while torch traces, the dense adjacency takes its place.
"""

import dataclasses
import warnings
from typing import Any

import numpy as np
import torch
from jaxtyping import Float, Int
from scipy.sparse import csr_array
from torch import Tensor

from myograph.learning.gen.mesh import Triangulation, edges_of, normalised_adjacency, triangulate
from myograph.learning.gen.precision import single


class _SymmetricProduct(torch.autograd.Function):
    """A x for a fixed symmetric sparse A. Its derivative is A again, which spares torch the transposition."""

    @staticmethod
    def forward(ctx: Any, matrix: Tensor, x: Tensor) -> Tensor:
        ctx.matrix = matrix
        return matrix @ x

    @staticmethod
    def backward(ctx: Any, *gradients: Tensor) -> tuple[None, Tensor]:
        return None, ctx.matrix @ gradients[0]


@dataclasses.dataclass(frozen=True)
class Graph:
    """Fixed neighbourhood of the nodes.

    Parameters
    ----------
    edges
        Sender and receiver; every edge stands both ways.
    sparse, dense
        Normalised adjacency with self loops.
    neighbours
        Number of each node's neighbours.
    triangulation
        Of the nodes.
    """

    edges: Int[Tensor, "2 edges"]
    sparse: Tensor
    dense: Float[Tensor, "nodes nodes"]
    neighbours: Float[Tensor, " nodes"]
    triangulation: Triangulation

    def __deepcopy__(self, _: Any) -> "Graph":
        """Itself: nothing in it ever changes, and torch cannot copy sparse matrices."""
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        """For another process: without the sparse matrix, which torch puts together with warnings."""
        return _put_together, (self.edges, self.dense, self.neighbours, self.triangulation)

    def on(self, device: torch.device) -> "Graph":
        """The graph on this device."""
        if self.dense.device == device:
            return self
        edges, sparse = self.edges.to(device), self.sparse.to(device)
        return Graph(edges, sparse, self.dense.to(device), self.neighbours.to(device), self.triangulation)

    def smooth(self, x: Float[Tensor, "nodes ..."]) -> Float[Tensor, "nodes ..."]:
        """Product of the adjacency and x, in single precision, as sparse ones have no other; differentiable in x."""
        flat = x.flatten(1)
        if flat.dtype != self.dense.dtype:
            flat = flat.to(self.dense.dtype)
        with single(flat):
            if torch.compiler.is_compiling():
                return (self.dense @ flat).view_as(x)
            return _SymmetricProduct.apply(self.sparse, flat).view_as(x)  # pyright: ignore[reportAttributeAccessIssue]


def graph_of(nodes: Float[np.ndarray, "nodes axes"], corners: int | None = None) -> Graph:
    """The graph of the nodes; raises InputError where they span no volume.

    Parameters
    ----------
    corners
        Only so many corners of each simplex are joined: 3 is a trap.
    """
    triangulation = triangulate(nodes)
    edges = edges_of(triangulation, corners)
    both_ways = np.concatenate([edges, edges[:, ::-1]]).T
    adjacency = normalised_adjacency(edges, len(nodes))
    dense = torch.tensor(adjacency.toarray(), dtype=torch.float32)
    neighbours = torch.tensor(np.bincount(edges.ravel(), minlength=len(nodes)).clip(1), dtype=torch.float32)
    return Graph(torch.tensor(both_ways.copy()), sparse_matrix(adjacency), dense, neighbours, triangulation)


def _put_together(
    edges: Int[Tensor, "2 edges"],
    dense: Float[Tensor, "nodes nodes"],
    neighbours: Float[Tensor, " nodes"],
    triangulation: Triangulation,
) -> Graph:
    sparse = sparse_matrix(csr_array(dense.cpu().numpy())).to(dense.device)
    return Graph(edges, sparse, dense, neighbours, triangulation)


def sparse_matrix(matrix: csr_array) -> Tensor:
    """The sparse matrix in torch's own format, float32."""
    values = torch.tensor(matrix.data, dtype=torch.float32)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Sparse")
        rows, columns = torch.tensor(matrix.indptr), torch.tensor(matrix.indices)
        return torch.sparse_csr_tensor(rows, columns, values, matrix.shape, check_invariants=True)
