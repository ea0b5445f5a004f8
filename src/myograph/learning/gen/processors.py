"""What happens in a round of message passing: nodes that have a place x and a state h tell each other.

    gcn    GCN(cat(x, h)), see `graph_convolution`
    mlp    MLP(cat(x, h, Â h)): a nonlinear update of every node from itself and the mean of its neighbours
    mpnn   m_v(cat(x_i, h_i, mean_j m_e(cat(h_i, h_j, x_j - x_i, |x_j - x_i|))))  over the neighbours j

and PyTorch Geometric's convolutions on cat(x, h), see `geometric`. A processor gives what is added to the state; the
network adds it, normalises, and does so again with the same weights. Sources: Alet et al. 2019; Battaglia et al. 2018.
"""

import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.geometric import GeometricConvolution
from myograph.learning.gen.graph import Graph
from myograph.learning.gen.graph_convolution import GraphConvolution
from myograph.learning.gen.perceptron import Nonlinearity, perceptron


class NodeUpdate(nn.Module):
    """'mlp'. The last layer starts small by the gain, so that many rounds do not wash the states out."""

    def __init__(self, axes: int, latent: int, gain: float, nonlinearity: Nonlinearity) -> None:
        super().__init__()
        self.layers = perceptron([axes + 2 * latent, latent, latent], nonlinearity)
        damp(self.layers, gain)

    def prepare(self, places: Float[Tensor, "nodes axes"], graph: Graph) -> Float[Tensor, "nodes 1 axes"]:
        """The places."""
        return places[:, None, :]

    def forward(
        self, state: Float[Tensor, "nodes batch latent"], prepared: Float[Tensor, "nodes 1 axes"], graph: Graph
    ) -> Float[Tensor, "nodes batch latent"]:
        """One round."""
        places = prepared.expand(-1, state.shape[1], -1)
        return self.layers(torch.cat([places, state, graph.smooth(state)], dim=-1))


class MessagePassing(nn.Module):
    """'mpnn'."""

    def __init__(self, axes: int, latent: int, gain: float, nonlinearity: Nonlinearity) -> None:
        super().__init__()
        self.message = perceptron([2 * latent + axes + 1, latent, latent], nonlinearity)
        self.update = perceptron([axes + 2 * latent, latent, latent], nonlinearity)
        damp(self.update, gain)

    def prepare(self, places: Float[Tensor, "nodes axes"], graph: Graph) -> Float[Tensor, "nodes axes"]:
        """The places."""
        return places

    def forward(
        self, state: Float[Tensor, "nodes batch latent"], prepared: Float[Tensor, "nodes axes"], graph: Graph
    ) -> Float[Tensor, "nodes batch latent"]:
        """One round."""
        sender, receiver = graph.edges
        way = prepared[sender] - prepared[receiver]
        where = torch.cat([way, way.square().sum(dim=-1, keepdim=True).clamp_min(1e-12).sqrt()], dim=-1)
        where = where[:, None, :].expand(-1, state.shape[1], -1)
        messages = self.message(torch.cat([state[receiver], state[sender], where], dim=-1))
        heard = torch.zeros_like(state).index_add(0, receiver, messages)
        places = prepared[:, None, :].expand(-1, state.shape[1], -1)
        return self.update(torch.cat([places, state, heard / graph.neighbours[:, None, None]], dim=-1))


RoundProcessor = GraphConvolution | NodeUpdate | MessagePassing | GeometricConvolution
"""`prepare(places, graph)` says once what does not change between rounds; a call says what is added to the state."""


def damp(layers: nn.Sequential, gain: float) -> None:
    """Multiply the weights of the last layer."""
    last = layers[-1]
    assert isinstance(last, nn.Linear)
    with torch.no_grad():
        last.weight.mul_(gain)


def processor(config: NetworkConfig, axes: int) -> RoundProcessor:
    """The processor of that name; raises MissingPackageError where PyTorch Geometric is asked for and missing."""
    latent, gain = config.latent, 1 / config.message_rounds
    if config.processor == "gcn":
        return GraphConvolution(axes, latent, gain)
    if config.processor == "mlp":
        return NodeUpdate(axes, latent, gain, config.nonlinearity)
    if config.processor == "mpnn":
        return MessagePassing(axes, latent, gain, config.nonlinearity)
    return GeometricConvolution(config.processor, axes, latent)
