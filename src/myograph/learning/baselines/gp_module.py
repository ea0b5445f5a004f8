r"""Gaussian processes on POD coefficients, as a module.

    k(x, x') = A (1 + √3 d) exp(-√3 d),  d² = sum_m ((x_m - x'_m)/ℓ_m)²     Matérn 3/2, a length for each muscle
    c_j(x)   = σ_j sum_i k(x, x_i) w_ij                                     coefficient of mode j
    v(x)     = A + s² - |L⁻¹ k(x, ·)|²,  L Lᵀ = k(x_i, x_i') + s² δ         variance of c_j/σ_j, for all j alike
    u        = mean + sum_j c_j φ_j
    deviation(node) = sqrt(v sum_j σ_j² |φ_j(node)|² + rest(node)²)         of the length of the error

rest(node) is what the modes leave. All in double precision inside, for the sums cancel.
Sources: Rasmussen & Williams 2006, algorithm 2.1; Guo & Hesthaven 2018 for POD and Gaussian processes.
"""

import math
from collections.abc import Mapping
from typing import Any, final

import torch
from jaxtyping import Float, Int
from pydantic import Field
from torch import Tensor, nn

from myograph.config import Model, parse
from myograph.learning.baselines.taught import components_of


class PodGpConfig(Model):
    """Settings of the method.

    Parameters
    ----------
    modes
        POD modes of each field, at most.
    most_cases
        Training cases, at most; of more, these are drawn at random. Memory and answers grow with their square.
    kernel_cases
        Of these, the ones that the lengths of the kernel are found on.
    seed
        Of what is drawn.
    """

    modes: int = Field(default=30, ge=1)
    most_cases: int = Field(default=800, ge=2)
    kernel_cases: int = Field(default=300, ge=2)
    seed: int = Field(default=0, ge=0)


class PodGpShape(PodGpConfig):
    """Settings, and the numbers of what it was fitted to: all that builds the module."""

    fields: tuple[str, ...]
    muscles: int
    cases: int
    kept_modes: tuple[int, ...]
    body_nodes: int

    @property
    def outputs(self) -> tuple[str, ...]:
        """Of the module."""
        return (*self.fields, *(f"{name}_deviation" for name in self.fields))


@final
class FieldProcess(nn.Module):
    """The processes of one field: (activation, query_nodes) -> values and deviations, double precision.

    Nothing is trained by gradients; what stands as a parameter is what was learned.
    """

    def __init__(self, muscles: int, cases: int, modes: int, nodes: int, components: int) -> None:
        super().__init__()
        self.lengths = _learned(muscles)
        self.amplitude = _learned()
        self.noise = _learned()
        self.weights = _learned(cases, modes)
        self.mean = _learned(nodes, components)
        self.modes = _learned(modes, nodes, components)
        self.spread = _learned(modes)
        self.rest = _learned(nodes)
        self.register_buffer("cases", torch.zeros(cases, muscles, dtype=torch.float64))
        self.register_buffer("inverse_root", torch.zeros(cases, cases, dtype=torch.float64))

    def forward(
        self, activation: Float[Tensor, "batch muscles"], query_nodes: Int[Tensor, " queries"]
    ) -> tuple[Float[Tensor, "batch queries components"], Float[Tensor, "batch queries"]]:
        """Values and the deviation of the length of their error, in the unit of the field."""
        near = self._kernel(activation)
        modes = self.modes[:, query_nodes]
        coefficients = (near @ self.weights) * self.spread
        values = self.mean[query_nodes] + (coefficients @ modes.flatten(1)).unflatten(-1, modes.shape[1:])
        variance = self.amplitude + self.noise - (near @ self.get_buffer("inverse_root").T).square().sum(dim=-1)
        share = (self.spread[:, None] ** 2 * modes.square().sum(dim=-1)).sum(dim=0)
        deviation = (variance.clamp_min(0)[:, None] * share + self.rest[query_nodes] ** 2).sqrt()
        return values, deviation

    def _kernel(self, activation: Float[Tensor, "batch muscles"]) -> Float[Tensor, "batch cases"]:
        apart = (activation.double()[:, None] - self.get_buffer("cases")) / self.lengths
        scaled = math.sqrt(3) * apart.square().sum(dim=-1).sqrt()
        return self.amplitude * (1 + scaled) * (-scaled).exp()


@final
class PodGpModule(nn.Module):
    """(activation, query_nodes) -> the fields, then their deviations."""

    def __init__(self, shape: PodGpShape) -> None:
        super().__init__()
        self.shape = shape
        self.processes = nn.ModuleDict()
        for name, modes in zip(shape.fields, shape.kept_modes, strict=True):
            self.processes[name] = FieldProcess(
                shape.muscles, shape.cases, modes, shape.body_nodes, components_of(name)
            )

    def forward(
        self, activation: Float[Tensor, "batch muscles"], query_nodes: Int[Tensor, " queries"]
    ) -> tuple[Tensor, ...]:
        """As `shape.outputs` names them."""
        answers = [self.processes[name](activation, query_nodes) for name in self.shape.fields]
        values = [own if own.shape[-1] > 1 else own[..., 0] for own, _ in answers]
        return tuple(part.float() for part in (*values, *(deviation for _, deviation in answers)))


def rebuild(config: Mapping[str, Any], shapes: Mapping[str, tuple[int, ...]]) -> PodGpModule:
    """The module of this configuration, with weights of no meaning; the configuration says all shapes."""
    return PodGpModule(parse(dict(config), PodGpShape, "Gaussian processes on POD"))


def _learned(*shape: int) -> nn.Parameter:
    return nn.Parameter(torch.zeros(shape, dtype=torch.float64), requires_grad=False)
