"""Every baseline on a store of cases: errors, time of learning, learned numbers.

    python benchmarks/baselines.py STORE [--muscle biceps] [--protocols strict off_grid] [--methods affine ...]
                                   [--seeds 1] [--pairs 256] [--seconds 170] [--convention material] [--json]

Nine sensors (the standard ones), positions and von Mises stress at all other nodes. The test pairs are at most
`--pairs` of the protocol's, drawn at random and alike for all methods. A seed is that of the split and of the training;
with several, figures are means over them. `--seconds` ends the training of a network, so that its errors depend on the
machine; time of learning is wall time.
"""

import argparse
import json
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table
from threadpoolctl import threadpool_limits

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Learner
from myograph.ensemble.pairs.protocols import PROTOCOLS, Protocol, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.evaluation import evaluate
from myograph.learning.baselines import Affine, DoNothing, GappyPod, ThinPlateSpline
from myograph.learning.baselines.deeponet import DEEPONET_TRAINING, DeepONet
from myograph.learning.baselines.feed_forward import FEED_FORWARD_TRAINING, FeedForward
from myograph.learning.baselines.gp_module import PodGpConfig
from myograph.learning.baselines.pod_gp import PodGp

ASKED = ("position", "von_mises")
METHODS = ("do_nothing", "affine", "thin_plate_spline", "gappy_pod", "feed_forward", "pod_gp", "deeponet")
COLUMNS = {
    "mean_mm": "mean, mm",
    "p95_mm": "95 %, mm",
    "max_mm": "max, mm",
    "von_mises_mean_mpa": "von Mises mean, MPa",
    "von_mises_max_mpa": "max, MPa",
    "seconds": "learning, s",
    "parameters": "numbers learned",
}


@dataclass(frozen=True)
class Options:
    """What is asked for; see the module."""

    store: Path
    muscle: str
    protocols: tuple[Protocol, ...]
    methods: tuple[str, ...]
    seeds: int
    pairs: int
    seconds: float
    convention: str


Row = Mapping[str, float | None]


def main() -> None:
    """Measure and print."""
    options, as_json = _options()
    cases = read_muscle(options.store, options.muscle)
    rows: dict[str, dict[str, Row]] = {}
    for method in options.methods:
        for protocol in options.protocols:
            measured = [_measure(cases, method, protocol, seed, options) for seed in range(options.seeds)]
            rows.setdefault(method, {})[protocol] = _mean(measured)
            if not as_json:
                Console().print(method, protocol, {key: _short(value) for key, value in _mean(measured).items()})
    if as_json:
        asked = {key: str(value) if isinstance(value, Path) else value for key, value in asdict(options).items()}
        print(json.dumps({"options": asked, "checksum": cases.checksum, "methods": rows}))
    else:
        _show(rows)


def _options() -> tuple[Options, bool]:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--protocols", nargs="+", choices=PROTOCOLS, default=("strict", "off_grid"))
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--pairs", type=int, default=256)
    parser.add_argument("--seconds", type=float, default=170.0)
    parser.add_argument("--convention", choices=("initial", "material"), default="material")
    parser.add_argument("--json", action="store_true")
    told = vars(parser.parse_args())
    as_json = told.pop("json")
    return Options(**{key: tuple(value) if isinstance(value, list) else value for key, value in told.items()}), as_json


def learner_of(method: str, seed: int, seconds: float) -> Learner:
    """The baseline of that name; `seconds` ends the training of a network."""
    limits = {"seed": seed, "seconds": seconds}
    if method == "feed_forward":
        return FeedForward(training=FEED_FORWARD_TRAINING.model_copy(update=limits))
    if method == "deeponet":
        return DeepONet(training=DEEPONET_TRAINING.model_copy(update=limits))
    if method == "pod_gp":
        return PodGp(PodGpConfig(seed=seed))
    return {own.name: own for own in (DoNothing(), Affine(), ThinPlateSpline(), GappyPod())}[method]


def _measure(cases: MuscleCases, method: str, protocol: Protocol, seed: int, options: Options) -> Row:
    torch.set_num_threads(1)
    threadpool_limits(1)
    sampler = PairSampler(cases, random_sensors(cases.nodes), options.convention, asked=ASKED)
    split = split_pairs(cases, protocol, seed)
    cases.values("position", np.unique(split.train.target))
    started = time.perf_counter()
    predictor = learner_of(method, seed, options.seconds).fit(sampler, split)
    seconds = time.perf_counter() - started
    drawn = np.random.default_rng(seed).permutation(len(split.test))[: options.pairs]
    found = evaluate(predictor, sampler.batches(split.test[np.sort(drawn)])).summary()
    figures = {name: getattr(found, name) for name in COLUMNS if name.endswith(("mm", "mpa"))}
    return {**figures, "seconds": seconds, "parameters": getattr(predictor, "parameters", 0)}


def _mean(measured: list[Row]) -> Row:
    return {
        key: None if measured[0][key] is None else float(np.mean([own[key] for own in measured])) for key in COLUMNS
    }


def _short(value: float | None) -> str:
    if value is None:
        return "–"
    return f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"


def _show(rows: Mapping[str, Mapping[str, Row]]) -> None:
    table = Table("method", "protocol", *COLUMNS.values())
    for method, by_protocol in rows.items():
        for protocol, row in by_protocol.items():
            table.add_row(method, protocol, *(_short(row[key]) for key in COLUMNS))
    Console(width=140).print(table)


if __name__ == "__main__":
    main()
