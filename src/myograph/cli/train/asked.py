"""What `myograph train` is asked: a TOML file. docs/training.md has an example."""

import json
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

RECORD = "train.json"


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
    asked: tuple[str, ...] = ("position",)
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
    return PairSampler(cases, sensors, asked.convention, asked.known, asked.asked)


def claim_folder(out: Path, asked: TrainFile, cases: MuscleCases) -> None:
    """Write down what is trained there; raise InputError where something else is."""
    settings = asked.model_dump(mode="json", exclude={"store", "pairs", "training"})
    wanted = {"data": cases.checksum, **settings}
    path = out / RECORD
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        found = None
    except (OSError, ValueError) as problem:
        raise InputError(f"{path}: cannot be read: {problem}; choose another folder") from None
    if found is None:
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise InputError(f"{out}: expected a training or nothing, got something else; choose another folder")
        write_whole(path, lambda file: file.write(json.dumps(wanted, indent=2).encode()))
        return
    for name, value in wanted.items():
        if not isinstance(found, dict) or found.get(name) != value:
            was = found.get(name) if isinstance(found, dict) else found
            raise InputError(f"{out}: holds another training: {name} was {was}, now {value}; choose another folder")
