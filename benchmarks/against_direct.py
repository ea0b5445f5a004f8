"""Every method taught on tables and held against direct finite elements; and what share of the truth intervals hold.

    python benchmarks/against_direct.py STORE --truth STORE [--methods NAME ...] [--seeds 3] [--pairs 256]
                                        [--seconds 90] [--steps 4000] [--halves 20] [--convention NAME] [--json]

Taught by the protocol 'strict' on STORE, with nine random sensors; judged by all three protocols on pairs of the truth,
whose bodies must be those of STORE and whose factorial cases come in the same order. A seed is that of the split, of
the training and of the pairs drawn; figures are means over the seeds, the largest error that of all. `--seconds` ends
the training of a network, so that its errors depend on the machine.
Points are named by S, as in the thesis, for graph element networks, and by X for all others, unless `--convention` says
something else: an affine map and a spline are far more exact from S, which is the muscle already bent.
Neural modes stand in three rows, by what they are told. For their intervals, the cases of the truth off the grid are
halved at random, `--halves` times a seed: one half says how far the angle of the networks is off and how wide
intervals must be, and the share that they hold is counted on the other half.
"""

import argparse
import json
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import torch
from baselines import METHODS, learner_of
from rich.console import Console
from rich.table import Table
from threadpoolctl import threadpool_limits

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import FACTORIAL, OFF_GRID, PROTOCOLS, split_pairs
from myograph.ensemble.pairs.question import CONVENTIONS, Batch, Convention
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.evaluation import evaluate
from myograph.inference.ways import WAYS, WHOLE, told_only
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.fitting import measure_angle
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.modes.module import ModesModule
from myograph.learning.torch_predictor import TorchPredictor
from myograph.learning.training import TrainingConfig
from myograph.learning.trust.calibrated import factors_of
from myograph.learning.trust.scores import Scores, scores

MODES = "neural_modes"
NETWORKS = {"gen_thesis": NetworkConfig.thesis(), "gen_improved": NetworkConfig.improved()}
ASKED = ("position", "von_mises")
FIGURES = ("mean_mm", "p95_mm", "max_mm", "von_mises_mean_mpa", "von_mises_relative")
Figures = dict[str, float | None]


def main(arguments: Sequence[str] | None = None) -> None:
    """Fit, judge, print."""
    asked = _arguments(arguments)
    torch.set_num_threads(1)
    threadpool_limits(1)
    cases, truth = (read_muscle(store, asked.muscle) for store in (asked.store, asked.truth))
    _check(cases, truth)
    found: dict[str, dict[str, list[Figures]]] = {}
    held: dict[str, list[float]] = {}
    for method in asked.methods:
        for seed in range(asked.seeds):
            predictor, judged = _fitted(method, cases, seed, asked), _sampler(method, truth, asked.convention)
            for told in (WHOLE, *WAYS) if method == MODES else (WHOLE,):
                row = {WHOLE: "both", "activation": "activations"}.get(told, told)
                errors = _errors(predictor, judged, told, seed, asked.pairs)
                for protocol, figures in errors.items():
                    rows = found.setdefault(f"{method}, {row}" if method == MODES else method, {})
                    rows.setdefault(protocol, []).append(figures)
            if method == MODES:
                for way, shares in _coverage(predictor, judged, seed, asked.halves).items():
                    held.setdefault(way, []).extend(shares)
    if asked.json:
        print(json.dumps({"methods": found, "coverage": held}))
    else:
        _show(found, held)


def _arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    every = (*METHODS, *NETWORKS, MODES)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--truth", type=Path, required=True)
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--methods", nargs="+", choices=every, default=every)
    for name, default in (("seeds", 3), ("pairs", 256), ("steps", 4000), ("halves", 20)):
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--seconds", type=float, default=90.0)
    parser.add_argument("--convention", choices=CONVENTIONS)
    parser.add_argument("--json", action="store_true")
    return parser.parse_args(arguments)


def _check(cases: MuscleCases, truth: MuscleCases) -> None:
    """Raise InputError unless what is held out of the one is held out of the other."""
    if not np.allclose(cases.body.reference, truth.body.reference, atol=1e-3):
        raise InputError("truth: expected the body of the store that teaches, got another one")
    corners = (part.activation[part.named(FACTORIAL)] for part in (cases, truth))
    if not np.array_equal(*corners):
        raise InputError("truth: expected the factorial cases of the store that teaches, in their order, got others")


def _sampler(method: str, cases: MuscleCases, convention: Convention | None) -> PairSampler:
    """Graph element networks answer positions and name points as the thesis does."""
    sensors = random_sensors(cases.nodes)
    if method in NETWORKS:
        return PairSampler(cases, sensors, convention or "initial")
    return PairSampler(cases, sensors, convention or "material", asked=ASKED)


def _fitted(method: str, cases: MuscleCases, seed: int, asked: argparse.Namespace) -> Predictor:
    split, sampler = split_pairs(cases, "strict", seed), _sampler(method, cases, asked.convention)
    if method in NETWORKS:
        training = TrainingConfig(steps=asked.steps, seconds=asked.seconds, queries=128, seed=seed)
        return GenLearner(NETWORKS[method], training, method).fit(sampler, split)
    if method == MODES:
        settings = ModesConfig(reads="both", stress="von_mises", modes=20, seed=seed)
        return ModesLearner(settings).fit(sampler, split)
    return learner_of(method, seed, asked.seconds).fit(sampler, split)


def _errors(predictor: Predictor, sampler: PairSampler, told: str, seed: int, most: int) -> dict[str, Figures]:
    """Protocol -> figure."""
    found = {}
    for protocol in PROTOCOLS:
        test = split_pairs(sampler.cases, protocol, seed).test
        chosen = test[np.sort(np.random.default_rng(seed).permutation(len(test))[:most])]
        summary = evaluate(predictor, _told(sampler.batches(chosen), told)).summary()
        found[protocol] = {name: getattr(summary, name) for name in FIGURES}
    return found


def _told(batches: Iterator[Batch], way: str) -> Iterator[Batch]:
    return (Batch(told_only(batch.question, way), batch.truth) for batch in batches)


def _coverage(model: Predictor, sampler: PairSampler, seed: int, halves: int) -> dict[str, list[float]]:
    """Way -> share of the truth in the intervals, for each halving, of cases that calibrated nothing."""
    assert isinstance(model, TorchPredictor)
    assert isinstance(model.module, ModesModule)
    cases, generator = sampler.cases, np.random.default_rng((seed, 1))
    off_grid, found = cases.named(OFF_GRID), {way: [] for way in (WHOLE, *WAYS)}
    for _ in range(halves):
        calibrating = generator.permutation(len(off_grid)) < len(off_grid) // 2
        measure_angle(model.module, cases, off_grid[calibrating])
        for way, shares in found.items():
            own = scores(model, sampler, np.stack([off_grid, off_grid], axis=1), way)
            factor = factors_of(_rows(own, calibrating))["position"]
            other = _rows(own, ~calibrating)
            shares.append(float((other.errors["position"] <= factor * other.deviations["position"]).mean()))
    return found


def _rows(found: Scores, some: np.ndarray) -> Scores:
    chosen = ({name: values[some] for name, values in part.items()} for part in (found.errors, found.deviations))
    return Scores(*chosen, found.residuals)


def _show(found: dict[str, dict[str, list[Figures]]], held: dict[str, list[float]]) -> None:
    table = Table("method", "protocol", "mean, mm", "95 %, mm", "largest, mm", "von Mises, MPa", "% of mean")
    for method, protocols in found.items():
        for protocol, seeds in protocols.items():
            table.add_row(method, protocol, *_words(seeds))
    console = Console(width=140)
    console.print(table)
    for way, shares in held.items():
        middle, ends = np.mean(shares), np.percentile(shares, [5, 95])
        console.print(f"intervals, {way}: hold {100 * middle:.1f} % on average over {len(shares)} halvings,", end=" ")
        console.print(f"{100 * ends[0]:.1f} to {100 * ends[1]:.1f} % in nine of ten")


def _words(seeds: list[Figures]) -> Iterator[str]:
    scale: dict[str, Callable[[np.ndarray], str]] = {
        "mean_mm": lambda v: f"{v.mean():.3g} ± {v.std():.1g}",
        "p95_mm": lambda v: f"{v.mean():.3g}",
        "max_mm": lambda v: f"{v.max():.3g}",
        "von_mises_mean_mpa": lambda v: f"{v.mean():.3g}",
        "von_mises_relative": lambda v: f"{100 * v.mean():.3g}",
    }
    for name, words in scale.items():
        values = [figures[name] for figures in seeds]
        known = [value for value in values if value is not None]
        yield words(np.array(known)) if known else "–"


if __name__ == "__main__":
    main()
