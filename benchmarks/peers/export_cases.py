"""Writes what peers are given, as one plain file that needs no myograph to be read; run in myograph's environment.

    python benchmarks/peers/export_cases.py STORE cases.npz [--support 512]

activation (cases, 5), position (cases, nodes, 3) [mm], von_mises (cases, nodes) [MPa], reference (nodes, 3), cells,
sensors; and for each protocol the numbers of the cases that teach and of those that test (`train_strict`, ...).
`thesis` tests targets that training saw, with other initial states: a method that knows the activations has seen all.
"""

import argparse
from pathlib import Path

import numpy as np

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import PROTOCOLS, split_pairs
from myograph.ensemble.pairs.sampler import random_sensors
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.views import chosen


def cases_of(store: Path, support: int) -> MuscleCases:
    """Corners, at most so many random tenths, and continuous cases of the biceps."""
    cases = read_muscle(store, "biceps")
    words = {"factorial": cases.named("factorial"), "support": cases.named("support")[:support]}
    listed = {word: numbers.tolist() for word, numbers in {**words, "off_grid": cases.named("off_grid")}.items()}
    return chosen(cases, listed)


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
    np.savez_compressed(asked.out, **arrays_of(cases_of(asked.store, asked.support), asked.seed))


if __name__ == "__main__":
    main()
