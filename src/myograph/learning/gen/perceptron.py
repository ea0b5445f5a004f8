"""Layers with a nonlinearity between them, the last one linear.

    h <- nonlinearity(W h + b) * (1 + G z)

is a modulated layer: a state z multiplies what it makes of the place h, so that products of both need not be learned.
Source: Perez et al. 2018 for the modulation.
"""

from itertools import pairwise
from typing import Literal

from jaxtyping import Float
from torch import Tensor, nn

Nonlinearity = Literal["relu", "silu"]
LAYERS: dict[Nonlinearity, type[nn.Module]] = {"relu": nn.ReLU, "silu": nn.SiLU}


def perceptron(widths: list[int], nonlinearity: Nonlinearity = "relu") -> nn.Sequential:
    """Linear layers of these widths, the nonlinearity between them."""
    layers: list[nn.Module] = []
    for inputs, outputs in pairwise(widths):
        layers += [nn.Linear(inputs, outputs), LAYERS[nonlinearity]()]
    return nn.Sequential(*layers[:-1])


class ModulatedPerceptron(nn.Module):
    """From cat(state, place) to outputs; every hidden layer is multiplied by numbers made of the state.

    Parameters
    ----------
    states
        Features of the state: the first ones of the argument.
    """

    def __init__(self, states: int, widths: list[int], nonlinearity: Nonlinearity) -> None:
        super().__init__()
        self.states = states
        self.layers = nn.ModuleList(nn.Linear(inputs, outputs) for inputs, outputs in pairwise(widths))
        self.gates = nn.ModuleList(nn.Linear(states, width) for width in widths[1:-1])
        self.nonlinearity = LAYERS[nonlinearity]()

    def forward(self, seen: Float[Tensor, "*batch inputs"]) -> Float[Tensor, "*batch outputs"]:
        """Values at places."""
        state, hidden = seen[..., : self.states], seen
        for layer, gate in zip(self.layers, self.gates, strict=False):
            hidden = self.nonlinearity(layer(hidden)) * (1 + gate(state))
        return self.layers[-1](hidden)
