r"""A field conditioned on what drives it, as a deep operator network (DeepONet).

    u(X) = base(X) + offset + spread · sum_k b_k(drive) t_k(X),   k = 1..K

branch b: what drives -> K vectors; trunk t: material place X -> K numbers. For positions base(X) = X, for other fields
0. What drives are the activations, or where the sensors are in the target case, or both. The answer is a field: in the
convention 'material' it is asked at any X; in the convention 'initial', where a point's X is not told, at the nodes.
Source: Lu et al. 2021 (unstacked DeepONet, several outputs by splitting the branch).
"""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, final

import numpy as np
import torch
from jaxtyping import Float
from pydantic import Field
from torch import Tensor, nn

from myograph.config import Model, parse
from myograph.ensemble.pairs.question import Convention
from myograph.learning.baselines.by_cases import spread_of
from myograph.learning.baselines.taught import Taught, components_of
from myograph.learning.gen.perceptron import perceptron

Drive = Literal["activation", "sensors", "both"]
DRIVES: dict[Drive, tuple[str, ...]] = {
    "activation": ("activation",),
    "sensors": ("sensor_position_target",),
    "both": ("activation", "sensor_position_target"),
}
"""What drives, as inputs of the module."""

Width = Annotated[int, Field(ge=1)]


class DeepONetConfig(Model):
    """Settings of the network.

    Parameters
    ----------
    drive
        What the branch sees.
    terms
        K, of each field.
    branch, trunk
        Widths of the hidden layers.
    """

    drive: Drive = "activation"
    terms: int = Field(default=48, ge=1)
    branch: tuple[Width, ...] = (128, 128, 128)
    trunk: tuple[Width, ...] = (96, 96, 96)


class DeepONetShape(DeepONetConfig):
    """Settings, and what it was fitted to: all that builds the module."""

    fields: tuple[str, ...]
    muscles: int
    sensors: int
    body_nodes: int
    convention: Convention

    @property
    def inputs(self) -> tuple[str, ...]:
        """Of the module."""
        return (*DRIVES[self.drive], "query_places" if self.convention == "material" else "query_nodes")


@final
class DeepONetModule(nn.Module):
    """`shape.inputs` -> the fields at the queries.

    Parameters
    ----------
    seed
        Of the weights.
    """

    reference: Tensor
    sensor_mean: Tensor
    sensor_spread: Tensor

    def __init__(self, shape: DeepONetShape, seed: int = 0) -> None:
        super().__init__()
        self.shape = shape
        seen = (shape.muscles if shape.drive != "sensors" else 0) + (
            3 * shape.sensors if shape.drive != "activation" else 0
        )
        self.branches, self.trunks = nn.ModuleDict(), nn.ModuleDict()
        with torch.random.fork_rng(devices=[]):
            torch.manual_seed(seed)
            for name in shape.fields:
                self.branches[name] = perceptron([seen, *shape.branch, shape.terms * components_of(name)], "silu")
                self.trunks[name] = perceptron([3, *shape.trunk, shape.terms], "silu")
        for name in shape.fields:
            self.register_buffer(f"offset_{name}", torch.zeros(components_of(name)))
            self.register_buffer(f"spread_{name}", torch.ones(()))
        self.register_buffer("reference", torch.zeros(shape.body_nodes, 3))
        self.register_buffer("sensor_mean", torch.zeros(shape.sensors, 3))
        self.register_buffer("sensor_spread", torch.ones(()))

    def fit_scaling(self, told: Taught, reference: Float[np.ndarray, "nodes 3"], sensors: Sequence[np.ndarray]) -> None:
        """Take offsets and spreads from the training cases; `sensors` are positions of the sensors in them, if any."""
        self.reference.copy_(torch.from_numpy(reference))
        for name, values in told.fields.items():
            own = values - reference if name == "position" else values
            self.get_buffer(f"offset_{name}").copy_(torch.from_numpy(own.mean(axis=(0, 1), dtype=np.float64)))
            self.get_buffer(f"spread_{name}").fill_(spread_of(values))
        for positions in sensors:
            self.sensor_mean.copy_(torch.from_numpy(positions.mean(axis=0, dtype=np.float64)))
            self.sensor_spread.fill_(spread_of(positions))

    def forward(self, *arguments: Tensor) -> tuple[Tensor, ...]:
        """Fields in their order."""
        *driving, asked = arguments
        named = zip(DRIVES[self.shape.drive], driving, strict=True)
        drive = torch.cat([self._scaled(name, part) for name, part in named], dim=-1)
        places = asked if self.shape.convention == "material" else self.reference[asked][None]
        return tuple(self._field(name, drive, places) for name in self.shape.fields)

    def _scaled(self, name: str, part: Tensor) -> Tensor:
        if name == "activation":
            return 2 * part - 1
        return ((part - self.sensor_mean) / self.sensor_spread).flatten(1)

    def _field(
        self, name: str, drive: Float[Tensor, "batch seen"], places: Float[Tensor, "_ queries 3"]
    ) -> Float[Tensor, "batch queries ..."]:
        low, high = self.reference.amin(dim=0), self.reference.amax(dim=0)
        basis = self.trunks[name]((2 * places - low - high) / (high - low).clamp_min(1e-6))
        shares = self.branches[name](drive).unflatten(-1, (self.shape.terms, components_of(name)))
        values = self.get_buffer(f"offset_{name}") + self.get_buffer(f"spread_{name}") * (basis @ shares)
        values = places + values if name == "position" else values
        return values if components_of(name) > 1 else values[..., 0]


def rebuild(config: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]]) -> DeepONetModule:
    """The module of this configuration, with weights of no meaning; the configuration says all shapes."""
    return DeepONetModule(parse(dict(config), DeepONetShape, "deep operator network"))
