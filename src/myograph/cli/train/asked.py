"""What `myograph train` is asked: a TOML file. docs/training.md has an example."""

import json
import os
from pathlib import Path
from typing import Any

from pydantic import Field

from myograph.case import MUSCLES
from myograph.config import Model, read_toml
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import Protocol
from myograph.ensemble.pairs.question import Convention
from myograph.ensemble.pairs.sampler import SENSOR_SEED, SENSORS, PairSampler, listed_sensors, random_sensors
from myograph.errors import InputError
from myograph.files import write_whole

RECORD, TRAINING = "train.json", "training"
"""In the folder of a training: what is trained there, and the folder of its steps."""
JUDGED = {"position", "von_mises", "cauchy_stress"}
"""Fields whose errors are told."""


class TrainFile(Model):
    """Settings of a training as a whole.

    Parameters
    ----------
    store
        Folder of the ensemble's store, relative to the file.
    muscle
        Which of its muscles.
    protocol
        Whose pairs teach.
    split_seed
        Which cases are held out.
    sensors, sensor_seed
        Nodes that are sensors: so many at random, or these.
    convention
        How points are named.
    known, asked
        Fields that sensors tell, fields that are learned.
    method
        A name of `myograph.learning.learners.LEARNERS`.
    options, training
        Settings of the method and of its training.
    calibration
        Share of the training cases that teach nothing and calibrate the 90 % intervals, where it is nine or more; 0 for
        none.
    pairs
        Test pairs of each protocol, at most, drawn at random.
    """

    method: str
    store: Path | None = None
    muscle: str = "biceps"
    protocol: Protocol = "strict"
    split_seed: int = Field(default=0, ge=0)
    sensors: int | tuple[int, ...] = SENSORS
    sensor_seed: int = Field(default=SENSOR_SEED, ge=0)
    convention: Convention = "initial"
    known: tuple[str, ...] = ("position",)
    asked: tuple[str, ...] = Field(default=("position",), min_length=1)
    options: dict[str, Any] = Field(default_factory=dict)
    training: dict[str, Any] = Field(default_factory=dict)
    calibration: float = Field(default=0.15, ge=0, lt=1)
    pairs: int = Field(default=500, ge=1)


def read_train_file(path: Path, store: Path | None, device: str | None) -> tuple[TrainFile, Path]:
    """The settings and the store, with what the command line says over what the file says.

    Raises InputError for a file that is wrong, or where no store is named.
    """
    asked = read_toml(path, TrainFile)
    if asked.muscle not in MUSCLES:
        raise InputError(f"{path}: muscle: expected one of {', '.join(MUSCLES)}, got '{asked.muscle}'")
    if asked.options.get("surface_only"):
        raise InputError(f"{path}: surface_only: a saved model answers at all nodes; leave it out, or fit from Python")
    if device is not None:
        asked = asked.model_copy(update={"training": {**asked.training, "device": device}})
    found = store or (path.parent / asked.store if asked.store else None)
    if found is None:
        raise InputError(f"{path}: expected 'store', the folder of an ensemble, got none; name it there, or by --data")
    return asked, found


def make_sampler(asked: TrainFile, cases: MuscleCases) -> PairSampler:
    """Questions about the cases, as asked for."""
    if isinstance(asked.sensors, int):
        sensors = random_sensors(cases.nodes, asked.sensors, asked.sensor_seed)
    else:
        sensors = listed_sensors(asked.sensors, cases.nodes)
    sampler = PairSampler(cases, sensors, asked.convention, asked.known, asked.asked)
    if not JUDGED & set(asked.asked):
        raise InputError(f"asked: expected one of {', '.join(sorted(JUDGED))} among them: nothing else is judged")
    return sampler


def check_folder(out: Path, asked: TrainFile, cases: MuscleCases) -> None:
    """Raise InputError unless that training is there, or nothing, and could be written; it only reads.

    A folder without the record but with `training/` was left before the first step: what lies there checks itself.
    """
    found = _read_record(out)
    if found is None:
        if out.exists() and (not out.is_dir() or any(_is_foreign(path) for path in out.iterdir())):
            raise InputError(f"{out}: expected a training or nothing, got something else; choose another folder")
        nearest = next(place for place in (out, *out.parents) if place.exists())
        if not nearest.is_dir() or not os.access(nearest, os.W_OK):
            raise InputError(f"{out}: cannot be written, as {nearest} is none that can; choose another folder")
        return
    for name, value in _record(asked, cases).items():
        if not isinstance(found, dict) or found.get(name) != value:
            was = found.get(name) if isinstance(found, dict) else found
            raise InputError(f"{out}: holds another training: {name} was {was}, now {value}; choose another folder")


def claim_folder(out: Path, asked: TrainFile, cases: MuscleCases) -> None:
    """Write down what is trained there, unless it is written already.

    Raises InputError where something else is: of two that began at once, whoever was first, when it claims again.
    """
    path = out / RECORD
    if path.exists():
        check_folder(out, asked, cases)
    else:
        write_whole(path, lambda file: file.write(json.dumps(_record(asked, cases), indent=2).encode()))


def _record(asked: TrainFile, cases: MuscleCases) -> dict[str, Any]:
    return {"data": cases.checksum, **asked.model_dump(mode="json", exclude={"store", "pairs", "training"})}


def _read_record(out: Path) -> Any:
    path = out / RECORD
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError) as problem:
        raise InputError(f"{path}: cannot be read: {problem}; choose another folder") from None


def _is_foreign(path: Path) -> bool:
    return path.name != TRAINING and not path.name.startswith(f".{RECORD}-")
