"""The deep operator network as a method that learns: see `deeponet_module`."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import final

import numpy as np
import torch
from jaxtyping import Float, Int
from torch import Tensor

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.signature import Signature
from myograph.learning.baselines.by_cases import Training, train_by_cases
from myograph.learning.baselines.deeponet_module import DeepONetConfig, DeepONetModule, DeepONetShape
from myograph.learning.baselines.taught import Taught, taught, taught_cases
from myograph.learning.torch_predictor import TorchPredictor
from myograph.learning.training import TrainingConfig
from myograph.learning.training.about import about

DEEPONET_TRAINING = TrainingConfig(steps=4000, batch=64, queries=256, learning_rate=3e-3)


@final
@dataclass(frozen=True)
class DeepONet:
    """A `myograph.ensemble.pairs.predictor.Learner`: the method before it has seen data.

    Parameters
    ----------
    folder
        Where the training writes its checkpoints and logs; nothing is written without it.
    """

    network: DeepONetConfig = field(default_factory=DeepONetConfig)
    training: TrainingConfig = DEEPONET_TRAINING
    folder: Path | None = None
    name: str = "deeponet"

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TorchPredictor:
        """Train on the target cases of the training pairs."""
        told, cases, drives = taught(sampler, split), sampler.cases, self.network.drive != "activation"
        sensed = [_sensor_positions(sampler, split)] if drives else []
        shape = DeepONetShape(
            **self.network.model_dump(),
            fields=tuple(told.fields),
            muscles=told.activation.shape[1],
            sensors=len(sampler.sensors) if drives else 0,
            body_nodes=cases.nodes,
            convention=sampler.convention,
        )
        module = DeepONetModule(shape, self.training.seed)
        module.fit_scaling(told, cases.body.reference, sensed)
        train_by_cases(
            module,
            told,
            _Asking(module, told, sensed),
            np.arange(cases.nodes),
            Training(self.training, progress, self.folder, about(sampler, split, shape.model_dump_json())),
        )
        signature = Signature(
            inputs=shape.inputs,
            outputs=shape.fields,
            convention=sampler.convention,
            sensors=tuple(sampler.sensors.tolist()) if drives else (),
        )
        return TorchPredictor(self.name, "deeponet", module, signature, shape)


class _Asking:
    """What the module is given for some of the taught cases, asked at these nodes."""

    def __init__(self, module: DeepONetModule, told: Taught, sensed: Sequence[Float[np.ndarray, "cases sensors 3"]]):
        self._shape, self._reference = module.shape, module.reference.clone()
        drives = [] if module.shape.drive == "sensors" else [told.activation]
        self._drives = [torch.from_numpy(np.asarray(part, dtype=np.float32)) for part in (*drives, *sensed)]

    def __call__(self, cases: Int[np.ndarray, " cases"], queries: Int[np.ndarray, " queries"]) -> list[Tensor]:
        asked = torch.from_numpy(queries)
        places = self._reference[asked][None] if self._shape.convention == "material" else asked
        return [*(part[cases] for part in self._drives), places]


def _sensor_positions(sampler: PairSampler, split: Split) -> Float[np.ndarray, "cases sensors 3"]:
    return sampler.cases.values("position", taught_cases(split))[:, sampler.sensors]
