"""One trial in a process of its own: teach, test, keep what came of it.

`seconds` of learning are those of the processor, so that a busy machine does not count; a training that was interrupted
and gone on with has none, for nobody counted those before.

Arrays that are kept:

    node_mm_<protocol>, node_mpa_<protocol>   mean error of each node, NaN at sensors
    far_mm_<protocol>, far_mpa_<protocol>     distance of a test pair's target activations from the nearest that taught
                                              [-], and the mean error of the pair
    curve                                     steps, root mean square error of the batches
    nodes_before, nodes_after                 of a graph [mm]
"""

import shutil
import time
from collections.abc import Mapping
from dataclasses import asdict, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Float

from myograph.cli.reproduce.cache import Cache, Found
from myograph.cli.reproduce.growing import grown
from myograph.cli.reproduce.trial import MUSCLE, Chosen, Trial
from myograph.cli.reproduce.weighing import weighed
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Protocol, Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.views import chosen, joined
from myograph.errors import MissingPackageError
from myograph.evaluation import NodeErrors, evaluate
from myograph.processes import News
from myograph.timing import call_times

if TYPE_CHECKING:
    from myograph.learning.training import History

POINTS = 200
"""Of a training curve that is kept."""
TIMED = 20


def try_and_keep(trial: Trial, key: str, stores: Mapping[str, Path], folder: Path, tell: News) -> str | None:
    """Make the trial and put what came of it into the cache; why it could not be made, where a package is missing."""
    training = folder / "running" / key
    try:
        found = run_trial(trial, stores, training)
    except MissingPackageError as missing:
        tell(key)
        return str(missing)
    Cache(folder).put(key, found)
    shutil.rmtree(training, ignore_errors=True)
    tell(key)
    return None


def run_trial(trial: Trial, stores: Mapping[str, Path], folder: Path | None = None) -> Found:
    """Teach and test; a training that has a folder goes on where it was."""
    from myograph.learning.gen.learner import GenLearner
    from myograph.learning.learners import Asked, make_learner
    from myograph.learning.training.checkpoint import FILE

    cases = grown(cases_of(trial.cases, stores), trial.drawn, trial.seed)
    sampler = PairSampler(
        cases, random_sensors(cases.nodes, trial.sensors, trial.seed), trial.convention, trial.known, trial.asked
    )
    split = split_of(trial, cases, trial.teaching)
    learner = make_learner(Asked(trial.method, trial.options, trial.training, folder if trial.training else None))
    begun = folder is not None and (folder / FILE).exists()
    started = time.process_time()
    arrays: dict[str, np.ndarray] = {}
    if isinstance(learner, GenLearner):
        trained = learner.train(sampler, split)
        predictor: Predictor = trained.predictor
        arrays = {"nodes_before": trained.nodes_before, "nodes_after": trained.module.nodes_mm}
        arrays["curve"] = _curve(trained.history)
    else:
        predictor = learner.fit(sampler, split)
    told: dict[str, Any] = {"taught": len(split.train.cases), "protocols": {}}
    if not begun:
        told["seconds"] = time.process_time() - started
    told["stored"] = _stored(predictor)
    told["predict_ms"] = _milliseconds(predictor, sampler, split)
    for protocol in trial.tested:
        figures, more = _tested(trial, predictor, sampler, split, protocol)
        told["protocols"][protocol] = figures
        arrays |= more
    if trial.weighed:
        told |= weighed(predictor, sampler, split)
    return Found(told, arrays)


@lru_cache(maxsize=4)
def _store(path: Path) -> MuscleCases:
    return read_muscle(path, MUSCLE)


def cases_of(asked: Chosen, stores: Mapping[str, Path]) -> MuscleCases:
    """The chosen cases; those that test follow those that teach, where these are of two stores."""
    words = {"factorial": asked.factorial, "support": asked.support, "off_grid": asked.off_grid}
    taught = chosen(_store(stores[asked.store]), words)
    if asked.truth is None:
        return taught
    return joined(taught, chosen(_store(stores[asked.truth]), words))


def split_of(trial: Trial, cases: MuscleCases, protocol: Protocol) -> Split:
    """Pairs of a protocol; where another store holds the truth, its cases test and the first store's teach."""
    if trial.cases.truth is None:
        return split_pairs(cases, protocol, trial.seed)
    half = len(cases) // 2
    split = split_pairs(replace(cases, design=cases.design[:half]), protocol, trial.seed)
    return replace(split, test=split.test + half)


def _tested(
    trial: Trial, predictor: Predictor, sampler: PairSampler, taught: Split, protocol: Protocol
) -> tuple[dict[str, float], dict[str, np.ndarray]]:
    """Figures of a protocol, and errors by node and by distance."""
    test = split_of(trial, sampler.cases, protocol).test
    pairs = test[np.sort(np.random.default_rng(trial.seed).permutation(len(test))[: trial.pairs])]
    found = evaluate(predictor, sampler.batches(pairs))
    figures = {name: value for name, value in asdict(found.summary()).items() if value is not None}
    arrays: dict[str, np.ndarray] = {}
    skin = np.isin(sampler.queries, sampler.cases.body.skin)
    far = _distances(sampler.cases, taught, pairs)
    for unit, errors in (("mm", found.position), ("mpa", found.von_mises)):
        if errors is None:
            continue
        arrays[f"node_{unit}_{protocol}"] = _everywhere(errors, sampler)
        if skin.any():
            figures[f"skin_mean_{unit}"] = float(errors.errors[:, skin].mean())
            figures[f"skin_max_{unit}"] = float(errors.errors[:, skin].max())
        arrays[f"far_{unit}_{protocol}"] = np.stack([far, errors.errors.mean(axis=1)])
    return figures, arrays


def _everywhere(errors: NodeErrors, sampler: PairSampler) -> Float[np.ndarray, " nodes"]:
    nodes = np.full(sampler.cases.nodes, np.nan)
    nodes[sampler.queries] = errors.node_mean
    return nodes


def _distances(cases: MuscleCases, taught: Split, pairs: np.ndarray) -> Float[np.ndarray, " pairs"]:
    """Of each target's activations from the nearest target that taught [-]."""
    known, asked = cases.activation[np.unique(taught.train.target)], cases.activation[pairs[:, 1]]
    return np.array([np.linalg.norm(known - own, axis=1).min() for own in asked])


def _curve(history: "History") -> Float[np.ndarray, "2 points"]:
    blocks = np.array_split(np.arange(len(history.rmse)), min(POINTS, len(history.rmse)))
    return np.array([[block.mean() + 1 for block in blocks], [history.rmse[block].mean() for block in blocks]])


def _stored(predictor: Predictor) -> int:
    """Numbers that the fitted method keeps: learned ones, modes, scales."""
    from myograph.learning.torch_predictor import TorchPredictor

    if isinstance(predictor, TorchPredictor):
        return sum(values.numel() for values in predictor.module.state_dict().values())
    return int(getattr(predictor, "parameters", 0))


def _milliseconds(predictor: Predictor, sampler: PairSampler, split: Split) -> float:
    """Of one pair at all queries, the fastest of some answers: another trial runs beside this one."""
    question = sampler.batch(split.test[:1]).question
    return float(call_times(lambda: predictor.predict(question), TIMED).min())
