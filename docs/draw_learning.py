"""Draw how the thesis's network and its improvement learn, where on the muscle methods err, and what intervals hold.

    python docs/draw_learning.py STORE --truth STORE [--steps 1000] [--seeds 3] [--out docs]

STORE has cases of tables of the size 'quick'; the truth direct finite elements of the shipped biceps's size. Writes
training-curves.png, error-maps.png and coverage.png.
"""

import argparse
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import torch

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import OFF_GRID, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.evaluation import evaluate
from myograph.files import write_whole
from myograph.inference.shipped import find_model
from myograph.inference.ways import WAYS, WHOLE
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner, TrainedGen
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from myograph.learning.saving import load_torch
from myograph.learning.training import TrainingConfig
from myograph.learning.trust.conformal import conformal_factor
from myograph.learning.trust.scores import scores
from myograph.view.bands import Axes, Band, draw_bands
from myograph.view.heat import draw_heat_maps

NETWORKS = {"thesis's network": NetworkConfig.thesis(), "improved": NetworkConfig.improved()}
TOLD = {WHOLE: "activations and sensors", "activation": "activations", "sensors": "nine sensors"}
LEVELS = np.array([0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95])
PAIRS, HALVINGS, SMOOTHED = 96, 200, 25
"""Test pairs of the maps; halvings of the truth; steps that a point of a training curve is the mean of."""


def main() -> None:
    """Train, judge, draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("--truth", type=Path, required=True)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent)
    asked = parser.parse_args()
    torch.set_num_threads(1)
    _write(asked.out / "coverage.png", coverage(asked.truth))
    cases = read_muscle(asked.store, "biceps")
    sampler, split = PairSampler(cases, random_sensors(cases.nodes)), split_pairs(cases, "strict")
    trained = {
        name: [
            GenLearner(network, TrainingConfig(steps=asked.steps, seed=seed)).train(sampler, split)
            for seed in range(asked.seeds)
        ]
        for name, network in NETWORKS.items()
    }
    _write(asked.out / "training-curves.png", training_curves(trained))
    modes = ModesLearner(ModesConfig(reads="sensors")).fit(sampler, split)
    best = {name: runs[0].predictor for name, runs in trained.items()}
    _write(asked.out / "error-maps.png", error_maps(sampler, {**best, "neural modes": modes}))


def coverage(truth: Path) -> bytes:
    """What share of the truth intervals of any level hold, calibrated on one half of it and counted on the other."""
    model, cases = load_torch(find_model("biceps")), read_muscle(truth, "biceps")
    sampler = PairSampler(cases, np.array(model.signature.sensors), "material")
    chosen, generator, bands = cases.named(OFF_GRID), np.random.default_rng(0), []
    halves = [generator.permutation(len(chosen)) < len(chosen) // 2 for _ in range(HALVINGS)]
    for way in (WHOLE, *WAYS):
        found = scores(model, sampler, np.stack([chosen, chosen], axis=1), way)
        errors, deviations = found.errors["position"], found.deviations["position"]
        held = np.empty((len(halves), len(LEVELS)))
        for row, half in enumerate(halves):
            for column, level in enumerate(LEVELS):
                factor = conformal_factor(errors[half], deviations[half], None, level)
                held[row, column] = (errors[~half] <= factor * deviations[~half]).mean()
        low, high = np.percentile(100 * held, [5, 95], axis=0)
        bands.append(Band(TOLD[way], 100 * LEVELS, 100 * held.mean(axis=0), low, high))
    bands.append(Band("as promised", 100 * LEVELS, 100 * LEVELS, dashed=True, colour="#555555"))
    return draw_bands(bands, Axes("level of the intervals [%]", "share of nodes that they hold [%]", log_y=False))


def training_curves(trained: Mapping[str, list[TrainedGen]]) -> bytes:
    """Error of the pairs that each step sees: mean over the seeds, from the least to the largest."""
    bands = []
    for name, runs in trained.items():
        steps = len(runs[0].history.rmse) // SMOOTHED
        each = np.stack([run.history.rmse[: steps * SMOOTHED].reshape(steps, SMOOTHED).mean(axis=1) for run in runs])
        at = SMOOTHED * (np.arange(steps) + 0.5)
        bands.append(Band(name, at, each.mean(axis=0), each.min(axis=0), each.max(axis=0)))
    return draw_bands(bands, Axes("step", "root mean square error [mm]", marked=False))


def error_maps(sampler: PairSampler, methods: Mapping[str, Predictor]) -> bytes:
    """Mean error of every node over pairs of cases off the grid; sensors are not asked."""
    test = split_pairs(sampler.cases, "off_grid").test
    pairs = test[np.sort(np.random.default_rng(0).permutation(len(test))[:PAIRS])]
    errors = {}
    for name, method in methods.items():
        found = evaluate(method, sampler.batches(pairs)).position
        assert found is not None
        errors[name] = np.full(sampler.cases.nodes, np.nan)
        errors[name][sampler.queries] = found.node_mean
    return draw_heat_maps(sampler.cases.body.reference, sampler.cases.body.skin, errors)


def _write(path: Path, picture: bytes) -> None:
    write_whole(path, lambda file: file.write(picture))


if __name__ == "__main__":
    main()
