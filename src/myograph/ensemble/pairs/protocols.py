"""Which pairs of cases teach and which test: the three protocols that every table reports.

    thesis     train: initial case in 80 % of the factorial cases, target any of them; test: initial case in the rest.
               Every target shape has been seen in training: this tests new pairings, not new shapes.
    strict     the held-out factorial cases are in neither role of training; test: pairs among them.
    off_grid   train as `thesis`; test: pairs among the cases with continuous activations from (0,1)^5.

Cases of the design 'support' are further training cases, in both roles, of `strict` and `off_grid`; the thesis's
feed-forward network had about 1,743 of them.
Identical pairs (a case with itself: nothing moves) stand in `thesis` and in training, as 32 x 32 = 1,024 pairs of the
thesis do; they are left out of the tests of `strict` and `off_grid`, where they would only flatter 'do nothing'.
Source: thesis section 6.1 for the split 25/7 over the initial activations.
"""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from jaxtyping import Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError

Protocol = Literal["thesis", "strict", "off_grid"]
PROTOCOLS: tuple[Protocol, ...] = get_args(Protocol)
TRAINED_FRACTION = 0.8
FACTORIAL, SUPPORT, OFF_GRID = "factorial", "support", "off_grid"


@dataclass(frozen=True)
class PairSet:
    """All pairs (initial case, target case) of two lists of cases: never all in memory unless asked for."""

    initial: Int[np.ndarray, " initial"]
    target: Int[np.ndarray, " target"]

    def __len__(self) -> int:
        return len(self.initial) * len(self.target)

    @property
    def cases(self) -> Int[np.ndarray, " cases"]:
        """Every case in either role, once."""
        return np.union1d(self.initial, self.target)

    def draw(self, generator: np.random.Generator, count: int) -> Int[np.ndarray, "count 2"]:
        """That many pairs at random, with replacement."""
        return self._numbered(generator.integers(len(self), size=count))

    def all(self) -> Int[np.ndarray, "pairs 2"]:
        """Every pair."""
        return self._numbered(np.arange(len(self)))

    def _numbered(self, numbers: Int[np.ndarray, " pairs"]) -> Int[np.ndarray, "pairs 2"]:
        initial, target = np.divmod(numbers, len(self.target))
        return np.stack([self.initial[initial], self.target[target]], axis=1)


@dataclass(frozen=True)
class Split:
    """Pairs of one protocol, as indices into the cases."""

    protocol: Protocol
    train: PairSet
    test: Int[np.ndarray, "test_pairs 2"]


def split_pairs(cases: MuscleCases, protocol: Protocol, seed: int = 0) -> Split:
    """Pairs to train and to test on; the seed says which initial cases are held out, alike for all protocols.

    Raises InputError where there are not the cases that the protocol needs.
    """
    check_protocol(protocol)
    factorial = _cases(cases, FACTORIAL, at_least=6, protocol=protocol)
    shuffled = np.random.default_rng(seed).permutation(factorial)
    count = int(TRAINED_FRACTION * len(factorial))
    trained, held_out = np.sort(shuffled[:count]), np.sort(shuffled[count:])
    support = cases.named(SUPPORT)
    if protocol == "strict":
        taught = np.concatenate([trained, support])
        return Split(protocol, PairSet(taught, taught), _different(PairSet(held_out, held_out)))
    if protocol == "off_grid":
        off_grid = _cases(cases, OFF_GRID, at_least=2, protocol=protocol)
        train = PairSet(np.concatenate([trained, support]), np.concatenate([factorial, support]))
        return Split(protocol, train, _different(PairSet(off_grid, off_grid)))
    return Split(protocol, PairSet(trained, factorial), PairSet(held_out, factorial).all())


def check_protocol(name: str) -> None:
    """Raise InputError for a name that is none of the protocols."""
    if name not in PROTOCOLS:
        raise InputError(f"unknown protocol '{name}': expected one of {', '.join(PROTOCOLS)}")


def _cases(cases: MuscleCases, design: str, at_least: int, protocol: Protocol) -> Int[np.ndarray, " cases"]:
    found = cases.named(design)
    if len(found) < at_least:
        raise InputError(
            f"protocol '{protocol}': expected at least {at_least} cases of design '{design}', got {len(found)}; "
            "run an ensemble that has them"
        )
    return found


def _different(pairs: PairSet) -> Int[np.ndarray, "different 2"]:
    numbered = pairs.all()
    return numbered[numbered[:, 0] != numbered[:, 1]]
