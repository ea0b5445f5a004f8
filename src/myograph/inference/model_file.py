"""What `model.json` of a saved model says: `{"model": ModelFile, "sha256": checksum of that}`.

A saved model is one folder:

    model.json             this
    model.onnx             the network, for onnxruntime in any language
    body.npz               the body that it knows: see `myograph.inference.body_file`
    weights.safetensors    the weights, to go on training
    card.md                the same for people
"""

import hashlib
import json
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from myograph.case import MUSCLES, check_muscle
from myograph.config import Model, parse
from myograph.errors import InputError
from myograph.fields import FIELDS
from myograph.files import read_bounded
from myograph.inference.answers import check_outputs
from myograph.inference.feeds import check_inputs
from myograph.inference.signature import Signature
from myograph.inference.ways import Way

SCHEMA = 1
MODEL_FILE, NETWORK, BODY, WEIGHTS, CARD = "model.json", "model.onnx", "body.npz", "weights.safetensors", "card.md"
MOST_BYTES = {MODEL_FILE: 2**20, NETWORK: 2**29, BODY: 2**26, WEIGHTS: 2**29, CARD: 2**20}
"""The files of a saved model, and how large each may be; larger ones are not read."""

Number = Annotated[float, Field(allow_inf_nan=False)]
Scale = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Word = Annotated[str, Field(pattern=r"^[^\x00-\x1f\x7f-\x9f]*$")]
"""Text of one line that a terminal may show: no control characters."""
PerMuscle = Annotated[tuple[Number, ...], Field(min_length=len(MUSCLES), max_length=len(MUSCLES))]


class FileRecord(Model):
    """Size and SHA-256 of a file."""

    size: int = Field(ge=0)
    sha256: str = Field(pattern="^[0-9a-f]{64}$")


class TrainedRange(Model):
    """What the training cases cover.

    Parameters
    ----------
    activation_low, activation_high
        Least and largest activation of each muscle, in the order of `myograph.MUSCLES`.
    hand_load
        Least and largest load [N].
    residual_mm
        Largest `sensor_residual` that is still inside; None where the model gives none.
    """

    activation_low: PerMuscle
    activation_high: PerMuscle
    hand_load: tuple[Number, Number]
    residual_mm: Number | None = None


class Origin(Model):
    """Where the model comes from.

    Parameters
    ----------
    dataset
        Checksum of all that learning read (`MuscleCases.checksum`).
    arm_checksum, preset, simulator
        Of the cases; empty where these do not say.
    protocol, split_seed
        Which pairs taught (`myograph.ensemble.pairs.protocols`).
    factorial
        Checksum of the list that the split was drawn from (`myograph.inference.held_out`); empty where the file does
        not say: those models were taught on the 32 corners.
    cases
        Number of cases that taught.
    seed
        Of the training.
    command, seconds
        How to do it again, and how long that took [s].
    versions
        Package -> version.
    """

    dataset: str
    arm_checksum: str
    preset: str
    simulator: str
    protocol: str
    split_seed: int
    factorial: str = ""
    cases: int
    seed: int
    command: str
    seconds: Number
    versions: dict[str, str]


class ModelFile(Model):
    """All that is said about a model.

    Parameters
    ----------
    name, method
        As it stands in tables; which kind of model it is.
    muscle
        Whose body it knows.
    signature
        Inputs and outputs of the network by name, convention, sensors.
    fields
        What it answers -> unit.
    config
        How the network is built, by the method's own model.
    parameters
        Number of trained numbers.
    opset
        Of model.onnx.
    parity
        Largest difference of torch and onnxruntime over the largest value of the output, when it was saved.
    metrics
        Protocol -> figure -> value, when it was saved.
    half_width_90
        Field -> half the width of the interval that holds 90 % of the truth: times the deviation where the network
        gives one, else in the field's unit; where the model is told all that it takes.
    half_width_90_from
        Likewise where a model that reads both is told activations alone, or sensors alone: 'activation', 'sensors' ->
        field -> scale; where it says nothing, that of `half_width_90`.
    trained_range, origin
        What the training covered, and where the model comes from.
    limits
        What not to use it for, a sentence each.
    files
        Size and checksum of each of the other files.
    """

    schema_version: Literal[1] = SCHEMA
    name: Word
    method: Word
    muscle: str
    signature: Signature
    fields: dict[str, str]
    config: dict[str, Any]
    parameters: int
    opset: int
    parity: Number
    metrics: dict[str, dict[str, Number]]
    half_width_90: dict[str, Scale]
    half_width_90_from: dict[Way, dict[str, Scale]] = Field(default_factory=dict)
    trained_range: TrainedRange
    origin: Origin
    limits: tuple[str, ...]
    files: dict[str, FileRecord]


def model_text(told: ModelFile) -> str:
    """The text of model.json."""
    content = told.model_dump(mode="json")
    return json.dumps({"model": content, "sha256": _checksum(content)}, indent=2)


def read_model_file(folder: Path) -> ModelFile:
    """Read and check model.json; raises InputError where it is missing, altered, or says what cannot be."""
    path = folder / MODEL_FILE
    content = _unpacked(folder, path)
    schema = content.get("schema_version")
    if schema != SCHEMA:
        raise InputError(f"{path}: expected schema version {SCHEMA}, got {schema!r}; use the myograph that wrote it")
    told = parse(content, ModelFile, str(path))
    try:
        _check(told)
    except InputError as problem:
        raise InputError(f"{path}: {problem}") from None
    return told


def read_file(folder: Path, name: str, record: FileRecord) -> bytes:
    """The bytes of a file of the model; raises InputError unless they are those that were written."""
    path = folder / name
    if record.size > MOST_BYTES[name]:
        raise InputError(f"{path}: expected a file of at most {MOST_BYTES[name]} bytes, got one of {record.size}")
    data = read_bounded(path, MOST_BYTES[name])
    if len(data) != record.size:
        raise InputError(f"{path}: expected a file of {record.size} bytes, got {len(data)}; copy the model anew")
    found = hashlib.sha256(data).hexdigest()
    if found != record.sha256:
        raise InputError(f"{path}: expected SHA-256 {record.sha256}, got {found}: it was altered; copy the model anew")
    return data


def _unpacked(folder: Path, path: Path) -> dict[str, Any]:
    try:
        there = path.exists()
    except OSError as problem:
        raise InputError(f"{path}: cannot be read: {problem.strerror}") from None
    if not there:
        raise InputError(f"{folder}: expected the folder of a saved model, found no {MODEL_FILE} there")
    data = read_bounded(path, MOST_BYTES[MODEL_FILE])
    try:
        whole = json.loads(data.decode("utf-8"))
        content, checksum = dict(whole["model"]), whole["sha256"]
    except (ValueError, KeyError, TypeError, RecursionError) as problem:
        raise InputError(f"{path}: not a saved model: {problem}") from None
    if checksum != _checksum(content):
        raise InputError(f"{path}: its content does not match its own checksum: it was altered; copy the model anew")
    return content


def _check(told: ModelFile) -> None:
    check_muscle(told.muscle)
    check_inputs(told.signature.inputs)
    check_outputs(told.signature.outputs)
    scaled = {name for scales in (told.half_width_90, *told.half_width_90_from.values()) for name in scales}
    foreign = sorted(scaled - set(told.signature.fields))
    if foreign:
        raise InputError(
            f"half_width_90: expected some of {', '.join(told.signature.fields)}, got {', '.join(foreign)}"
        )
    units = {name: FIELDS[name].unit for name in told.signature.fields}
    if told.fields != units:
        raise InputError(f"fields: expected {units}, got {told.fields}")
    others = set(MOST_BYTES) - {MODEL_FILE}
    if set(told.files) != others:
        raise InputError(f"files: expected {', '.join(sorted(others))}, got {', '.join(sorted(told.files)) or 'none'}")


def _checksum(content: Any) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
