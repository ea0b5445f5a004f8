"""Exponential moving average of a module's parameters.

    average <- d average + (1 - d) parameter,    d = min(decay, (1 + n) / (10 + n)) at the n-th step

so that the first steps do not weigh for ever. Source: Polyak & Juditsky 1992; the start as in TensorFlow's
ExponentialMovingAverage.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import torch
from torch import Tensor, nn
from torch.optim.swa_utils import get_ema_multi_avg_fn


class Average:
    """Averages a module's parameters; its buffers stay what they are."""

    def __init__(self, module: nn.Module, decay: float) -> None:
        self._parameters = {name: value for name, value in module.named_parameters() if value.requires_grad}
        self._decay = decay
        self.values = {name: value.detach().clone() for name, value in self._parameters.items()}

    @torch.no_grad()
    def update(self, step: int) -> None:
        """Take in the parameters after the step of this number from 1."""
        decay = min(self._decay, (1 + step) / (10 + step))
        average = get_ema_multi_avg_fn(decay)
        average(list(self.values.values()), list(self._parameters.values()), step)

    @torch.no_grad()
    def load(self, values: dict[str, Tensor]) -> None:
        """Take the average from a checkpoint."""
        for name, value in self.values.items():
            value.copy_(values[name])

    @contextmanager
    def in_place(self) -> Iterator[None]:
        """The module has its averaged parameters for a while."""
        kept = {name: value.detach().clone() for name, value in self._parameters.items()}
        self._put(self.values)
        try:
            yield
        finally:
            self._put(kept)

    def settle(self) -> None:
        """Give the module its averaged parameters for good."""
        self._put(self.values)

    @torch.no_grad()
    def _put(self, values: dict[str, Tensor]) -> None:
        for name, parameter in self._parameters.items():
            parameter.copy_(values[name])
