"""The muscle's place x from the activations of all muscles and the load: a few small networks side by side.

They start from different weights; their mean is the answer, their spread says how well the cases pin it down.
"""

import numpy as np
import torch
from jaxtyping import Float
from torch import Tensor, nn

from myograph.learning.modes.marquardt import Weights


class AngleNetwork(nn.Module):
    """Members of two hidden layers of tanh on scaled activations and load; blank until `take`."""

    centre: Tensor
    scale: Tensor

    def __init__(self, inputs: int, width: int, members: int) -> None:
        super().__init__()
        self.register_buffer("centre", torch.zeros(inputs))
        self.register_buffer("scale", torch.ones(inputs))
        self.first = nn.Parameter(torch.zeros(members, inputs, width))
        self.first_offset = nn.Parameter(torch.zeros(members, 1, width))
        self.second = nn.Parameter(torch.zeros(members, width, width))
        self.second_offset = nn.Parameter(torch.zeros(members, 1, width))
        self.last = nn.Parameter(torch.zeros(members, width, 1))
        self.last_offset = nn.Parameter(torch.zeros(members, 1, 1))

    def forward(
        self, activation: Float[Tensor, "batch muscles"], hand_load: Float[Tensor, " batch"]
    ) -> tuple[Float[Tensor, " batch"], Float[Tensor, " batch"]]:
        """Mean and standard deviation of x over the members [-].

        In double precision, for members that agree to five digits leave no digits of their spread in single.
        """
        told = (torch.cat([activation, hand_load[:, None]], dim=-1).double() - self.centre) / self.scale
        hidden = torch.tanh(told @ self.first.double() + self.first_offset)
        hidden = torch.tanh(hidden @ self.second.double() + self.second_offset)
        each = (hidden @ self.last.double() + self.last_offset)[..., 0]
        mean = each.mean(dim=0)
        return mean, (each - mean).square().mean(dim=0).sqrt()

    def take(
        self, centre: Float[np.ndarray, " inputs"], scale: Float[np.ndarray, " inputs"], members: list[Weights]
    ) -> None:
        """Use these weights, which were fitted to (inputs - centre) / scale."""
        with torch.no_grad():
            self.centre.copy_(torch.tensor(centre))
            self.scale.copy_(torch.tensor(scale))
            for number, weights in enumerate(members):
                self.first[number] = torch.tensor(weights.first.T)
                self.first_offset[number, 0] = torch.tensor(weights.first_offset)
                self.second[number] = torch.tensor(weights.second.T)
                self.second_offset[number, 0] = torch.tensor(weights.second_offset)
                self.last[number, :, 0] = torch.tensor(weights.last)
                self.last_offset[number] = weights.last_offset


def input_scaling(
    told: Float[np.ndarray, "cases inputs"],
) -> tuple[Float[np.ndarray, " inputs"], Float[np.ndarray, " inputs"]]:
    """Centre and half width of each input; an input that never varies keeps its width of one."""
    low, high = told.min(axis=0), told.max(axis=0)
    return (low + high) / 2, np.where(high > low, (high - low) / 2, 1.0)
