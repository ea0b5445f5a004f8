"""Which pairs of cases teach and which test: the three protocols that every table reports.

    thesis     train: initial case in 80 % of the factorial cases, target any of them; test: initial case in the rest.
               Every target shape has been seen in training: this tests new pairings, not new shapes.
    strict     the held-out cases are in neither role of training; test: pairs among them.
    off_grid   train as `thesis`; test: pairs among the cases with continuous activations from (0,1)^5.

Identical pairs (a case with itself: nothing moves) stand in `thesis` and in training, as 32 x 32 = 1,024 pairs of the
thesis do; they are left out of the tests of `strict` and `off_grid`, where they would only flatter 'do nothing'.
Source: thesis section 6.1 for the split 25/7 over the initial activations.
"""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
import xarray as xr
from jaxtyping import Int

from myograph.errors import InputError

Protocol = Literal["thesis", "strict", "off_grid"]
PROTOCOLS: tuple[Protocol, ...] = get_args(Protocol)
TRAINED_FRACTION = 0.8


@dataclass(frozen=True)
class Split:
    """Pairs (initial case, target case) of one protocol, as indices into the dataset's cases."""

    protocol: Protocol
    train: Int[np.ndarray, "train_pairs 2"]
    test: Int[np.ndarray, "test_pairs 2"]


def split_pairs(dataset: xr.Dataset, protocol: Protocol, seed: int = 0) -> Split:
    """Pairs to train and to test on; the seed says which initial cases are held out, alike for all protocols.

    Raises InputError where the dataset lacks the cases that the protocol needs.
    """
    if protocol not in PROTOCOLS:
        raise InputError(f"unknown protocol '{protocol}': expected one of {', '.join(PROTOCOLS)}")
    factorial = _cases(dataset, "factorial", at_least=6, protocol=protocol)
    shuffled = np.random.default_rng(seed).permutation(factorial)
    count = int(TRAINED_FRACTION * len(factorial))
    trained, held_out = np.sort(shuffled[:count]), np.sort(shuffled[count:])
    if protocol == "strict":
        return Split(protocol, _pairs(trained, trained), _different(_pairs(held_out, held_out)))
    if protocol == "off_grid":
        off_grid = _cases(dataset, "off_grid", at_least=2, protocol=protocol)
        return Split(protocol, _pairs(trained, factorial), _different(_pairs(off_grid, off_grid)))
    return Split(protocol, _pairs(trained, factorial), _pairs(held_out, factorial))


def _cases(dataset: xr.Dataset, design: str, at_least: int, protocol: Protocol) -> Int[np.ndarray, " cases"]:
    found = np.flatnonzero(dataset["design"].values == design)
    if len(found) < at_least:
        raise InputError(
            f"protocol '{protocol}': expected at least {at_least} cases of design '{design}', got {len(found)}; "
            "run an ensemble that has them"
        )
    return found


def _pairs(initial: Int[np.ndarray, " initial"], target: Int[np.ndarray, " target"]) -> Int[np.ndarray, "pairs 2"]:
    return np.stack([np.repeat(initial, len(target)), np.tile(target, len(initial))], axis=1)


def _different(pairs: Int[np.ndarray, "pairs 2"]) -> Int[np.ndarray, "different 2"]:
    return pairs[pairs[:, 0] != pairs[:, 1]]
