"""What the 90 % intervals of a model hold, from other sensors than those that calibrated them, and from noisy ones.

    python benchmarks/intervals.py [MODEL] [--seed 0] [--json]

The model (the shipped biceps without it) answers the shipped cases off the grid from the body at rest; sensors that are
not those of the training are drawn at random, noise is normal in every coordinate and told to the model.
"""

import argparse
import json
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from rich.console import Console
from rich.table import Table

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import OFF_GRID
from myograph.errors import InputError
from myograph.inference.loaded import LoadedModel, load
from myograph.inference.shipped import shipped_truth

OTHERS = (1, 2, 4, 6, 9, 30, 400)
NOISE_MM = (0.02, 0.1, 0.3, 1.0)
NOISE_OF_OTHERS = 0.5


@dataclass(frozen=True)
class Row:
    """Means over all nodes and cases; a share is None where the model gives no intervals."""

    sensors: str
    noise_mm: float
    with_activations: bool
    mean_mm: float
    half_width_mm: float | None
    held: float | None
    inside: float


def main(arguments: Sequence[str] | None = None) -> None:
    """Ask, count, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", nargs="?", default="biceps")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    asked = parser.parse_args(arguments)
    model = load(asked.model)
    cases = shipped_truth(model.told.muscle, model.body.nodes)
    rows = list_rows(model, cases, asked.seed)
    if asked.json:
        print(json.dumps([vars(row) for row in rows]))
        return
    table = Table("sensors", "noise, mm", "told", "mean error, mm", "half width, mm", "held", "inside")
    for row in rows:
        told = "both" if row.with_activations else "sensors"
        width, held = (f"{v:{f}}" if v is not None else "–" for v, f in ((row.half_width_mm, ".3f"), (row.held, ".1%")))
        table.add_row(row.sensors, f"{row.noise_mm:g}", told, f"{row.mean_mm:.4f}", width, held, f"{row.inside:.0%}")
    Console(width=110).print(table)


def list_rows(model: LoadedModel, cases: MuscleCases, seed: int) -> list[Row]:
    """Of the sensors of the training, exact and noisy, and of others; with activations, too, where they may be told."""
    if not model.told.signature.takes_sensors:
        raise InputError(f"{model.name}: expected a model that answers from sensors")
    usual = np.array(model.told.signature.sensors)
    ways = (False, True) if model.told.signature.unknown_activation else (False,)
    rows = []
    for both in ways:
        generator = np.random.default_rng(seed)
        for count in OTHERS if model.told.signature.any_sensors else ():
            if model.told.signature.least_sensors <= count < model.body.nodes:
                nodes = np.sort(generator.choice(model.body.nodes, count, replace=False))
                for noise in (0.0, NOISE_OF_OTHERS):
                    rows.append(_row(model, cases, (f"{count} others", nodes), (noise, both), generator))
        for noise in (0.0, *NOISE_MM):
            rows.append(_row(model, cases, ("of the training", usual), (noise, both), generator))
    return rows


def _row(
    model: LoadedModel,
    cases: MuscleCases,
    sensors: tuple[str, np.ndarray],
    told: tuple[float, bool],
    generator: np.random.Generator,
) -> Row:
    (words, nodes), (noise, both) = sensors, told
    chosen = cases.named(OFF_GRID)
    true = cases.values("position", chosen).astype(np.float64)
    now = true[:, nodes] + generator.normal(scale=noise, size=(len(chosen), len(nodes), 3))
    activation = cases.activation[chosen] if both else None
    answer = model.predict_sensors(nodes, now, activation=activation, sensor_noise=noise)
    error, width = np.linalg.norm(answer.values["position"] - true, axis=-1), answer.half_width_90.get("position")
    assert answer.inside is not None
    return Row(
        words,
        noise,
        both,
        float(error.mean()),
        None if width is None else float(width.mean()),
        None if width is None else float((error <= width).mean()),
        float(answer.inside.mean()),
    )


if __name__ == "__main__":
    main()
