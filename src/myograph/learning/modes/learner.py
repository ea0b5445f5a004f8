"""Fits neural modes: modes by linear algebra, surfaces by least squares, the small networks by Levenberg-Marquardt."""

from dataclasses import dataclass, field

import numpy as np
import torch
from jaxtyping import Float, Int

from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.inference.signature import Signature
from myograph.learning.modes.chebyshev import RANGE
from myograph.learning.modes.config import BuiltModes, ModesConfig
from myograph.learning.modes.fitting import fit_angle, fit_field
from myograph.learning.modes.module import KEPT, ModesModule
from myograph.learning.modes.pod import Pod, proper_modes
from myograph.learning.threads import on_one_thread
from myograph.learning.torch_predictor import TorchPredictor

LEAST_CASES = 6
Told = tuple[Float[np.ndarray, "cases inputs"], Float[np.ndarray, " cases"]]
"""Activations and load of the training cases, and their x."""


@dataclass(frozen=True)
class ModesLearner:
    """A `myograph.ensemble.pairs.predictor.Learner`; what it answers is what the sampler asks, positions always."""

    config: ModesConfig = field(default_factory=ModesConfig)
    name: str = "neural_modes"

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TorchPredictor:
        """Learn from the split's training cases.

        Raises InputError for fewer than six, or for cases without the elbow's angle where it is the coordinate.
        """
        module, told = self.modes(sampler, split)
        fit_angle(module, *told, progress)
        return predictor(self.name, module, sampler)

    @on_one_thread
    def modes(self, sampler: PairSampler, split: Split) -> tuple[ModesModule, Told]:
        """The module but for its networks, and what these are to be fitted to; raises as `fit` does."""
        cases, taught = sampler.cases, split.train.cases
        if len(taught) < LEAST_CASES:
            raise InputError(f"{self.name}: expected at least {LEAST_CASES} training cases, got {len(taught)}")
        values = {name: _values(cases, name, taught) for name in self._names(sampler)}
        foreign = sorted(set(self.config.modes_of) - set(values))
        if foreign:
            raise InputError(f"modes_of: expected some of {', '.join(values)}, got {', '.join(foreign)}")
        pods = {name: proper_modes(array.reshape(len(taught), -1), self._most(name)) for name, array in values.items()}
        own = MUSCLES.index(cases.muscle)
        along = self._coordinate(cases, taught, pods["position"])
        x = _scaled(along)
        place = np.stack([x, RANGE * (2 * cases.activation[taught, own] - 1)], axis=1)
        kept = KEPT[self.config.kept]
        fitted = [fit_field(name, array, pods[name], place, kept) for name, array in values.items()]
        shapes = tuple(modes.shape for modes in fitted)
        module = ModesModule(BuiltModes(settings=self.config, own=own, nodes=cases.nodes, fields=shapes))
        module.fields.update({modes.shape.name: modes for modes in fitted})
        if self.config.coordinate == "angle":
            module.angle_range.copy_(torch.tensor([along.min(), along.max()]))
        return module, (np.concatenate([cases.activation[taught], cases.hand_load[taught, None]], axis=1), x)

    def _names(self, sampler: PairSampler) -> list[str]:
        """Fields that get modes: positions first."""
        others = {self.config.stress if name == "von_mises" else name for name in sampler.asked} - {"position"}
        if "cauchy_stress" in others:
            others.discard("von_mises")
        return ["position", *sorted(others)]

    def _most(self, name: str) -> int:
        """Modes of a field, at most."""
        return self.config.modes_of.get(name, self.config.modes)

    def _coordinate(self, cases: MuscleCases, taught: Int[np.ndarray, " taught"], pod: Pod) -> np.ndarray:
        if self.config.coordinate == "mode":
            return pod.amounts[:, 0]
        angles = cases.elbow_angle[taught]
        unknown = int(np.count_nonzero(~np.isfinite(angles)))
        if unknown:
            raise InputError(
                f"{self.name}: expected the elbow's angle of every training case, got none in {unknown} of "
                f"{len(taught)}; set coordinate = 'mode'"
            )
        return angles


def reading(model: TorchPredictor, sampler: PairSampler, settings: ModesConfig) -> TorchPredictor:
    """The same modes and networks answering from something else, or sensing otherwise.

    Raises InputError for a model that is none of modes, or that never learned to read activations.
    """
    module = model.module
    if not isinstance(module, ModesModule):
        raise InputError(f"{model.name}: expected neural modes, got the method '{model.method}'")
    if module.angle is None and settings.reads != "sensors":
        raise InputError(f"{model.name}: it learned from sensors only; fit one that reads 'both' first")
    kept = {name: getattr(module.settings, name) for name in ("stress", "kept", "width", "members")}
    other = ModesModule(module.built.model_copy(update={"settings": settings.model_copy(update=kept)}))
    state = module.state_dict()
    other.load_state_dict({name: state[name] for name in other.state_dict()})
    return predictor(model.name, other, sampler)


def predictor(name: str, module: ModesModule, sampler: PairSampler) -> TorchPredictor:
    """The module as what answers questions of this sampler."""
    reads = module.settings.reads
    sensing = reads != "activation"
    signature = Signature(
        inputs=module.inputs,
        outputs=module.outputs,
        convention=sampler.convention,
        sensors=tuple(sampler.sensors.tolist()) if sensing else (),
        any_sensors=sensing,
        least_sensors=1 if reads == "sensors" else 0,
        sensor_noise=module.settings.sensor_noise if sensing else None,
        unknown_activation=reads == "both",
    )
    return TorchPredictor(name, "modes", module, signature, module.built)


def _values(cases: MuscleCases, name: str, taught: Int[np.ndarray, " taught"]) -> np.ndarray:
    values = cases.values(name, taught)
    return values.reshape(*values.shape[:2], -1)


def _scaled(along: Float[np.ndarray, " cases"]) -> Float[np.ndarray, " cases"]:
    """From -RANGE to RANGE."""
    low, high = along.min(), along.max()
    if not high > low:
        raise InputError("coordinate: expected training cases at different elbow angles, got one for all")
    return RANGE * (2 * along - low - high) / (high - low)
