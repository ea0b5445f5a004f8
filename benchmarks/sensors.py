"""Sensors of neural modes on any store: where they are, how noisy they are, how many are lost.

    python benchmarks/sensors.py STORE [--muscle biceps] [--seeds 3] [--sensors 9] [--most 400] [--json]

Positions alone, from sensors alone, under the protocol off_grid. 'qr' places sensors by pivoted QR of the modes,
'random' draws them by the seed. Noise is normal in every coordinate [mm], and the method is told how large it is.
Figures: mean and largest distance of nodes [mm], mean over the seeds.
"""

import argparse
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.question import Question
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner, reading
from myograph.learning.trust.placing import qr_sensors
from myograph.learning.trust.scores import distance

NOISES, LOSSES = (0.0, 0.1, 0.5, 1.0), (0, 1, 2, 3, 4, 5)
LEAST_NOISE = 0.01
"""What the method is told of sensors without noise [mm]."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Fit once a seed and place, disturb, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--sensors", type=int, default=9)
    parser.add_argument("--most", type=int, default=400, help="test pairs at most, drawn at random")
    parser.add_argument("--json", action="store_true")
    asked = parser.parse_args(arguments)
    torch.set_num_threads(1)
    cases = read_muscle(asked.store, asked.muscle)
    found: dict[tuple[str, float, int], list[tuple[float, float]]] = {}
    for seed in range(asked.seeds):
        split = split_pairs(cases, "off_grid", seed)
        pairs = split.test[np.random.default_rng(seed).permutation(len(split.test))[: asked.most]]
        places = {
            "random": random_sensors(cases.nodes, asked.sensors, seed),
            "qr": qr_sensors(cases, split.train.cases, asked.sensors),
        }
        fitted = ModesLearner(ModesConfig(reads="sensors")).fit(PairSampler(cases, places["random"]), split)
        for place, nodes in places.items():
            sampler = PairSampler(cases, nodes)
            for noise, lost in [(noise, 0) for noise in NOISES] + [(NOISES[1], lost) for lost in LOSSES[1:]]:
                config = ModesConfig(reads="sensors", sensor_noise=max(noise, LEAST_NOISE))
                model = reading(fitted, sampler, config)
                errors = _errors(model, sampler, pairs, noise, lost, np.random.default_rng((seed, lost)))
                found.setdefault((place, noise, lost), []).append(errors)
    rows = [
        {"place": place, "noise_mm": noise, "lost": lost, "mean_mm": mean, "max_mm": largest}
        for (place, noise, lost), each in found.items()
        for mean, largest in [np.mean(each, axis=0).tolist()]
    ]
    print(json.dumps({"muscle": asked.muscle, "seeds": asked.seeds, "rows": rows})) if asked.json else _show(rows)


def _errors(
    model: Predictor, sampler: PairSampler, pairs: np.ndarray, noise: float, lost: int, generator: np.random.Generator
) -> tuple[float, float]:
    errors = []
    for batch in sampler.batches(pairs):
        question = _disturbed(batch.question, noise, lost, generator)
        errors.append(distance(model.predict(question).values["position"], batch.truth["position"], "position"))
    missed = np.concatenate(errors)
    return float(missed.mean()), float(missed.max())


def _disturbed(question: Question, noise: float, lost: int, generator: np.random.Generator) -> Question:
    """Other sensors are lost in every batch."""
    kept = np.sort(generator.permutation(len(question.sensor_nodes))[lost:])
    target = question.sensor_target["position"][:, kept]
    return replace(
        question,
        sensor_nodes=question.sensor_nodes[kept],
        sensor_places=question.sensor_places[:, kept],
        sensor_initial={name: values[:, kept] for name, values in question.sensor_initial.items()},
        sensor_target={"position": target + generator.normal(scale=noise, size=target.shape)},
    )


def _show(rows: list[dict[str, object]]) -> None:
    table = Table(title="sensors of neural modes")
    for column in rows[0]:
        table.add_column(column)
    for row in rows:
        table.add_row(*(f"{value:.4g}" if isinstance(value, float) else str(value) for value in row.values()))
    Console(width=100).print(table)


if __name__ == "__main__":
    main()
