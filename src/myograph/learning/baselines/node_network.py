r"""The thesis's feed-forward network: activations in, a field at a fixed set of nodes out.

    widths   n_i = n_0 (n_6/n_0)^(i/6), i = 1..5: five hidden layers that grow exponentially
             from n_0 = 5 activations to n_6 = 3 numbers at each answered node
    answer   mean(node) + spread · network(2a - 1), ReLU between the layers

Each asked field has a network of its own. It answers at all nodes, or at those of the surface only, as in the thesis:
2,809 nodes of 4,027.
Trap: the thesis gives no widths beyond 'exponential growth'; a constant ratio is the plain reading.
Source: thesis section 6.1 and figure 6.1.
"""

from collections.abc import Mapping
from typing import Any, final

import numpy as np
import torch
from jaxtyping import Float, Int
from pydantic import Field
from torch import Tensor, nn

from myograph.config import Model, parse
from myograph.errors import InputError
from myograph.learning.baselines.by_cases import spread_of
from myograph.learning.baselines.taught import Taught, components_of
from myograph.learning.gen.perceptron import perceptron


class FeedForwardConfig(Model):
    """Settings of the network.

    Parameters
    ----------
    hidden_layers
        Five in the thesis.
    surface_only
        Whether it answers at the nodes of the surface only.
    """

    hidden_layers: int = Field(default=5, ge=1)
    surface_only: bool = False


class FeedForwardShape(FeedForwardConfig):
    """Settings, and the numbers of what it was fitted to: all that builds the module."""

    fields: tuple[str, ...]
    muscles: int
    body_nodes: int
    answered_nodes: int


@final
class NodeNetwork(nn.Module):
    """(activation, query_nodes) -> the fields at these nodes.

    Parameters
    ----------
    seed
        Of the weights.
    """

    row_of_node: Tensor

    def __init__(self, shape: FeedForwardShape, seed: int = 0) -> None:
        super().__init__()
        self.shape = shape
        self.networks = nn.ModuleDict()
        with torch.random.fork_rng(devices=[]):
            torch.manual_seed(seed)
            for name in shape.fields:
                width = shape.answered_nodes * components_of(name)
                self.networks[name] = perceptron(growing_widths(shape.muscles, width, shape.hidden_layers))
        for name in shape.fields:
            self.register_buffer(f"mean_{name}", torch.zeros(shape.answered_nodes, components_of(name)))
            self.register_buffer(f"spread_{name}", torch.ones(()))
        self.register_buffer("row_of_node", torch.zeros(shape.body_nodes, dtype=torch.int64))

    def fit_scaling(self, told: Taught, answered: Int[np.ndarray, " answered"]) -> None:
        """Take means and spreads from the training cases, and note which nodes are answered."""
        for name, values in told.fields.items():
            own = values[:, answered]
            self.get_buffer(f"mean_{name}").copy_(torch.from_numpy(own.mean(axis=0, dtype=np.float64)))
            self.get_buffer(f"spread_{name}").fill_(spread_of(own))
        rows = np.full(self.shape.body_nodes, self.shape.answered_nodes)
        rows[answered] = np.arange(len(answered))
        self.row_of_node.copy_(torch.from_numpy(rows))

    def forward(
        self, activation: Float[Tensor, "batch muscles"], query_nodes: Int[Tensor, " queries"]
    ) -> tuple[Tensor, ...]:
        """Fields in their order; raises InputError for a node that is not answered."""
        rows = self.row_of_node[query_nodes]
        if not torch.compiler.is_exporting() and bool((rows >= self.shape.answered_nodes).any()):
            raise InputError(
                f"feed_forward: expected queries on the surface ({self.shape.answered_nodes} nodes), got inner ones; "
                "ask at the surface, or fit with surface_only = false"
            )
        return tuple(self._field(name, activation, rows) for name in self.shape.fields)

    def _field(self, name: str, activation: Tensor, rows: Tensor) -> Tensor:
        mean = self.get_buffer(f"mean_{name}")
        grown = self.networks[name](2 * activation - 1).unflatten(-1, mean.shape)
        values = (mean + self.get_buffer(f"spread_{name}") * grown)[:, rows]
        return values if components_of(name) > 1 else values[..., 0]


def growing_widths(first: int, last: int, hidden: int) -> list[int]:
    """Widths of all layers, each the same multiple of the one before, rounded."""
    return [round(first * (last / first) ** (layer / (hidden + 1))) for layer in range(hidden + 2)]


def rebuild(config: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]]) -> NodeNetwork:
    """The module of this configuration, with weights of no meaning; the configuration says all shapes."""
    return NodeNetwork(parse(dict(config), FeedForwardShape, "feed-forward network"))
