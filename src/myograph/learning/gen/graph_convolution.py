"""Graph convolution of Kipf & Welling on nodes that have a place and a state.

    GCN(cat(x, h)) = Â cat(x, h) W + b = Â x W_x + b + Â h W_h,   Â = D^-1/2 (A + 1) D^-1/2

The places x do not change between the rounds of a processor, so that their part is computed once.
Convention: states lie as (nodes, batch, latent), which makes Â h one sparse product.
Source: Kipf & Welling 2017.
"""

import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.learning.gen.graph import Graph


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

    def prepare(self, places: Float[Tensor, "nodes axes"], graph: Graph) -> Float[Tensor, "nodes 1 latent"]:
        """What places and bias add in every round."""
        return (graph.smooth(places @ self.weight[: self.axes]) + self.bias)[:, None, :]

    def forward(
        self, state: Float[Tensor, "nodes batch latent"], prepared: Float[Tensor, "nodes 1 latent"], graph: Graph
    ) -> Float[Tensor, "nodes batch latent"]:
        """One convolution; `prepared` comes from the method `prepare`."""
        return graph.smooth(state @ self.weight[self.axes :]) + prepared
