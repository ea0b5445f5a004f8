"""PyTorch Geometric's convolutions as processors: one layer on cat(x, h), from (axes + latent) to latent features.

The batch becomes one graph of many parts that are not joined, which every convolution understands.
PyTorch Geometric is optional and is imported only here.
"""

from typing import Any

import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.errors import MissingPackageError
from myograph.learning.gen.graph import Graph

SETTINGS: dict[str, dict[str, Any]] = {
    "GCNConv": {},
    "ChebConv": {"K": 3},
    "SAGEConv": {},
    "GATv2Conv": {"heads": 4, "concat": False},
    "GraphConv": {},
    "TAGConv": {"K": 2},
    "TransformerConv": {"heads": 4, "concat": False},
}
"""Convolution -> what it is given beside the numbers of features."""


class GeometricConvolution(nn.Module):
    """A convolution by its name in PyTorch Geometric; raises MissingPackageError without that package."""

    def __init__(self, name: str, axes: int, latent: int) -> None:
        super().__init__()
        try:
            import torch_geometric.nn as geometric
        except ImportError:
            raise MissingPackageError("torch-geometric", "train", f"the processor '{name}'") from None
        self.convolution = getattr(geometric, name)(axes + latent, latent, **SETTINGS[name])

    def prepare(self, places: Float[Tensor, "nodes axes"], graph: Graph) -> Float[Tensor, "nodes 1 axes"]:
        """The places."""
        return places[:, None, :]

    def forward(
        self, state: Float[Tensor, "nodes batch latent"], prepared: Float[Tensor, "nodes 1 axes"], graph: Graph
    ) -> Float[Tensor, "nodes batch latent"]:
        """One convolution in every part of the batch."""
        nodes, batch, _ = state.shape
        both = torch.cat([prepared.expand(-1, batch, -1), state], dim=-1).transpose(0, 1)
        first = nodes * torch.arange(batch, device=state.device)
        edges = (graph.edges[:, None, :] + first[None, :, None]).flatten(1)
        return self.convolution(both.flatten(0, 1), edges).view(batch, nodes, -1).transpose(0, 1)
