"""Neural modes on any store: what answers are made from, how sensors are used; every protocol.

    python benchmarks/modes.py STORE [--muscle biceps] [--seeds 3] [--steps 100] [--most 2000]
                                [--coordinate mode] [--json]

A seed says which factorial cases are held out, and the networks' first weights. Errors of positions are distances of
nodes [mm], those of von Mises stress mean absolute errors over the mean stress [%]. Intervals are calibrated on 15 % of
the training cases, which then do not teach; NaN where these are too few. 'volume' is the largest difference of det F of
predicted positions from that of the truth. All columns are means over the seeds; times are of the processor.
"""

import argparse
import json
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner, reading
from myograph.learning.modes.volume import volume_ratios
from myograph.learning.trust.calibrated import CalibratedLearner, calibrate, hold_out
from myograph.learning.trust.coverage import Coverage, coverage
from myograph.learning.trust.scores import distance

OPTIONS: dict[str, dict[str, object]] = {
    "activations": {"reads": "activation"},
    "sensors, surface": {"reads": "sensors"},
    "sensors, ridge": {"reads": "sensors", "sensing": "ridge"},
    "sensors, surface and ridge": {"reads": "sensors", "sensing": "surface_and_ridge"},
    "both": {"reads": "both"},
}
LEAST_CALIBRATION = 20
"""Held-out cases from which on intervals are calibrated; below, all training cases teach."""
PROTOCOLS = ("thesis", "strict", "off_grid")
COLUMNS = ("mean_mm", "max_mm", "von_mises_percent", "coverage_90", "half_width_mm", "volume", "fit_seconds")


def main(arguments: Sequence[str] | None = None) -> None:
    """Fit, measure, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--steps", type=int, default=100, help="of each network's fit")
    parser.add_argument("--most", type=int, default=2000, help="test pairs at most, drawn at random")
    parser.add_argument("--protocols", nargs="+", default=PROTOCOLS)
    parser.add_argument("--coordinate", choices=("angle", "mode"), default="angle")
    parser.add_argument("--json", action="store_true")
    asked = parser.parse_args(arguments)
    torch.set_num_threads(1)
    cases = read_muscle(asked.store, asked.muscle)
    fields = ("position", "cauchy_stress", "von_mises")
    sampler = PairSampler(cases, random_sensors(cases.nodes), asked=fields)
    rows = []
    for protocol in asked.protocols:
        found = [_measured(sampler, split_pairs(cases, protocol, seed), asked, seed) for seed in range(asked.seeds)]
        rows += [
            {"protocol": protocol, "option": option}
            | {column: float(np.mean([seed[option][column] for seed in found])) for column in COLUMNS}
            for option in OPTIONS
        ]
    print(json.dumps({"muscle": asked.muscle, "seeds": asked.seeds, "rows": rows})) if asked.json else _show(rows)


def _measured(sampler: PairSampler, split: Split, asked: argparse.Namespace, seed: int) -> dict[str, dict[str, float]]:
    """Option -> column -> value; all options share one fit."""
    started = time.process_time()
    rest, held_out = hold_out(sampler.cases, split, CalibratedLearner.share, seed)
    rest = split if len(held_out) < LEAST_CALIBRATION else rest
    config = ModesConfig(reads="both", coordinate=asked.coordinate, steps=asked.steps, seed=seed)
    fitted = ModesLearner(config).fit(sampler, rest)
    seconds = time.process_time() - started
    chosen = np.random.default_rng(seed).permutation(len(split.test))[: asked.most]
    results = {}
    for option, settings in OPTIONS.items():
        model = reading(fitted, sampler, config.model_copy(update=settings))
        told = Coverage(np.nan, np.nan)
        if rest is not split:
            calibrated = calibrate(model, sampler, rest, held_out, seed)
            told = coverage(calibrated, sampler, split.test[chosen])["position"]
        results[option] = _errors(model, sampler, split.test[chosen]) | {
            "coverage_90": told.share,
            "half_width_mm": told.half_width,
            "volume": _volume(model, sampler, split.test[chosen[:16]]),
            "fit_seconds": seconds,
        }
    return results


def _errors(model: Predictor, sampler: PairSampler, pairs: np.ndarray) -> dict[str, float]:
    positions, stresses, true = [], [], []
    for batch in sampler.batches(pairs):
        answer = model.predict(batch.question)
        positions.append(distance(answer.values["position"], batch.truth["position"], "position"))
        stresses.append(distance(answer.values["von_mises"], batch.truth["von_mises"], "von_mises"))
        true.append(batch.truth["von_mises"])
    missed = np.concatenate(positions)
    return {
        "mean_mm": float(missed.mean()),
        "max_mm": float(missed.max()),
        "von_mises_percent": float(100 * np.concatenate(stresses).mean() / np.concatenate(true).mean()),
    }


def _volume(model: Predictor, sampler: PairSampler, pairs: np.ndarray) -> float:
    """Largest difference of the least and largest det F from those of the truth."""
    batch = sampler.batch(pairs, np.arange(sampler.cases.nodes))
    body = sampler.cases.body
    found = volume_ratios(body, model.predict(batch.question).values["position"])
    true = volume_ratios(body, batch.truth["position"])
    return max(abs(found.least - true.least), abs(found.largest - true.largest))


def _show(rows: list[dict[str, object]]) -> None:
    table = Table(title="neural modes")
    for column in ("protocol", "option", *COLUMNS):
        table.add_column(column)
    for row in rows:
        table.add_row(str(row["protocol"]), str(row["option"]), *(f"{row[column]:.4g}" for column in COLUMNS))
    Console(width=140).print(table)


if __name__ == "__main__":
    main()
