"""The steps of a training that need torch: it is imported here, when they are asked for."""

import csv
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from myograph.cli.train.asked import TRAINING, TrainFile
from myograph.cli.train.progress import shown
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import MissingPackageError

if TYPE_CHECKING:
    from myograph.learning.saving import Training

MODEL = "model"


def asked_learner(asked: TrainFile, cases: MuscleCases, split: Split, out: Path, source: str) -> Learner:
    """The method with its settings, calibrated where there are cases enough; where there are not, that is said.

    Raises InputError for a wrong setting, and where torch is not installed.
    """
    try:
        from myograph.learning.learners import Asked, make_learner
        from myograph.learning.trust.calibrated import CalibratedLearner, enough
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "train", "training") from None
    wanted = Asked(asked.method, asked.options, asked.training, out / TRAINING, asked.calibration, source)
    learner = make_learner(wanted)
    if not isinstance(learner, CalibratedLearner) or enough(cases, split, learner.share, learner.seed):
        return learner
    if in_first_process():
        typer.echo(
            f"myograph: a share of {learner.share:g} holds out too few cases for 90 % intervals: all teach, and the "
            "model has none",
            err=True,
        )
    return learner.learner


def taught_split(learner: Learner, cases: MuscleCases, split: Split) -> Split:
    """The split without the training cases that calibrate, and do not teach."""
    from myograph.learning.trust.calibrated import CalibratedLearner, hold_out

    if not isinstance(learner, CalibratedLearner):
        return split
    return hold_out(cases, split, learner.share, learner.seed)[0]


def fit(
    learner: Learner, sampler: PairSampler, split: Split, out: Path, claim: Callable[[], None]
) -> tuple[Predictor, float]:
    """The trained method and the time that training took [s], over all interrupts.

    `claim` is called, in the first process only, once something was learned: then all settings fit each other.
    """
    if not in_first_process():
        return learner.fit(sampler, split), 0.0
    started = time.perf_counter()
    with shown(learner.name) as told:

        def learned(step: int, steps: int, rmse: float) -> None:
            claim()
            told(step, steps, rmse)

        predictor = learner.fit(sampler, split, learned)
    claim()
    return predictor, max(time.perf_counter() - started, _seconds_in_course(out / TRAINING / "course.csv"))


def in_first_process() -> bool:
    """Whether this is the process that tells and writes."""
    from myograph.learning.training.processes import rank

    return rank() == 0


def save(predictor: Predictor, training: "Training", folder: Path) -> Path | None:
    """The folder of the saved model; None for a method that has none."""
    from myograph.learning.saveable import Saveable
    from myograph.learning.saving import save_model
    from myograph.learning.trust.calibrated import CalibratedPredictor

    if isinstance(predictor, CalibratedPredictor):
        training = replace(
            training,
            half_width_90=predictor.factors,
            half_width_90_from=predictor.factors_from,
            residual_mm=predictor.residual_mm,
        )
        predictor = predictor.predictor
    if not isinstance(predictor, Saveable):
        return None
    save_model(predictor, training, folder)
    return folder


def _seconds_in_course(path: Path) -> float:
    """When the last step ended [s]; 0 where nothing was trained in steps."""
    if not path.is_file():
        return 0.0
    with path.open(encoding="utf-8", newline="") as file:
        seconds = [float(row["seconds"]) for row in csv.DictReader(file)]
    return seconds[-1] if seconds else 0.0
