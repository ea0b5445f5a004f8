"""`myograph evaluate`: a saved model held against cases it has not learned from."""

from pathlib import Path
from typing import Annotated, Any

import typer

from myograph.cli.options import Json, print_json
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.evaluation.saved import PAIRS, SavedEvaluation, evaluate_saved
from myograph.evaluation.summary import ErrorSummary
from myograph.inference.loaded import LoadedModel, load
from myograph.inference.shipped import find_model, shipped_models, shipped_truth
from myograph.inference.truth import read_truth

PAIRS_EACH = 128
"""Pairs of each protocol where all shipped models are evaluated: half a minute must do for all."""


def evaluate(
    model: Annotated[str | None, typer.Argument(help="Folder of a saved model, or name of a shipped one.")] = None,
    dataset: Annotated[
        Path | None, typer.Argument(help="Store of an ensemble, or .npz of some cases; the shipped ones without it.")
    ] = None,
    pairs: Annotated[
        int | None,
        typer.Option(
            help="At most so many pairs of each protocol, drawn at random. "
            f"[default: {PAIRS}; without MODEL {PAIRS_EACH}]",
            min=1,
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Say how far a saved model is off: without MODEL, of every shipped one on the shipped cases."""
    if model is None:
        rows, left_out = _judge_shipped(pairs or PAIRS_EACH)
        if json:
            print_json({"models": rows, "left_out": left_out})
            return
        for name, row in rows.items():
            _say(name, row)
        for name, reason in left_out.items():
            typer.echo(f"{name}: left out: {reason}")
        return
    loaded = load(find_model(model))
    row = _judge(loaded, dataset, pairs or PAIRS)
    if json:
        print_json(row)
        return
    _say(loaded.name, row)


def describe_evaluation(model: LoadedModel, found: SavedEvaluation) -> dict[str, Any]:
    """What `--json` prints of a model."""
    return {
        "protocols": _figures(found.protocols),
        "from": {way: _figures(protocols) for way, protocols in found.ways.items()},
        "pairs": found.pairs,
        "left_out": found.left_out,
        "truth": found.truth,
        "latency_ms": found.latency_ms,
        "parameters": model.told.parameters,
        "muscle": model.told.muscle,
    }


def _figures(protocols: dict[str, ErrorSummary]) -> dict[str, dict[str, float | None]]:
    return {protocol: errors.figures() for protocol, errors in protocols.items()}


def _judge_shipped(pairs: int) -> tuple[dict[str, Any], dict[str, str]]:
    """A row for each shipped model of whose body there are shipped cases, and why others have none."""
    rows, left_out = {}, {}
    for name, folder in shipped_models().items():
        model = load(folder)
        try:
            cases = shipped_truth(model.told.muscle, model.body.nodes)
        except InputError as problem:
            left_out[name] = str(problem)
            continue
        rows[name] = describe_evaluation(model, evaluate_saved(model, cases, pairs))
    if not rows:
        raise InputError(
            "this installation has no models of its own with cases to evaluate on; expected MODEL and DATASET"
        )
    return rows, left_out


def _judge(model: LoadedModel, dataset: Path | None, pairs: int) -> dict[str, Any]:
    return describe_evaluation(model, evaluate_saved(model, _cases(dataset, model), pairs))


def _cases(dataset: Path | None, model: LoadedModel) -> MuscleCases:
    if dataset is None:
        return shipped_truth(model.told.muscle, model.body.nodes)
    return read_truth(dataset) if dataset.suffix == ".npz" else read_muscle(dataset, model.told.muscle)


def _say(name: str, row: dict[str, Any]) -> None:
    truth = f", against cases of '{row['truth']}'" if row["truth"] else ""
    typer.echo(
        f"{name}: {row['muscle']}, {row['parameters']} parameters, {row['latency_ms']:.3g} ms for all nodes{truth}"
    )
    for way, protocols in {"": row["protocols"], **row["from"]}.items():
        for protocol, figures in protocols.items():
            alone = f", from {'activations' if way == 'activation' else way} alone" if way else ""
            typer.echo(f"  {protocol} ({row['pairs'][protocol]} pairs{alone})")
            for figure, value in figures.items():
                if value is not None:
                    typer.echo(f"    {figure:20s} {value:.4g}")
    for protocol, reason in row["left_out"].items():
        typer.echo(f"  {protocol}: left out: {reason}")
