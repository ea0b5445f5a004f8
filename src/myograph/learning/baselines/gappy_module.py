r"""Gappy POD as a module: sensors in, positions of nodes out; see `gappy_pod` for the formula.

All numbers are kept and worked with in double precision: the ridge is thin beside what the sensors see.
"""

from collections.abc import Mapping
from typing import Any, final

import torch
from jaxtyping import Float, Int
from pydantic import Field
from torch import Tensor, nn

from myograph.config import Model, parse
from myograph.errors import InputError
from myograph.learning.modes.ridge import ridge_amounts


class GappyPodShape(Model):
    """All that builds the module: numbers of modes and nodes, and ε [mm]."""

    kept_modes: int = Field(ge=1)
    body_nodes: int = Field(ge=1)
    trust: float = Field(gt=0)


@final
class GappyPodModule(nn.Module):
    """(sensor_nodes, sensor_position_target, query_nodes) -> positions [mm].

    Nothing is trained by gradients; what stands as a parameter is what was learned.
    """

    def __init__(self, shape: GappyPodShape) -> None:
        super().__init__()
        self.shape = shape
        self.mean = _learned(shape.body_nodes, 3)
        self.modes = _learned(shape.kept_modes, shape.body_nodes, 3)
        self.spread = _learned(shape.kept_modes)

    def forward(
        self,
        sensor_nodes: Int[Tensor, " sensors"],
        sensor_position_target: Float[Tensor, "batch sensors 3"],
        query_nodes: Int[Tensor, " queries"],
    ) -> Float[Tensor, "batch queries 3"]:
        """Positions of the queries; raises InputError for a node that the body does not have."""
        if not torch.compiler.is_exporting():
            self._check_nodes(torch.cat([sensor_nodes, query_nodes]))
        missed = sensor_position_target.double() - self.mean[sensor_nodes]
        seen = self.modes[:, sensor_nodes].flatten(1).T
        amounts = ridge_amounts(missed.flatten(1), seen, self.spread, self.shape.trust)
        moved = (amounts @ self.modes[:, query_nodes].flatten(1)).unflatten(-1, (-1, 3))
        return (self.mean[query_nodes] + moved).float()

    def _check_nodes(self, nodes: Int[Tensor, " nodes"]) -> None:
        low, high, last = int(nodes.min()), int(nodes.max()), self.shape.body_nodes - 1
        if low < 0 or high > last:
            raise InputError(f"gappy_pod: expected the nodes 0 to {last} of its body, got {low} to {high}")


def rebuild(config: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]]) -> GappyPodModule:
    """The module of this configuration, with numbers of no meaning; the configuration says all shapes."""
    return GappyPodModule(parse(dict(config), GappyPodShape, "gappy POD"))


def _learned(*shape: int) -> nn.Parameter:
    return nn.Parameter(torch.zeros(shape, dtype=torch.float64), requires_grad=False)
