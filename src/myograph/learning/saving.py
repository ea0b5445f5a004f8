"""A trained model as a folder that is whole or not there, and back to torch.

What lies in it: `myograph.inference.model_file`. The network must answer alike in torch and in onnxruntime before
anything is written: over the outputs' values, max |difference| / max |value| <= 1e-5.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import safetensors
import safetensors.torch
from pydantic import ConfigDict

from myograph.config import Model
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import Split
from myograph.errors import InputError
from myograph.fields import FIELDS
from myograph.inference.body_file import body_bytes
from myograph.inference.held_out import factorial_checksum
from myograph.inference.model_file import (
    BODY,
    CARD,
    NETWORK,
    WEIGHTS,
    ModelFile,
    Origin,
    TrainedRange,
    read_file,
    read_model_file,
)
from myograph.inference.ways import Way
from myograph.inference.writing import check_place, write_model
from myograph.learning.methods import Rebuild, rebuild_of
from myograph.learning.model_card import card
from myograph.learning.onnx_export import Exported, export
from myograph.learning.saveable import Saveable
from myograph.learning.taught import installed, model_body, trained_range
from myograph.learning.torch_predictor import TorchPredictor, trained_numbers


@dataclass(frozen=True)
class Training:
    """What became of the training, for whoever gets the model.

    Parameters
    ----------
    cases, split, split_seed
        What was learned from.
    seed, command, seconds
        Of the training: how to do it again, and how long it took [s].
    metrics
        Protocol -> figure -> value.
    half_width_90, half_width_90_from, residual_mm
        Calibration, as in `ModelFile` and `TrainedRange`.
    limits
        What not to use it for, a sentence each.
    """

    cases: MuscleCases
    split: Split
    split_seed: int = 0
    seed: int = 0
    command: str = ""
    seconds: float = 0.0
    metrics: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    half_width_90: Mapping[str, float] = field(default_factory=dict)
    half_width_90_from: Mapping[Way, Mapping[str, float]] = field(default_factory=dict)
    residual_mm: float | None = None
    limits: tuple[str, ...] = ()


class AsSaved(Model):
    """A configuration as model.json says it; the module that was made of it may hold its own."""

    model_config = ConfigDict(extra="allow", frozen=True)


def save_model(model: Saveable, training: Training, folder: Path, opset: int = 18) -> ModelFile:
    """Write the folder; it replaces a saved model, and nothing else. What model.json says is given back.

    Raises InputError where the folder is something else or cannot be written, NotConvergedError where onnxruntime
    answers otherwise than torch.
    """
    check_place(folder)
    exported = export(model, training.cases, training.split, opset)
    state = {name: tensor.detach().cpu().contiguous().clone() for name, tensor in model.module.state_dict().items()}
    told = _told(model, training, trained_range(training.cases, training.split, training.residual_mm), exported)
    files = {
        NETWORK: exported.network,
        BODY: body_bytes(model_body(training.cases, training.split, model.signature.rest_fields)),
        WEIGHTS: safetensors.torch.save(state),
        CARD: card(told, training.cases.nodes).encode(),
    }
    return write_model(told, files, folder)


def load_torch(folder: Path, rebuild: Rebuild | None = None) -> TorchPredictor:
    """The model with its weights in torch, to go on training.

    `rebuild` makes the module of a method that `myograph.learning.methods` does not know. Raises InputError where the
    folder is missing, truncated, altered, or does not fit its own configuration.
    """
    told = read_model_file(folder)
    path = folder / WEIGHTS
    try:
        state = safetensors.torch.load(read_file(folder, WEIGHTS, told.files[WEIGHTS]))
    except safetensors.SafetensorError as problem:
        raise InputError(f"{path}: not a file of weights: {problem}") from None
    shapes = {name: tuple(tensor.shape) for name, tensor in state.items()}
    build = rebuild or rebuild_of(told.method)
    try:
        module = build(told.config, shapes)
        module.load_state_dict(state)
    except (ArithmeticError, LookupError, MemoryError, RuntimeError, TypeError, ValueError) as problem:
        raise InputError(f"{path}: does not fit what model.json says: {problem}") from None
    return TorchPredictor(told.name, told.method, module.eval(), told.signature, AsSaved(**told.config))


def _told(model: Saveable, training: Training, trained: TrainedRange, exported: Exported) -> ModelFile:
    attributes = training.cases.attributes
    origin = Origin(
        dataset=training.cases.checksum,
        **{key: attributes.get(key, "") for key in ("arm_checksum", "preset", "simulator")},
        protocol=training.split.protocol,
        split_seed=training.split_seed,
        factorial=factorial_checksum(training.cases),
        cases=len(training.split.train.cases),
        seed=training.seed,
        command=training.command,
        seconds=training.seconds,
        versions=installed(),
    )
    return ModelFile(
        name=model.name,
        method=model.method,
        muscle=training.cases.muscle,
        signature=model.signature,
        fields={name: FIELDS[name].unit for name in model.signature.fields},
        config=model.config.model_dump(mode="json"),
        parameters=trained_numbers(model.module),
        opset=exported.opset,
        parity=exported.parity,
        metrics={protocol: dict(figures) for protocol, figures in training.metrics.items()},
        half_width_90=dict(training.half_width_90),
        half_width_90_from={way: dict(scales) for way, scales in training.half_width_90_from.items()},
        trained_range=trained,
        origin=origin,
        limits=training.limits,
        files={},
    )
