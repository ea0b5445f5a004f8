"""`myograph predict`: a muscle from activations or from measured sensors, by a saved model."""

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from myograph.case import MUSCLES, check_muscle
from myograph.cli.options import Json, print_json
from myograph.ensemble.design.listing import read_cases
from myograph.ensemble.pairs.question import Answer
from myograph.errors import InputError
from myograph.export.steps import Step
from myograph.export.vtkhdf import write_vtkhdf
from myograph.inference.answer_file import arrays_of, check_kind, write_answer
from myograph.inference.answers import joined
from myograph.inference.loaded import LoadedModel, load
from myograph.inference.sensor_file import read_sensors
from myograph.inference.shipped import find_model

AT_ONCE = 64
"""Cases that are answered together: memory holds these, and what is to be written."""
MOST_STATES = 5 * 10**6
"""Nodes times cases of one file."""


@dataclass(frozen=True)
class _Asked:
    """Activations (cases, muscles) or None, loads (cases,) [N], the file of the sensors or None."""

    activation: np.ndarray | None
    hand_load: np.ndarray
    sensors: Path | None
    sensor_noise: float = 0.0

    @property
    def size(self) -> int:
        """Number of cases."""
        return len(self.hand_load)


def predict(
    model: Annotated[
        str | None,
        typer.Argument(help="Folder of a saved model, or name of a shipped one; the shipped one without it."),
    ] = None,
    activation: Annotated[
        str | None, typer.Option(help=f"Of {', '.join(MUSCLES)}: five numbers from 0 to 1; or such as biceps=0.5.")
    ] = None,
    activations: Annotated[
        Path | None, typer.Option(help="CSV with a column for each muscle, if wanted hand_load_n; a row for each case.")
    ] = None,
    sensors: Annotated[
        Path | None, typer.Option(help="CSV with node (or place_x_mm, place_y_mm, place_z_mm), x_mm, y_mm, z_mm.")
    ] = None,
    sensor_noise: Annotated[
        float, typer.Option(help="Standard deviation of a measured coordinate [mm], for intervals and verdict.")
    ] = 0.0,
    load_n: Annotated[float, typer.Option("--load", help="Weight in the hand [N].")] = 0.0,
    out: Annotated[Path | None, typer.Option(help="Write all nodes to this .csv, .npz or .vtkhdf file.")] = None,
    json: Json = False,
) -> None:
    """Predict the deformed muscle at all nodes, and say whether the model knows such cases."""
    if out is not None:
        _check_out(out, activations, sensors)
    if sensor_noise and sensors is None:
        raise InputError("--sensor-noise: expected --sensors beside it, got none")
    asked = replace(_asked(activation, activations, sensors, load_n), sensor_noise=sensor_noise)
    loaded = load(find_model(model, from_sensors=sensors is not None))
    if out is not None and asked.size * loaded.body.nodes > MOST_STATES:
        most = MOST_STATES // loaded.body.nodes
        raise InputError(f"{out}: expected at most {most} cases in one file, got {asked.size}; ask in several")
    cases, kept, milliseconds, started = [], [], 0.0, time.perf_counter()
    for answer in _answers(loaded, asked):
        milliseconds += 1000 * (time.perf_counter() - started)
        cases += describe_answer(loaded, answer)
        kept += [answer] if out is not None else []
        started = time.perf_counter()
    if out is not None:
        _write(out, loaded, asked, joined(kept))
    if json:
        head = {"model": loaded.name, "muscle": loaded.told.muscle, "nodes": loaded.body.nodes}
        place = None if out is None else str(out)
        print_json({**head, "milliseconds": milliseconds, "cases": cases, "out": place})
        return
    typer.echo(f"{loaded.name}: {loaded.told.muscle}, {loaded.body.nodes} nodes, {milliseconds:.3g} ms")
    for number, row in enumerate(cases):
        typer.echo(f"  case {number}: {_sentence(row)}")
    if out is not None:
        typer.echo(f"  {out}")


def _check_out(out: Path, *read: Path | None) -> None:
    check_kind(out)
    if any(path is not None and path.resolve() == out.resolve() for path in read):
        raise InputError(f"{out}: expected another file than the one that is read")


def describe_answer(model: LoadedModel, answer: Answer) -> list[dict[str, Any]]:
    """A row for each case; displacements are from the body at rest, None stands for what the model does not say."""
    size = len(next(iter(answer.values.values())))
    moved = _none(size)
    if "position" in answer.values:
        moved = np.linalg.norm(answer.values["position"] - model.body.rest["position"], axis=-1)
    stress = answer.values.get("von_mises", _none(size))
    width = answer.half_width_90.get("position", _none(size))
    inside = _none(size)[:, 0] if answer.inside is None else answer.inside
    return [
        {
            "displacement_mean_mm": _number(moved[case].mean()),
            "displacement_max_mm": _number(moved[case].max()),
            "von_mises_mean_mpa": _number(stress[case].mean()),
            "von_mises_max_mpa": _number(stress[case].max()),
            "half_width_90_mm": _number(width[case].mean()),
            "inside": None if answer.inside is None else bool(inside[case]),
        }
        for case in range(size)
    ]


def _none(size: int) -> np.ndarray:
    return np.full((size, 1), np.nan)


def _number(value: Any) -> float | None:
    return float(value) if np.isfinite(value) else None


def _sentence(row: dict[str, Any]) -> str:
    words = []
    if row["displacement_mean_mm"] is not None:
        words.append(f"moved {row['displacement_mean_mm']:.2f} mm from rest, {row['displacement_max_mm']:.2f} at most")
    if row["half_width_90_mm"] is not None:
        words.append(f"90 % within {row['half_width_90_mm']:.2f} mm")
    if row["von_mises_mean_mpa"] is not None:
        words.append(f"von Mises {row['von_mises_mean_mpa']:.3f} MPa, {row['von_mises_max_mpa']:.3f} at most")
    if row["inside"] is not None:
        words.append(
            "inside what it was trained on" if row["inside"] else "OUTSIDE what it was trained on: do not rely"
        )
    return "; ".join(words)


def _asked(activation: str | None, activations: Path | None, sensors: Path | None, load_n: float) -> _Asked:
    if (activation is None) == (activations is None) and (sensors is None or activation is not None):
        raise InputError("expected one of --activation and --activations, or --sensors; see 'myograph predict --help'")
    if activations is None:
        row = None if activation is None else np.array([activation_numbers(activation)])
        return _Asked(row, np.array([load_n]), sensors)
    cases, _ = read_cases(activations, "asked", repeats=True)
    if any(case.elbow_angle is not None for case in cases):
        raise InputError(f"{activations}: expected no elbow_angle_deg: the model answers the arm in its equilibrium")
    loads = np.array([case.hand_load for case in cases])
    if load_n and loads.any():
        raise InputError(f"{activations}: expected hand_load_n there or --load, got both")
    return _Asked(np.array([case.activations for case in cases]), loads + load_n, sensors)


def activation_numbers(text: str) -> list[float]:
    """Of all five muscles, from five numbers or from names; raises InputError for anything else."""
    parts = text.split(",")
    try:
        if "=" not in text:
            numbers = [float(part) for part in parts]
        else:
            pairs = [part.partition("=") for part in parts]
            named = {check_muscle(name.strip()): float(value) for name, _, value in pairs}
            if len(named) < len(pairs):
                raise InputError(f"--activation: expected every muscle once, got '{text}'")
            numbers = [named.get(name, 0.0) for name in MUSCLES]
    except ValueError:
        raise InputError(f"--activation: expected numbers such as 0,0,0.5,0,0 or biceps=0.5, got '{text}'") from None
    if len(numbers) != len(MUSCLES):
        raise InputError(f"--activation: expected {len(MUSCLES)} numbers ({', '.join(MUSCLES)}), got {len(numbers)}")
    return numbers


def _answers(model: LoadedModel, asked: _Asked) -> Iterator[Answer]:
    """Of some cases after the others."""
    if asked.sensors is not None:
        nodes, now = read_sensors(asked.sensors)
        yield model.predict_sensors(nodes, now, None, asked.activation, asked.hand_load, asked.sensor_noise)
        return
    assert asked.activation is not None
    for first in range(0, asked.size, AT_ONCE):
        some = slice(first, first + AT_ONCE)
        yield model.predict_activation(asked.activation[some], asked.hand_load[some])


def _write(out: Path, model: LoadedModel, asked: _Asked, answer: Answer) -> None:
    if out.suffix != ".vtkhdf":
        write_answer(out, answer, model.body)
        return
    muscle = model.told.muscle
    verdict = {} if answer.inside is None else {"inside": answer.inside.astype(float)}
    told, arrays, steps = {"hand_load": asked.hand_load, **verdict}, arrays_of(answer), []
    for case in range(len(asked.hand_load)):
        fields = {name: values[case] for name, values in arrays.items()}
        steps.append(Step(float(case), {muscle: fields}, {name: told[name][[case]] for name in told}))
    write_vtkhdf(out, {muscle: model.body.body}, steps)
