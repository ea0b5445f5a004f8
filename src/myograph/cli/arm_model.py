"""Saved neural modes of an arm as verbs ask for them: which folder, which state, which movement."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from jaxtyping import Float

from myograph.case import MUSCLES, check_muscle
from myograph.cli.options import read_arm
from myograph.cli.predict import activation_numbers
from myograph.ensemble.store.plan import PLAN
from myograph.errors import InputError
from myograph.export.gltf import Keys
from myograph.export.steps import Step
from myograph.inference.low_rank import LowRankMuscle
from myograph.inference.shipped import ARM, models_folder
from myograph.limb.motion.activation_file import read_activations
from myograph.view.page.source import ArmModels, read_arm_models

Model = Annotated[
    str | None,
    typer.Argument(help="Folder of a saved model of neural modes, or of one for each muscle; the shipped arm without."),
]
ModelOrDataset = Annotated[str | None, typer.Argument(help="As of a model, or a dataset (store of an ensemble).")]
Activation = Annotated[
    str | None, typer.Option(help=f"Of {', '.join(MUSCLES)}: five numbers from 0 to 1; or such as biceps=0.5.")
]
Load = Annotated[float, typer.Option("--load", help="Weight in the hand [N].")]
Movement = Annotated[
    Path | None,
    typer.Option(help="Activations over time: CSV, or OpenSim's .sto, as of 'myograph move'; without it a flexion."),
]
Rate = Annotated[float, typer.Option(help="States for each second of the movement.")]
FLEXORS, FLEXION_S, STRONGEST = ("brachioradialis", "brachialis", "biceps"), 4.0, 0.8
"""The built-in movement: these muscles go up to an activation and back within a time [s]."""
MOST_STATES = 10000


def read_models(model: str | None, arm_file: Path | None, muscles: list[str] | None = None) -> ArmModels:
    """The models of some or all muscles; raises InputError where there are none, or not of these muscles."""
    found = read_arm_models(model_folder(model), read_arm(arm_file))
    if not muscles:
        return found
    missing = [name for name in muscles if check_muscle(name) not in found.muscles]
    if missing:
        raise InputError(f"{found.name}: expected muscles of {', '.join(found.muscles)}, got {', '.join(missing)}")
    chosen = {name: muscle for name, muscle in found.muscles.items() if name in muscles}
    return ArmModels(found.name, chosen, found.told, found.arm)


def read_muscle_model(model: str | None, muscle: str | None) -> LowRankMuscle:
    """The model of one muscle: of the only one, or of that name."""
    found = read_models(model, None, [muscle] if muscle else None).muscles
    if len(found) > 1:
        raise InputError(f"expected --muscle, one of {', '.join(found)}, got none")
    return next(iter(found.values()))


def model_folder(model: str | None) -> Path:
    """The folder, or that of a shipped model by its name; raises InputError where there is none."""
    shipped = models_folder() / (model or ARM)
    if model is not None and (Path(model).exists() or not shipped.is_dir()):
        return Path(model)
    if not shipped.is_dir():
        raise InputError("this installation has no arm of its own; expected MODEL, the folder of saved models")
    return shipped


def is_dataset(named: str | None) -> bool:
    """Whether it is the folder of a store."""
    return named is not None and (Path(named) / PLAN).is_file()


def activation_row(text: str | None) -> Float[np.ndarray, " muscles"]:
    """Activations of all five; at rest without a text."""
    return np.zeros(len(MUSCLES)) if text is None else np.array(activation_numbers(text))


def read_keys(movement: Path | None, rate: float, hand_load: float) -> Keys:
    """A movement at equal steps of time; raises InputError for a rate that is none, and as `read_activations` does."""
    if not (np.isfinite(rate) and rate > 0):
        raise InputError(f"--rate: expected a number above 0 a second, got {rate:g}")
    if movement is None:
        times = np.linspace(0, FLEXION_S, round(rate * FLEXION_S) + 1)
        flexors = np.isin(MUSCLES, FLEXORS)
        return Keys(times, np.outer(STRONGEST * np.sin(np.pi * times / FLEXION_S) ** 2, flexors), hand_load)
    given = read_activations(movement, MUSCLES)
    start, end = float(given.times[0]), float(given.times[-1])
    count = int((end - start) * rate + 1e-9) + 1
    if not 2 <= count <= MOST_STATES:
        raise InputError(f"{movement}: expected 2 to {MOST_STATES} states at {rate:g} a second, got {count}")
    times = start + np.arange(count) / rate
    return Keys(times, np.stack([given.at(time) for time in times.tolist()]), hand_load)


def steps_of_keys(muscles: Mapping[str, LowRankMuscle], keys: Keys) -> Iterator[Step]:
    """Fields of all muscles at all times of a movement."""
    first = next(iter(muscles.values()))
    shared = set.intersection(*({*muscle.at(keys.activations[0], keys.hand_load)} for muscle in muscles.values()))
    for time, row in zip(keys.times.tolist(), keys.activations, strict=True):
        found = {name: muscle.at(row, keys.hand_load) for name, muscle in muscles.items()}
        fields = {name: {field: values[field] for field in sorted(shared)} for name, values in found.items()}
        numbers = {"activation": row, "hand_load": np.array([keys.hand_load])}
        angle = first.elbow_angle(row, keys.hand_load)
        yield Step(time, fields, numbers if angle is None else {**numbers, "elbow_angle": np.array([angle])})
