"""Neural modes out of the folders of saved models; every file is checked as `myograph.inference.loaded.load` does.

One folder is one muscle; a folder of such folders is an arm, whose muscles share their networks.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import numpy as np
import safetensors
import safetensors.numpy
from pydantic import ConfigDict, Field

from myograph.case import MUSCLES
from myograph.config import Model, parse
from myograph.errors import InputError
from myograph.fields import FIELDS
from myograph.inference.body_file import body_of
from myograph.inference.low_rank.angle import AngleNetwork
from myograph.inference.low_rank.field import RANGE, LowRankField
from myograph.inference.low_rank.muscle import LowRankMuscle
from myograph.inference.model_file import BODY, CARD, MODEL_FILE, NETWORK, WEIGHTS, read_file, read_model_file

METHOD = "modes"
MOST_X = {"activation": 1.0, "both": 1.1 * RANGE}
"""How far the model lets its networks go, by what it reads."""
_LAYERS = ("first", "first_offset", "second", "second_offset", "last", "last_offset")
Degree = Annotated[int, Field(ge=0, le=64)]


class _Part(Model):
    """What is needed of a configuration; the rest of it is the method's own."""

    model_config = ConfigDict(extra="ignore", frozen=True)


class _Settings(_Part):
    reads: str
    activation_noise: float = Field(ge=0)


class _Shape(_Part):
    name: str
    degrees: tuple[Degree, Degree]


class _Built(_Part):
    settings: _Settings
    own: int = Field(ge=0, lt=len(MUSCLES))
    fields: tuple[_Shape, ...]


def read_low_rank(folder: Path | str) -> LowRankMuscle:
    """Neural modes that answer from activations.

    Raises InputError where the folder is missing, truncated, altered, of another schema or another method, answers from
    sensors only, or does not fit together.
    """
    folder = Path(folder)
    told = read_model_file(folder)
    built = _built(folder, told.method, told.config)
    data = {name: read_file(folder, name, told.files[name]) for name in (BODY, CARD, NETWORK, WEIGHTS)}
    body = body_of(data[BODY], str(folder / BODY)).body
    weights = _arrays(data[WEIGHTS], folder / WEIGHTS)
    both = built.settings.reads == "both"
    return LowRankMuscle(
        name=told.name,
        muscle=told.muscle,
        own=built.own,
        fields={shape.name: _field(shape, weights, len(body.reference), folder / WEIGHTS) for shape in built.fields},
        angle=_angle(weights, folder / WEIGHTS),
        most_x=MOST_X[built.settings.reads],
        own_deviation=2 * RANGE * built.settings.activation_noise if both else 0.0,
        reference=body.reference.astype(np.float64),
        skin=body.skin.astype(np.int64),
        cells=body.cells.astype(np.int64),
        trained_range=told.trained_range,
        half_width_90={**told.half_width_90, **told.half_width_90_from.get("activation", {})},
        checksum=told.files[WEIGHTS].sha256,
    )


def read_low_rank_arm(folder: Path | str) -> dict[str, LowRankMuscle]:
    """Muscle -> model, in the order of `myograph.MUSCLES`, of a folder of saved models; of one model, an arm of one.

    Raises InputError as `read_low_rank` does, for no model, two of one muscle, and muscles of different networks.
    """
    folder = Path(folder)
    inside = sorted(folder.iterdir()) if folder.is_dir() and not (folder / MODEL_FILE).exists() else []
    folders = [path for path in inside if (path / MODEL_FILE).is_file()] or [folder]
    found: dict[str, LowRankMuscle] = {}
    for path in folders:
        muscle = read_low_rank(path)
        if muscle.muscle in found:
            raise InputError(f"{folder}: expected one model of each muscle, got two of {muscle.muscle}")
        found[muscle.muscle] = muscle
    first, *others = found.values()
    apart = [other.muscle for other in others if not other.angle.same(first.angle)]
    if apart:
        raise InputError(
            f"{folder}: expected muscles that share one network for the elbow's angle, got another one of "
            f"{', '.join(apart)} than of {first.muscle}; fit all muscles of the arm together"
        )
    return {name: found[name] for name in MUSCLES if name in found}


def _built(folder: Path, method: str, config: Mapping[str, object]) -> _Built:
    if method != METHOD:
        raise InputError(f"{folder}: expected neural modes (method '{METHOD}'), got the method '{method}'")
    built = parse(dict(config), _Built, str(folder / MODEL_FILE))
    if built.settings.reads not in MOST_X:
        raise InputError(f"{folder}: expected a model that answers from activations, got one that reads sensors")
    if "position" not in {shape.name for shape in built.fields} or any(s.name not in FIELDS for s in built.fields):
        named = ", ".join(shape.name for shape in built.fields)
        raise InputError(
            f"{folder / MODEL_FILE}: expected the field position and others of {list(FIELDS)}, got {named}"
        )
    return built


def _arrays(data: bytes, path: Path) -> dict[str, np.ndarray]:
    try:
        return {name: array.astype(np.float64) for name, array in safetensors.numpy.load(data).items()}
    except (safetensors.SafetensorError, KeyError, ValueError) as problem:
        raise InputError(f"{path}: not a file of weights: {problem}") from None


def _field(shape: _Shape, weights: Mapping[str, np.ndarray], nodes: int, path: Path) -> LowRankField:
    components = len(FIELDS[shape.name].components) or 1
    terms = (shape.degrees[0] + 1) * (shape.degrees[1] + 1)
    start = f"fields.{shape.name}."
    mean = _taken(weights, start + "mean", (nodes, components), path)
    modes = _taken(weights, start + "modes", (nodes, components, None), path)
    return LowRankField(
        name=shape.name,
        components=components,
        mean=mean,
        modes=np.ascontiguousarray(modes.transpose(2, 0, 1)),
        degrees=shape.degrees,
        weights=_taken(weights, start + "weights", (terms, modes.shape[2]), path),
        misfit=_taken(weights, start + "misfit", (nodes,), path),
    )


def _angle(weights: Mapping[str, np.ndarray], path: Path) -> AngleNetwork:
    inputs = len(MUSCLES) + 1
    members, _, width = _taken(weights, "angle.first", (None, inputs, None), path).shape
    shapes = ((inputs, width), (1, width), (width, width), (1, width), (width, 1), (1, 1))
    layers = {
        name: _taken(weights, f"angle.{name}", (members, *shape), path)
        for name, shape in zip(_LAYERS, shapes, strict=True)
    }
    ends = _taken(weights, "angle_range", (2,), path) if "angle_range" in weights else np.full(2, np.nan)
    return AngleNetwork(
        centre=_taken(weights, "angle.centre", (inputs,), path),
        scale=_taken(weights, "angle.scale", (inputs,), path),
        first=layers["first"],
        first_offset=layers["first_offset"][:, 0],
        second=layers["second"],
        second_offset=layers["second_offset"][:, 0],
        last=layers["last"][:, :, 0],
        last_offset=layers["last_offset"][:, 0, 0],
        misfit=float(_taken(weights, "angle_misfit", (), path)),
        ends=(float(ends[0]), float(ends[1])) if np.isfinite(ends).all() else None,
    )


def _taken(weights: Mapping[str, np.ndarray], name: str, shape: tuple[int | None, ...], path: Path) -> np.ndarray:
    found = weights.get(name)
    got = None if found is None else found.shape
    if got is None or len(got) != len(shape) or any(w not in (None, g) for w, g in zip(shape, got, strict=True)):
        raise InputError(f"{path}: expected '{name}' of the shape {shape}, got {got}: it does not fit model.json")
    assert found is not None
    if name != "angle_range" and not np.isfinite(found).all():
        raise InputError(f"{path}: expected finite numbers in '{name}', got NaN or infinity")
    return found
