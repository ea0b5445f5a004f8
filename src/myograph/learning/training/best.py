"""The best weights so far by their error on held-out pairs, and whether waiting for better ones is worth it."""

import math
from dataclasses import dataclass, field

from torch import Tensor, nn


@dataclass
class Best:
    """The best weights of a training.

    Parameters
    ----------
    error
        Their error [mm].
    mark
        The error that gain is measured from [mm].
    waited
        Validations since the last gain.
    weights
        State of the module; empty before the first validation.
    """

    error: float = math.inf
    mark: float = math.inf
    waited: int = 0
    weights: dict[str, Tensor] = field(default_factory=dict)

    def take(self, error: float, module: nn.Module, smallest_gain: float) -> None:
        """Judge the module's weights; `smallest_gain` is a share of the mark [-]."""
        if error < self.error:
            self.error = error
            self.weights = {name: value.detach().clone() for name, value in module.state_dict().items()}
        if error < self.mark * (1 - smallest_gain):
            self.mark, self.waited = error, 0
        else:
            self.waited += 1
