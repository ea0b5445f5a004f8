"""Graph element network: a function sampled at sensors goes in, a function of any query point comes out.

    encoder      e_i = MLP(cat(p_i, value_i))
    representer  r(p, n) = softmax over the nodes n of -exp(s) |p - x_n|²
    aggregation  h_n = sum_i r(p_i, n) e_i        ('sum'), divided by sum_i r(p_i, n) ('mean')
    processor    h <- LayerNorm(h + GCN(cat(x, h))), T rounds, shared weights
    decoder      answer(q) = MLP(cat(sum_n r(q, n) h_n, q))

Convention: space is the unit box; the MLPs see it centred and over half its shortest side, so that a long body's
thickness does not drown in its length.
Trap: thesis listing 5.2 takes the softmax of *plus* distance, so that the farthest node wins (`legacy_sign`).
Sources: Alet et al. 2019; Kipf & Welling 2017 for the graph convolution.
"""

import math
import warnings
from itertools import pairwise

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.learning.config import NetworkConfig
from myograph.learning.graph_convolution import GraphConvolution, symmetric_matrix
from myograph.learning.mesh import delaunay_edges, grid_nodes, normalised_adjacency


def mlp(widths: list[int]) -> nn.Sequential:
    """Linear layers of these widths, ReLU between them, the last one linear."""
    layers: list[nn.Module] = []
    for inputs, outputs in pairwise(widths):
        layers += [nn.Linear(inputs, outputs), nn.ReLU()]
    return nn.Sequential(*layers[:-1])


def nearness(
    points: Float[Tensor, "batch points axes"], nodes: Float[Tensor, "nodes axes"], sharpness: Float[Tensor, ""]
) -> Float[Tensor, "batch points nodes"]:
    """exp(s) (|p|² - |p - x_n|²) [-]: its softmax over the nodes is the representer, as |p|² drops out.

    A negative `sharpness` exp(s) lets the farthest node win.
    """
    flat = torch.addmm(-sharpness * nodes.square().sum(dim=-1), 2 * sharpness * points.flatten(0, 1), nodes.T)
    return flat.view(*points.shape[:2], len(nodes))


class GraphElementNetwork(nn.Module):
    """One encoder, one graph, one decoder, in a space of any dimension.

    Parameters
    ----------
    sides
        Of the box that the graph fills at first, the longest 1 [-]; their number is the dimension of the space.
    values, outputs
        Numbers of values at a sensor, beside its position, and at a query.
    seed
        Of the graph's first nodes and the weights.
    """

    nodes: nn.Parameter
    centre: Tensor

    def __init__(
        self, config: NetworkConfig, sides: Float[np.ndarray, " axes"], values: int, outputs: int, seed: int
    ) -> None:
        super().__init__()
        if config.latent == 1:
            warnings.warn(
                "LayerNorm over a latent of size 1 is constant: this network cannot see its input", stacklevel=2
            )
        axes, latent, rounds = len(sides), config.latent, config.message_rounds
        self.config = config
        with torch.random.fork_rng(devices=[]):
            torch.manual_seed(seed)
            self.encoder = mlp([axes + values, *config.hidden, latent])
            self.convolution = GraphConvolution(axes, latent, gain=1 / rounds)
            self.norm = nn.LayerNorm(latent)
            self.decoder = mlp([latent + axes, *config.hidden, outputs])
        spacing = float(np.mean(sides)) / (config.nodes_per_axis - 1)
        self.log_sharpness = nn.Parameter(torch.tensor(-2 * math.log(spacing)))
        self.nodes = nn.Parameter(torch.tensor(grid_nodes(config.nodes_per_axis, sides, seed), dtype=torch.float32))
        self.register_buffer("centre", torch.tensor(sides / 2, dtype=torch.float32), persistent=False)
        self.half_thickness = float(sides.min()) / 2
        self.triangulate()

    @property
    def weight_count(self) -> int:
        """Number of learned numbers, without the node positions."""
        return sum(parameter.numel() for parameter in self.parameters()) - self.nodes.numel()

    def triangulate(self) -> None:
        """Join the nodes anew, where they are now."""
        nodes = self.nodes.detach().double().numpy()
        self.adjacency = symmetric_matrix(normalised_adjacency(delaunay_edges(nodes), len(nodes)))

    def shares(self, points: Float[Tensor, "batch points axes"]) -> Float[Tensor, "batch points nodes"]:
        """Share of each graph node in each point, the representer [-]; the shares of a point sum to one."""
        return self._nearness(points).softmax(dim=-1)

    def _nearness(self, points: Float[Tensor, "batch points axes"]) -> Float[Tensor, "batch points nodes"]:
        sign = -1.0 if self.config.legacy_sign else 1.0
        return nearness(points, self.nodes, sign * self.log_sharpness.exp())

    def _weights(self, points: Float[Tensor, "batch sensors axes"]) -> Float[Tensor, "batch sensors nodes"]:
        """Weight of each sensor in each graph node [-]; for the mean in logarithms, as shares may underflow."""
        if self.config.aggregation == "sum":
            return self.shares(points)
        return self._nearness(points).log_softmax(dim=-1).softmax(dim=1)

    def seen(self, points: Float[Tensor, "batch points axes"]) -> Float[Tensor, "batch points axes"]:
        """Coordinates as the MLPs see them [-]."""
        return (points - self.centre) / self.half_thickness

    def forward(
        self,
        points: Float[Tensor, "batch sensors axes"],
        values: Float[Tensor, "batch sensors values"],
        queries: Float[Tensor, "batch queries axes"],
    ) -> Float[Tensor, "batch queries outputs"]:
        """Answers at the queries; `points` are the places of the sensors, both in the unit box [-]."""
        encoded = self.encoder(torch.cat([self.seen(points), values], dim=-1))
        state = torch.einsum("bsn,bsk->nbk", self._weights(points), encoded)
        places = self.convolution.places(self.nodes, self.adjacency)
        for _ in range(self.config.message_rounds):
            state = self.norm(state + self.convolution(state, places, self.adjacency))
        at_queries = torch.einsum("bqn,nbk->bqk", self.shares(queries), state)
        return self.decoder(torch.cat([at_queries, self.seen(queries)], dim=-1))
