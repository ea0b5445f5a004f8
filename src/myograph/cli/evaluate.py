"""`myograph evaluate`: a saved model held against cases it has not learned from."""

from pathlib import Path
from typing import Annotated, Any

import typer

from myograph.cli.options import Json, print_json
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.evaluation.saved import PAIRS, SavedEvaluation, evaluate_saved
from myograph.inference.loaded import LoadedModel, load
from myograph.inference.shipped import find_model, shipped_models, shipped_truth
from myograph.inference.truth import read_truth


def evaluate(
    model: Annotated[str | None, typer.Argument(help="Folder of a saved model, or name of a shipped one.")] = None,
    dataset: Annotated[
        Path | None, typer.Argument(help="Store of an ensemble, or .npz of some cases; the shipped ones without it.")
    ] = None,
    pairs: Annotated[int, typer.Option(help="At most so many pairs of each protocol, drawn at random.", min=1)] = PAIRS,
    json: Json = False,
) -> None:
    """Say how far a saved model is off: without MODEL, of every shipped one on the shipped cases."""
    if model is None:
        rows = {name: _judge(load(folder), None, pairs) for name, folder in shipped_models().items()}
        if not rows:
            raise InputError("this installation has no models of its own; expected MODEL and DATASET")
        if json:
            print_json({"models": rows})
            return
        for name, row in rows.items():
            _say(name, row)
        return
    loaded = load(find_model(model))
    row = _judge(loaded, dataset, pairs)
    if json:
        print_json(row)
        return
    _say(loaded.name, row)


def describe_evaluation(model: LoadedModel, found: SavedEvaluation) -> dict[str, Any]:
    """What `--json` prints of a model."""
    return {
        "protocols": {protocol: errors.figures() for protocol, errors in found.protocols.items()},
        "pairs": found.pairs,
        "left_out": found.left_out,
        "latency_ms": found.latency_ms,
        "parameters": model.told.parameters,
        "muscle": model.told.muscle,
    }


def _judge(model: LoadedModel, dataset: Path | None, pairs: int) -> dict[str, Any]:
    return describe_evaluation(model, evaluate_saved(model, _cases(dataset, model.told.muscle), pairs))


def _cases(dataset: Path | None, muscle: str) -> MuscleCases:
    if dataset is None:
        return shipped_truth(muscle)
    return read_truth(dataset) if dataset.suffix == ".npz" else read_muscle(dataset, muscle)


def _say(name: str, row: dict[str, Any]) -> None:
    typer.echo(f"{name}: {row['muscle']}, {row['parameters']} parameters, {row['latency_ms']:.3g} ms for all nodes")
    for protocol, figures in row["protocols"].items():
        typer.echo(f"  {protocol} ({row['pairs'][protocol]} pairs)")
        for figure, value in figures.items():
            if value is not None:
                typer.echo(f"    {figure:20s} {value:.4g}")
    for protocol, reason in row["left_out"].items():
        typer.echo(f"  {protocol}: left out: {reason}")
