"""The parts of the module fitted to cases: a field's modes and surface, and the networks to the coordinate."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError
from myograph.learning.modes.angle_network import input_scaling
from myograph.learning.modes.chebyshev import RANGE, products
from myograph.learning.modes.config import FieldShape
from myograph.learning.modes.field_modes import FieldModes
from myograph.learning.modes.marquardt import fit_network
from myograph.learning.modes.module import SMALLEST, ModesModule
from myograph.learning.modes.pod import Pod
from myograph.learning.modes.surface import fit_surface
from myograph.learning.threads import on_one_thread

Values = Float[np.ndarray, "cases nodes components"]
Place = Float[np.ndarray, "cases 2"]
CASES_AT_ONCE = 64


def fit_field(name: str, values: Values, pod: Pod, place: Place, kept: torch.dtype = torch.float32) -> FieldModes:
    """Modes as they are kept, their surface over the places (x, u), and what neither explains at each node."""
    pod = replace(pod, modes=torch.tensor(pod.modes).to(kept).double().numpy())
    surface = fit_surface(place, pod.amounts)
    shape = FieldShape(name=name, components=values.shape[2], modes=len(pod.modes), degrees=surface.degrees)
    field = FieldModes(shape, values.shape[1], kept)
    amounts = products(torch.tensor(place), surface.degrees)[:, 0].numpy() @ surface.weights
    numbers = {
        "mean": pod.mean.reshape(values.shape[1:]),
        "modes": pod.modes.T.reshape(*values.shape[1:], -1),
        "weights": surface.weights,
        "spread": np.maximum(pod.spread, SMALLEST),
        "left_over": np.maximum(np.sqrt(np.square(pod.amounts - amounts).mean(axis=0)), SMALLEST),
        "misfit": _misfit(values, pod, amounts),
    }
    for key, array in numbers.items():
        getattr(field, key).copy_(torch.tensor(array))
    return field


@on_one_thread
def fit_angle(
    module: ModesModule,
    told: Float[np.ndarray, "cases inputs"],
    x: Float[np.ndarray, " cases"],
    progress: Callable[[int, int, float], None] | None,
) -> None:
    """Fit the module's networks from activations and load to x, if it has any; progress is told in mm of the nodes."""
    settings, network = module.settings, module.angle
    if network is None:
        return
    centre, scale = input_scaling(told)
    millimetres = _mm_per_x(module)
    members = []
    for member in range(settings.members):

        def report(step: int, rms: float, done: int = member * settings.steps) -> None:
            if progress is not None:
                progress(done + step, settings.members * settings.steps, rms * millimetres)

        seed = (settings.seed, member)
        members.append(fit_network((told - centre) / scale, x, settings.course, seed, report))
    network.take(centre, scale, members)
    with torch.no_grad():
        activation, load = torch.tensor(told[:, :-1]).float(), torch.tensor(told[:, -1]).float()
        missed = network(activation, load)[0] - torch.tensor(x)
    module.angle_misfit.fill_(max(float(missed.square().mean().sqrt()), SMALLEST))


def measure_angle(module: ModesModule, cases: MuscleCases, chosen: Int[np.ndarray, " chosen"]) -> None:
    """Say how far the networks' angle is off by what they miss on these cases, such as those of a truer simulator.

    Raises InputError for a module without networks, or whose coordinate is no angle.
    """
    low, high = module.angle_range.tolist()
    if module.angle is None or not np.isfinite([low, high]).all():
        raise InputError("neural modes: expected networks that tell the elbow's angle, got a model without")
    told = (torch.tensor(array[chosen], dtype=torch.float32) for array in (cases.activation, cases.hand_load))
    with torch.no_grad():
        found = module.angle(*told)[0].numpy()
    missed = found - RANGE * (2 * cases.elbow_angle[chosen] - low - high) / (high - low)
    module.angle_misfit.fill_(max(float(np.sqrt(np.square(missed).mean())), SMALLEST))


def _misfit(values: Values, pod: Pod, amounts: Float[np.ndarray, "cases modes"]) -> Float[np.ndarray, " nodes"]:
    """Root mean square over the cases of the distance between a node's value and that of the surface."""
    squares = np.zeros(values.shape[1])
    for first in range(0, len(values), CASES_AT_ONCE):
        part = slice(first, first + CASES_AT_ONCE)
        shapes = (pod.mean + amounts[part] @ pod.modes).reshape(-1, *values.shape[1:])
        squares += np.square(values[part] - shapes).sum(axis=(0, 2))
    return np.sqrt(squares / len(values))


def _mm_per_x(module: ModesModule) -> float:
    """How far nodes go for a unit of x: root mean square over the nodes, at the middle of training."""
    position = module.position
    middle = torch.zeros(1, 2, dtype=torch.float64)
    slope: Tensor = position.tangent(middle)[:, 1].float() @ position.modes.flatten(0, 1).float().T
    return float((3 * slope.square().mean()).sqrt())
