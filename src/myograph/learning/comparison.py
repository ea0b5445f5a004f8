"""All methods side by side on the same cases: how large, how long to train, how long to answer, how exact.

`gen_thesis_pyg` is the thesis's network with PyTorch Geometric's convolution in the place of our own: the reference
for speed; it is left out where that package is missing. Times are of this machine: compare them within one run.
"""

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError, MissingPackageError
from myograph.learning.learners import LEARNERS, Asked, make_learner
from myograph.timing import call_times

ROWS: dict[str, tuple[str, Mapping[str, object]]] = {
    **{name: (name, {}) for name in LEARNERS},
    "gen_thesis_pyg": ("gen_thesis", {"processor": "GCNConv"}),
}
"""Row -> method and its options."""
STEPPED = frozenset({"gen", "gen_thesis", "gen_improved", "feed_forward", "deeponet"})
"""Methods that are trained in steps."""
TIMED, TESTED, PAIRS_AT_ONCE = 20, 128, 16
"""Calls that are timed; test pairs, at most; pairs that are answered together."""


@dataclass(frozen=True)
class Row:
    """A method.

    Parameters
    ----------
    parameters
        Number of trained numbers.
    stored
        Number of all numbers that the method keeps.
    train_s
        Time to learn [s].
    predict_ms
        Time to answer one pair at all queries, the median of some calls [ms].
    mean_mm
        Mean error over test pairs [mm].
    """

    parameters: int
    stored: int
    train_s: float
    predict_ms: float
    mean_mm: float


@dataclass(frozen=True)
class Comparison:
    """Rows by name, and why a method has none."""

    rows: dict[str, Row]
    left_out: dict[str, str]


def compare(
    cases: MuscleCases, steps: int, names: Iterable[str] = ROWS, tell: Callable[[str], object] = lambda name: None
) -> Comparison:
    """Train every method by `strict` and time it; raises InputError for a name that is none.

    Parameters
    ----------
    steps
        Of the methods that are trained in steps.
    tell
        Called with a name when its turn comes.
    """
    sampler, split = PairSampler(cases, random_sensors(cases.nodes)), split_pairs(cases, "strict")
    rows, left_out = {}, {}
    for name in names:
        if name not in ROWS:
            raise InputError(f"unknown method '{name}': expected one of {', '.join(ROWS)}")
        tell(name)
        try:
            rows[name] = _row(name, sampler, split, steps)
        except MissingPackageError as missing:
            left_out[name] = str(missing)
    return Comparison(rows, left_out)


def _row(name: str, sampler: PairSampler, split: Split, steps: int) -> Row:
    method, options = ROWS[name]
    training = {"steps": steps} if method in STEPPED else {}
    learner = make_learner(Asked(method, options, training))
    started = time.perf_counter()
    predictor = learner.fit(sampler, split)
    train_s = time.perf_counter() - started
    parameters, stored = (int(getattr(predictor, name, 0)) for name in ("parameters", "stored"))
    return Row(
        parameters, stored, train_s, _milliseconds(predictor, sampler, split), _mean_error(predictor, sampler, split)
    )


def _milliseconds(predictor: Predictor, sampler: PairSampler, split: Split) -> float:
    question = sampler.batch(split.test[:1]).question
    return float(np.median(call_times(lambda: predictor.predict(question), TIMED)))


def _mean_error(predictor: Predictor, sampler: PairSampler, split: Split) -> float:
    errors = []
    pairs = np.random.default_rng(0).permutation(split.test)[:TESTED]
    for batch in sampler.batches(pairs, PAIRS_AT_ONCE):
        answered = predictor.predict(batch.question).values["position"]
        errors.append(np.linalg.norm(answered - batch.truth["position"], axis=-1))
    return float(np.concatenate(errors).mean())
