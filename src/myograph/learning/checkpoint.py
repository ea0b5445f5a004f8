"""A trained graph element network as a folder: nothing in it is ever unpickled.

    model.json    configuration, scaling, units, sensors, muscle, checksums of the training data and of the other files
    weights.npz   parameters by name, float32
    history.npz   course of the training

Reading checks the SHA-256 of every file, model.json included, and the shapes of the weights.
"""

import hashlib
import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
import torch

from myograph.config import Model, parse
from myograph.ensemble.pairs import Source
from myograph.errors import InputError
from myograph.files import write_whole_folder
from myograph.learning.config import NetworkConfig, TrainingConfig
from myograph.learning.gen import VALUES, Gen, TrainingRecord
from myograph.learning.network import GraphElementNetwork
from myograph.learning.scaling import Scaling

WEIGHTS, HISTORY = "weights.npz", "history.npz"


class ModelFile(Model):
    """What model.json says; `checksums` are those of the files beside it."""

    method: Literal["graph_element_network"] = "graph_element_network"
    schema_version: Literal[1] = 1
    units: Literal["mm"] = "mm"
    network: NetworkConfig
    scaling: Scaling
    sensors: tuple[int, ...]
    source: Source
    protocol: str
    training: TrainingConfig
    seconds: float
    checksums: dict[str, str]


def save_gen(gen: Gen, folder: Path) -> None:
    """Write the folder: beside its place first, then renamed, so that it is never half there.

    Replaces a saved model; raises InputError where the folder is something else, or cannot be written.
    """
    if folder.exists() and not (folder / "model.json").is_file():
        raise InputError(f"{folder}: expected a saved model or nothing, got something else; choose another place")
    write_whole_folder(folder, lambda aside: _write(gen, aside))


def load_gen(folder: Path) -> Gen:
    """Read a saved model; raises InputError where it is missing, truncated or altered."""
    told = _read_model_file(folder)
    weights, history = (_read_arrays(folder / name, told.checksums.get(name)) for name in (WEIGHTS, HISTORY))
    network = GraphElementNetwork(told.network, told.scaling.unit_sides, VALUES, VALUES, told.training.seed)
    try:
        network.load_state_dict({name: torch.tensor(array) for name, array in weights.items()})
    except RuntimeError as problem:
        raise InputError(f"{folder / WEIGHTS}: does not fit model.json: {problem}") from None
    network.triangulate()
    record = TrainingRecord(
        told.training, history["rmse"], told.seconds, history["nodes_before"], history["nodes_after"]
    )
    return Gen(network.eval(), told.scaling, np.array(told.sensors), told.source, told.protocol, record)


def _write(gen: Gen, folder: Path) -> None:
    folder.mkdir()
    record = gen.record
    _write_arrays(folder / WEIGHTS, {name: tensor.numpy() for name, tensor in gen.network.state_dict().items()})
    history = {"rmse": record.rmse, "nodes_before": record.nodes_before, "nodes_after": record.nodes_after}
    _write_arrays(folder / HISTORY, history)
    model = ModelFile(
        network=gen.network.config,
        scaling=gen.scaling,
        sensors=tuple(gen.sensors.tolist()),
        source=gen.source,
        protocol=gen.protocol,
        training=record.config,
        seconds=record.seconds,
        checksums={name: _sha256((folder / name).read_bytes()) for name in (WEIGHTS, HISTORY)},
    ).model_dump(mode="json")
    text = json.dumps({"model": model, "sha256": _sha256(_canonical(model))}, indent=2)
    (folder / "model.json").write_text(text, encoding="utf-8")


def _read_model_file(folder: Path) -> ModelFile:
    path = folder / "model.json"
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        model, checksum = content["model"], content["sha256"]
    except FileNotFoundError:
        raise InputError(f"{folder}: expected the folder of a saved model, found no model.json there") from None
    except (OSError, ValueError, KeyError, TypeError) as problem:
        raise InputError(f"{path}: not a saved model: {problem}") from None
    if checksum != _sha256(_canonical(model)):
        raise InputError(f"{path}: its content does not match its own checksum: it was altered; train or copy it anew")
    return parse(model, ModelFile, str(path))


def _write_arrays(path: Path, arrays: dict[str, Any]) -> None:
    np.savez(path, **arrays)


def _read_arrays(path: Path, checksum: str | None) -> Mapping[str, np.ndarray]:
    try:
        found = _sha256(path.read_bytes())
    except OSError as problem:
        raise InputError(f"{path}: cannot be read: {problem.strerror}") from None
    if found != checksum:
        raise InputError(f"{path}: expected SHA-256 {checksum}, got {found}: truncated or altered; copy it anew")
    try:
        with np.load(path, allow_pickle=False) as arrays:
            return dict(arrays)
    except (ValueError, zipfile.BadZipFile) as problem:
        raise InputError(f"{path}: not a file of plain arrays: {problem}") from None


def _canonical(content: Any) -> bytes:
    return json.dumps(content, sort_keys=True).encode()


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
