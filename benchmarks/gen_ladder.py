"""What each switch of the graph element network is worth: mean error of a muscle's nodes, a row for each switch.

    python benchmarks/gen_ladder.py --store DIR [--muscle biceps] [--rows NAME ...] [--protocol strict off_grid]
        [--seeds 3] [--steps 300] [--batch 8] [--queries 64] [--nodes-per-axis 2] [--learning-rate 6e-3] [--json]

Every row is trained alike, from as many seeds; `traps` are rows of the thesis network with one mistake each. Beside the
error stands how far volumes change where elements are integrated: mean and largest |det F - 1| of some test cases.
"""

import argparse
import json
from pathlib import Path

import numpy as np
import torch
from rich.console import Console
from rich.table import Table

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.learning.gen.config import NetworkConfig, Traps
from myograph.learning.gen.learner import GenLearner
from myograph.learning.modes.volume import volume_ratios
from myograph.learning.physics.config import Physics
from myograph.learning.training import TrainingConfig

TESTED = 300
"""Test pairs at most, drawn at random."""
WEIGHED = 32
"""Of these, pairs whose volumes are looked at."""
THESIS = NetworkConfig.thesis()
ROWS: dict[str, NetworkConfig] = {
    "thesis": THESIS,
    **{f"thesis, {trap}": THESIS.model_copy(update={"traps": Traps(**{trap: True})}) for trap in Traps.model_fields},
    "thesis, mean": THESIS.model_copy(update={"aggregation": "mean"}),
    "displacement": NetworkConfig(),
    "direction and scale": NetworkConfig(inputs=(("direction_and_scale",),), outputs=(("direction_and_scale",),)),
    "affine skip": NetworkConfig(skip="affine"),
    "silu": NetworkConfig(nonlinearity="silu"),
    "mlp": NetworkConfig(processor="mlp"),
    "mpnn": NetworkConfig(processor="mpnn"),
    "per-node sharpness": NetworkConfig(sharpness="per_node"),
    "fixed sharpness": NetworkConfig(sharpness="fixed"),
    "material": NetworkConfig(),
    "physics": NetworkConfig(physics=Physics(volume=0.3, clamped=0.003)),
    "stress heads": NetworkConfig(outputs=(("displacement",), ("von_mises",))),
    "nearest, 4 nodes": NetworkConfig(representer="nearest", nearest=4),
    "barycentric": NetworkConfig(representer="barycentric"),
    "context": NetworkConfig(context=True),
    "modulated": NetworkConfig(modulated=True),
    "wide": NetworkConfig(latent=64, hidden=(64, 64)),
    "activation": NetworkConfig(activation_input=True, reads="sensors_and_activation"),
    "improved": NetworkConfig.improved(),
}
MATERIAL = {"material", "physics"}
"""Rows that name points by where they are in the reference body; all others do by where they were at first."""
Measured = tuple[float, float, float]
"""Mean error [mm], mean and largest |det F - 1| [-]."""


def main() -> None:
    """Train, measure, print."""
    asked = _arguments()
    torch.set_num_threads(1)
    cases = read_muscle(asked.store, asked.muscle)
    found: dict[str, dict[str, list[Measured]]] = {"truth": {}}
    for name in asked.rows or ROWS:
        network = ROWS[name].model_copy(update={"nodes_per_axis": asked.nodes_per_axis})
        convention = "material" if name in MATERIAL else "initial"
        fields = ("position", "von_mises") if ("von_mises",) in network.outputs else ("position",)
        sampler = PairSampler(cases, random_sensors(cases.nodes), convention, asked=fields)
        found[name] = {}
        for protocol in asked.protocol:
            split = split_pairs(cases, protocol)
            truth = cases.values("position", tested(split)[:WEIGHED, 1])
            found["truth"][protocol] = [(0.0, *volume_changes(sampler, truth))]
            trained = [GenLearner(network, _training(asked, seed)).fit(sampler, split) for seed in range(asked.seeds)]
            found[name][protocol] = [measured(predictor, sampler, split) for predictor in trained]
    print(json.dumps(found)) if asked.json else Console().print(_table(found, asked.protocol))


def measured(predictor: Predictor, sampler: PairSampler, split: Split) -> Measured:
    """Mean distance over test pairs and queries [mm]; mean and largest |det F - 1| [-], NaN without elements."""
    pairs = tested(split)
    distances = [
        np.linalg.norm(predictor.predict(batch.question).values["position"] - batch.truth["position"], axis=-1)
        for batch in sampler.batches(pairs)
    ]
    asked = sampler.batch(pairs[:WEIGHED], np.arange(sampler.cases.nodes)).question
    changes = volume_changes(sampler, predictor.predict(asked).values["position"])
    return (float(np.concatenate(distances).mean()), *changes)


def volume_changes(sampler: PairSampler, positions: np.ndarray) -> tuple[float, float]:
    """Mean and largest |det F - 1| of positions of all nodes [-]; NaN without elements."""
    if not len(sampler.cases.body.cells):
        return np.nan, np.nan
    ratios = volume_ratios(sampler.cases.body, positions)
    return ratios.change, ratios.largest_change


def tested(split: Split) -> np.ndarray:
    """Test pairs that are looked at."""
    count = min(TESTED, len(split.test))
    return split.test[np.random.default_rng(0).choice(len(split.test), count, replace=False)]


def _training(asked: argparse.Namespace, seed: int) -> TrainingConfig:
    return TrainingConfig(
        steps=asked.steps, batch=asked.batch, queries=asked.queries, learning_rate=asked.learning_rate, seed=seed
    )


def _table(found: dict[str, dict[str, list[Measured]]], protocols: list[str]) -> Table:
    columns = [f"{protocol}, {what}" for protocol in protocols for what in ("mm", "mean |J-1|", "largest |J-1|")]
    table = Table("network", *columns)
    for name, rows in found.items():
        cells = []
        for protocol in protocols:
            errors, changes, largest = np.array(rows[protocol]).T
            cells += [f"{errors.mean():.2f} ± {errors.std():.2f}", f"{changes.mean():.3f}", f"{largest.max():.2f}"]
        table.add_row(name, *cells)
    return table


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--store", type=Path, required=True)
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--rows", nargs="+", choices=ROWS)
    parser.add_argument("--protocol", nargs="+", default=["strict", "off_grid"])
    for name, default in (("seeds", 3), ("steps", 300), ("batch", 8), ("queries", 64), ("nodes-per-axis", 2)):
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--learning-rate", type=float, default=TrainingConfig().learning_rate)
    parser.add_argument("--json", action="store_true")
    return parser.parse_args()


if __name__ == "__main__":
    main()
