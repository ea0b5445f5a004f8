"""Graph element network: functions sampled at points go in, functions of any query point come out.

    encoder      e_i = MLP(cat(p_i, value_i)), one for each input function
    representer  r(p, n), shares of a point in the nodes of the graph, see `representer`
    aggregation  h_n = sum_i r(p_i, n) e_i        ('sum'), divided by sum_i r(p_i, n) ('mean'); the functions add up
    processor    h <- LayerNorm(h + update(x, h)), T rounds, shared weights, see `processors`
    decoder      answer(q) = MLP(cat(sum_n r(q, n) h_n, q)), one for each output function

The space may have any dimension, and any number of functions may go in and come out.
Convention: space is a box whose longest side is 1; the MLPs see it centred and over half its shortest side, so that a
long body's thickness does not drown in its length.
Source: Alet et al. 2019.
"""

import math
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.errors import InputError
from myograph.learning.gen.barycentric import barycentric_shares
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.graph import graph_of
from myograph.learning.gen.mesh import grid_nodes
from myograph.learning.gen.perceptron import ModulatedPerceptron, perceptron
from myograph.learning.gen.precision import single
from myograph.learning.gen.processors import processor
from myograph.learning.gen.representer import DenseShares, Shares, nearest_shares, scores

TRIANGLE = 3
"""Corners of a simplex that code written for triangles looks at."""

Samples = tuple[Float[Tensor, "batch _ axes"], Float[Tensor, "batch _ _"]]
"""An input function: places in the box, and values there."""


class GraphElementNetwork(nn.Module):
    """The network in a box; raises InputError for a trap that the representer does not have.

    Parameters
    ----------
    sides
        Of the box that the graph fills at first [-]; their number is the dimension of the space.
    values
        Number of values at a point, for each input function.
    outputs
        Number of values at a query, for each output function.
    constants
        Number of values that hold everywhere, such as activations; they add a state of their own to every node.
    seed
        Of the graph's first nodes and the weights.
    """

    centre: Tensor
    half_thickness: Tensor

    def __init__(
        self,
        config: NetworkConfig,
        sides: Float[np.ndarray, " axes"],
        values: Sequence[int],
        outputs: Sequence[int],
        seed: int,
        constants: int = 0,
    ) -> None:
        super().__init__()
        _check(config)
        axes, latent = len(sides), config.latent
        self.config = config
        with torch.random.fork_rng(devices=[]):
            torch.manual_seed(seed)
            self.encoders = nn.ModuleList(self._layers(axes + width, latent) for width in values)
            self.processor = processor(config, axes)
            self.norm = nn.LayerNorm(latent)
            self.decoders = nn.ModuleList(self._decoder(axes, width) for width in outputs)
            self.constant_encoder = self._layers(constants, latent) if constants else None
        nodes = torch.tensor(grid_nodes(config.nodes_per_axis, sides, seed), dtype=torch.float32)
        self.nodes = nn.Parameter(nodes)
        spacing = float(np.mean(sides)) / (config.nodes_per_axis - 1)
        sharpness = torch.tensor(0.0 if config.traps.millimetres else -2 * math.log(spacing))
        sharpness = sharpness.expand(len(nodes)).clone() if config.sharpness == "per_node" else sharpness
        self.log_sharpness = nn.Parameter(sharpness, requires_grad=config.sharpness != "fixed")
        millimetres = config.traps.millimetres
        self.register_buffer("centre", torch.tensor(0 * sides if millimetres else sides / 2, dtype=torch.float32))
        self.register_buffer("half_thickness", torch.tensor(1.0 if millimetres else float(sides.min()) / 2))
        self.register_load_state_dict_post_hook(_triangulate_anew)
        self.triangulate()

    def _layers(self, inputs: int, outputs: int) -> nn.Sequential:
        return perceptron([inputs, *self.config.hidden, outputs], self.config.nonlinearity)

    def _decoder(self, axes: int, outputs: int) -> nn.Module:
        config = self.config
        states = config.latent * (2 if config.context else 1)
        seen = states + (0 if config.traps.no_query else axes)
        if not config.modulated:
            return self._layers(seen, outputs)
        return ModulatedPerceptron(states, [seen, *config.hidden, outputs], config.nonlinearity)

    @property
    def weight_count(self) -> int:
        """Number of learned numbers, without the node positions."""
        learned = (parameter.numel() for parameter in self.parameters() if parameter.requires_grad)
        return sum(learned) - self.nodes.numel()

    def triangulate(self) -> None:
        """Join the nodes anew, where they are now."""
        corners = TRIANGLE if self.config.traps.triangle_edges else None
        self.graph = graph_of(self.nodes.detach().cpu().double().numpy(), corners)

    def shares(self, points: Float[Tensor, "batch points axes"]) -> Shares:
        """Shares of points of the box in the graph's nodes, from places in single precision."""
        with single(points):
            if self.config.representer == "barycentric":
                return barycentric_shares(points, self.nodes, self.graph.triangulation)
            sign = -1.0 if self.config.traps.legacy_sign else 1.0
            scored = scores(points, self.nodes, sign * self.log_sharpness.exp())
        if self.config.representer == "nearest":
            return nearest_shares(scored, self.config.nearest)
        return DenseShares(scored, self.config.traps.legacy_axis)

    def seen(self, points: Float[Tensor, "batch points axes"]) -> Float[Tensor, "batch points axes"]:
        """Coordinates as the MLPs see them [-]."""
        return (points - self.centre) / self.half_thickness

    def forward(
        self,
        given: Sequence[Samples] | None,
        queries: Float[Tensor, "batch queries axes"],
        constants: Float[Tensor, "batch constants"] | None = None,
    ) -> tuple[Float[Tensor, "batch queries _"], ...]:
        """Answers at the queries, for each output function; all places in the box [-]. `given` may be unknown."""
        state = self._state(given, queries, constants)
        graph = self.graph.on(state.device)
        prepared = self.processor.prepare(self.nodes, graph)
        for _ in range(self.config.message_rounds):
            state = self.norm(state + self.processor(state, prepared, graph))
        parts = [self.shares(queries).collect(state)]
        if self.config.context:
            parts.append(state.mean(dim=0)[:, None, :].expand(-1, queries.shape[1], -1))
        if not self.config.traps.no_query:
            parts.append(self.seen(queries))
        seen = torch.cat(parts, dim=-1)
        return tuple(decoder(seen) for decoder in self.decoders)

    def _state(
        self, given: Sequence[Samples] | None, queries: Tensor, constants: Tensor | None
    ) -> Float[Tensor, "nodes batch latent"]:
        """What the nodes hear of all inputs."""
        state = queries.new_zeros(len(self.nodes), queries.shape[0], self.config.latent)
        for encoder, (points, values) in zip(self.encoders, given, strict=True) if given else ():
            encoded = encoder(torch.cat([self.seen(points), values], dim=-1))
            state = state + self.shares(points).spread(encoded, self.config.aggregation)
        if constants is not None and self.constant_encoder is not None:
            state = state + self.constant_encoder(constants)
        return state


def _triangulate_anew(network: GraphElementNetwork, _: Any) -> None:
    network.triangulate()


def _check(config: NetworkConfig) -> None:
    traps = config.traps
    if config.representer != "dense" and (traps.legacy_sign or traps.legacy_axis):
        raise InputError(f"representer '{config.representer}': the traps of listing 5.2 exist for 'dense' only")
    if config.latent == 1:
        warnings.warn("LayerNorm over a latent of size 1 is constant: this network cannot see its input", stacklevel=3)
