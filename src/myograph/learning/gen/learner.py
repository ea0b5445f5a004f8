"""The graph element network as a method that learns from pairs of cases."""

from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import torch
from jaxtyping import Float

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import PairSet, Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.inference.signature import Signature
from myograph.learning.gen.config import NetworkConfig, Reads
from myograph.learning.gen.muscle import MuscleGen
from myograph.learning.gen.scaling import fit_scaling
from myograph.learning.gen.trainable import GenTrainable
from myograph.learning.physics.terms import physics_terms
from myograph.learning.torch_predictor import TorchPredictor
from myograph.learning.training import History, TrainingConfig, train
from myograph.learning.training.about import about
from myograph.learning.training.drawing import hold_out

SCALED_ON = 64
"""Pairs that the unit of what a skip leaves over is made from."""
LEAST_AFFINE = 4
"""Points that decide an affine map of space."""


@dataclass(frozen=True)
class TrainedGen:
    """What came of a training.

    Parameters
    ----------
    nodes_before
        Positions of the graph's nodes before training [mm]; those after it are `module.nodes_mm`.
    """

    predictor: TorchPredictor
    module: MuscleGen
    history: History
    nodes_before: Float[np.ndarray, "nodes 3"]


@dataclass(frozen=True)
class GenLearner:
    """A `myograph.ensemble.pairs.predictor.Learner`.

    Parameters
    ----------
    called
        As it stands in tables; by default gen_8, gen_343: the number of nodes.
    folder
        Where the training writes its checkpoints and logs; nothing is written without it.
    """

    network: NetworkConfig = field(default_factory=NetworkConfig)
    training: TrainingConfig = field(default_factory=TrainingConfig)
    called: str | None = None
    folder: Path | None = None

    @property
    def name(self) -> str:
        """As it stands in tables."""
        return self.called or f"gen_{self.network.nodes_per_axis**3}"

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TorchPredictor:
        """Train on the split's training pairs; nothing of its other cases is looked at."""
        return self.train(sampler, split, progress).predictor

    def train(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TrainedGen:
        """Likewise, with all that came of it."""
        config = self.network
        if config.activation_input:
            config = config.model_copy(update={"reads": "sensors_and_activation"})
        taught, validated = hold_out(split.train, self.training.validation, self.training.seed)
        trainable = self._trainable(config, sampler, taught, validated)
        nodes_before = trainable.module.nodes_mm
        told = about(sampler, split, config.model_dump_json())
        history = train(trainable, self.training, progress, self.folder, told)
        module = trainable.module.eval()
        module.network.triangulate()
        signature = _signature(
            module,
            Signature(inputs=(), outputs=(), convention=sampler.convention, sensors=tuple(sampler.sensors.tolist())),
        )
        predictor = TorchPredictor(self.name, "gen", module, signature, config)
        if config.reads != self.network.reads:
            predictor = reading(predictor, self.network.reads)
        return TrainedGen(predictor, module, history, nodes_before)

    def _trainable(
        self, config: NetworkConfig, sampler: PairSampler, taught: PairSet, validated: PairSet
    ) -> GenTrainable:
        if self.training.compile and config.physics.volume:
            raise InputError(
                "compile: with physics.volume the loss has derivatives of derivatives, which torch.compile does not; "
                "set volume to 0, or compile to false"
            )
        features = tuple(dict.fromkeys(config.input_features + config.output_features))
        scaling = fit_scaling(sampler, taught, features, self.training.seed)
        module = MuscleGen(config, scaling, self.training.seed)
        _check_sampler(module, sampler)
        physics = physics_terms(config.physics, sampler, taught)
        trainable = GenTrainable(module, sampler, taught, validated, self.training, physics)
        if config.skip == "affine":
            _scale_what_is_left(trainable)
        return trainable


def reading(predictor: TorchPredictor, reads: Reads) -> TorchPredictor:
    """The same network, answering from sensors, from activations, or from both.

    Raises InputError for a predictor that is no graph element network with an activation input, and for one without
    dropout in its training, which does not answer from one of them alone.
    """
    config, module = predictor.config, predictor.module
    if not isinstance(config, NetworkConfig) or not isinstance(module, MuscleGen) or not config.activation_input:
        raise InputError(f"{predictor.name}: expected a graph element network with an activation input")
    if not config.dropout and reads != "sensors_and_activation":
        raise InputError(f"{predictor.name}: it never learned to answer from one alone; train it with dropout")
    other = MuscleGen(config.model_copy(update={"reads": reads}), module.scaling, seed=0)
    other.load_state_dict(module.state_dict())
    signature = _signature(other, predictor.signature)
    return replace(predictor, module=other.eval(), signature=signature, config=other.config)


def _signature(module: MuscleGen, trained: Signature) -> Signature:
    """What the module takes and gives, with the sensors and the convention of the training.

    Only steps with dropout teach to do without sensors, or without activations.
    """
    mean = module.config.aggregation == "mean"
    either = module.config.reads == "sensors_and_activation" and module.config.dropout > 0
    return Signature(
        inputs=module.inputs,
        outputs=module.outputs,
        convention=trained.convention,
        sensors=trained.sensors,
        any_sensors=mean,
        least_sensors=0 if either and mean else _least(module, len(trained.sensors)),
        unknown_activation=either,
    )


def _least(module: MuscleGen, trained: int) -> int:
    """Sensors that it needs: those that decide the affine map, where that is in it, or all of fewer."""
    return min(LEAST_AFFINE, trained) if module.config.skip == "affine" else 1


def _check_sampler(module: MuscleGen, sampler: PairSampler) -> None:
    lacking = [name for name in module.outputs if name not in sampler.asked]
    if lacking:
        raise InputError(f"sampler: expected one that asks for {', '.join(lacking)}, got {', '.join(sampler.asked)}")


def _scale_what_is_left(trainable: GenTrainable) -> None:
    """Set the unit of the outputs to the root mean square of what the skip does not explain."""
    module = trainable.module
    pairs = trainable.pairs.draw(np.random.default_rng(trainable.config.seed), SCALED_ON)
    with torch.no_grad():
        left = module.wanted(*trainable.tensors(trainable.sampler.batch(pairs)))
        module.output_unit.mul_(left.square().mean().sqrt())
