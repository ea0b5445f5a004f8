"""`myograph train`: a method learns from a store, is held against what it has not seen, and is saved.

OUT/train.json   what is trained there
OUT/training/    checkpoint and course, where the method is trained in steps; running again goes on
OUT/model/       the saved model, where the method can be saved
"""

import shlex
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.options import Json, print_json
from myograph.cli.train.asked import TrainFile, check_folder, claim_folder, make_sampler, read_train_file
from myograph.cli.train.fitting import MODEL, asked_learner, fit, in_first_process, save, taught_split
from myograph.cli.train.judging import judge, table
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.evaluation import ErrorSummary

DEVICES = ("auto", "cpu", "cuda")


@dataclass(frozen=True)
class Trained:
    """What came of it."""

    predictor: Predictor
    errors: dict[str, ErrorSummary]
    seconds: float
    model: Path | None


def train(
    config: Annotated[Path, typer.Argument(help="TOML file: store, method, its options and training.")],
    data: Annotated[Path | None, typer.Option(help="Folder of the ensemble's store; over the file's.")] = None,
    out: Annotated[Path | None, typer.Option(help="Folder for the model; without it, named after the file.")] = None,
    device: Annotated[str | None, typer.Option(help="auto, cpu or cuda; over the file's.")] = None,
    json: Json = False,
) -> None:
    """Train a method on a store and save it; run it again to go on after an interrupt."""
    if device is not None and device not in DEVICES:
        raise InputError(f"--device: expected one of {', '.join(DEVICES)}, got '{device}'")
    asked, store = read_train_file(config, data, device)
    done = run_training(asked, store, out or Path(config.stem), str(config))
    if done is None:
        return
    parameters = getattr(done.predictor, "parameters", 0)
    if json:
        print_json(
            {
                "model": None if done.model is None else str(done.model),
                "method": done.predictor.name,
                "parameters": parameters,
                "train_s": done.seconds,
                "protocols": {protocol: row.figures() for protocol, row in done.errors.items()},
            }
        )
        return
    typer.echo(f"{done.predictor.name}: {parameters} parameters, trained by '{asked.protocol}' in {done.seconds:.1f} s")
    typer.echo(table(done.errors))
    typer.echo(f"saved as {done.model}" if done.model else "not saved: this method has no model of its own")


def run_training(asked: TrainFile, store: Path, out: Path, source: str) -> Trained | None:
    """Train, judge and save; None in all processes but the first."""
    cases = read_muscle(store, asked.muscle)
    split = split_pairs(cases, asked.protocol, asked.split_seed)
    learner = asked_learner(asked, cases, split, out, source)
    sampler = make_sampler(asked, cases)
    check_folder(out, asked, cases)
    predictor, seconds = fit(learner, sampler, split, out, lambda: claim_folder(out, asked, cases))
    if not in_first_process():
        return None
    errors = judge(predictor, sampler, split, asked.split_seed, asked.pairs)
    from myograph.learning.saving import Training

    training = Training(
        cases=cases,
        split=taught_split(learner, cases, split),
        split_seed=asked.split_seed,
        seed=int(asked.training.get("seed", asked.options.get("seed", 0))),
        command=shlex.join(["myograph", *sys.argv[1:]]),
        seconds=seconds,
        metrics={protocol: row.known_figures() for protocol, row in errors.items()},
    )
    return Trained(predictor, errors, seconds, save(predictor, training, out / MODEL))
