"""Writes what peers are given, as one plain file that needs no myograph to be read; run in myograph's environment.

    python benchmarks/peers/export_cases.py STORE cases.npz [--support 512] [--seed 0]

activation (cases, 5), position (cases, nodes, 3) [mm], von_mises (cases, nodes) [MPa], reference (nodes, 3), cells,
sensors; and for each protocol the numbers of the cases that teach and of those that test (`train_strict`, ...).
`thesis` tests targets that training saw, with other initial states: a method that knows the activations has seen all.
Every seed has cases off the grid of its own, TESTED of them, in the store's order.
"""

import argparse
from pathlib import Path

import numpy as np

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import FACTORIAL, OFF_GRID, PROTOCOLS, SUPPORT, split_pairs
from myograph.ensemble.pairs.sampler import random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.views import chosen
from myograph.errors import InputError

TESTED = 64
"""Cases off the grid that one seed is tested on."""


def cases_of(store: Path, support: int, seeds: int) -> MuscleCases:
    """Corners, at most so many random tenths, and the continuous cases of so many seeds, of the biceps.

    Raises InputError for a store with fewer continuous cases.
    """
    cases = read_muscle(store, "biceps")
    off_grid = cases.named(OFF_GRID)
    if len(off_grid) < seeds * TESTED:
        raise InputError(
            f"{store}: expected at least {seeds * TESTED} cases of design '{OFF_GRID}', {TESTED} for each of {seeds} "
            f"seeds, got {len(off_grid)}; take fewer seeds, or a store of benchmarks/peers/ensemble.toml"
        )
    return _with(cases, cases.named(SUPPORT)[:support], off_grid[: seeds * TESTED])


def of_seed(cases: MuscleCases, seed: int) -> MuscleCases:
    """The same, with the continuous cases of this seed alone."""
    return _with(cases, cases.named(SUPPORT), cases.named(OFF_GRID)[seed * TESTED : (seed + 1) * TESTED])


def _with(cases: MuscleCases, support: np.ndarray, off_grid: np.ndarray) -> MuscleCases:
    numbers = {FACTORIAL: cases.named(FACTORIAL), SUPPORT: support, OFF_GRID: off_grid}
    return chosen(cases, {word: own.tolist() for word, own in numbers.items()})


def arrays_of(cases: MuscleCases, seed: int) -> dict[str, np.ndarray]:
    """All that the file holds."""
    every = np.arange(len(cases))
    arrays = {
        "activation": cases.activation,
        "position": cases.values("position", every),
        "von_mises": cases.values("von_mises", every),
        "reference": cases.body.reference,
        "cells": cases.body.cells,
        "sensors": random_sensors(cases.nodes),
    }
    for protocol in PROTOCOLS:
        split = split_pairs(cases, protocol, seed)
        arrays[f"train_{protocol}"] = np.unique(split.train.target)
        arrays[f"test_{protocol}"] = np.unique(split.test[:, 1])
    return arrays


def main() -> None:
    """Write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("store", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--support", type=int, default=512)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    cases = of_seed(cases_of(asked.store, asked.support, asked.seed + 1), asked.seed)
    np.savez_compressed(asked.out, **arrays_of(cases, asked.seed))


if __name__ == "__main__":
    main()
