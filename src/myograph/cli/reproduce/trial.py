"""One thing that is tried: a method, the cases that teach it, what it is asked. It travels to a process as it is."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

from myograph.ensemble.pairs.protocols import Protocol

MUSCLE = "biceps"
Teaching = Literal["off_grid", "strict"]
TESTED: dict[Teaching, tuple[Protocol, ...]] = {"off_grid": ("thesis", "off_grid"), "strict": ("strict",)}
"""What teaches -> the protocols that are fair to it: without cases 'support', `off_grid` teaches what `thesis` does."""


@dataclass(frozen=True)
class Chosen:
    """Which cases are seen, and as what.

    Parameters
    ----------
    store
        Name of the store: 'ensemble', 'steps', 'direct' or 'beside'.
    factorial, support, off_grid
        Numbers of cases that count as these.
    truth
        Name of another store with the same cases, whose fields test; without it the one that teaches.
    """

    store: str
    factorial: tuple[int, ...]
    off_grid: tuple[int, ...]
    support: tuple[int, ...] = ()
    truth: str | None = None


Choice = Literal["random", "deviation", "overall"]
"""How the next case to simulate is chosen: see `growing`."""


@dataclass(frozen=True)
class Drawn:
    """So many of the factorial cases teach, chosen out of all of them as a pool."""

    count: int
    by: Choice


@dataclass(frozen=True)
class Trial:
    """A method, taught and tested.

    Parameters
    ----------
    name
        As it stands in the table; seeds and teachings of one name become one row for each protocol.
    method, options, training
        As `myograph.learning.learners` knows them.
    teaching
        Which split teaches: that of `off_grid` or that of `strict`.
    sensors
        How many, at random.
    seed
        Of the sensors, the split and the training.
    pairs
        Test pairs of a protocol, at most.
    weighed
        Whether the saved model's size, its time on one core and its multiplications are measured too.
    drawn
        Which of the cases teach, where not all of them do.
    """

    name: str
    method: str
    cases: Chosen
    teaching: Teaching
    options: Mapping[str, Any] = field(default_factory=dict)
    training: Mapping[str, Any] = field(default_factory=dict)
    convention: Literal["initial", "material"] = "initial"
    known: tuple[str, ...] = ("position",)
    asked: tuple[str, ...] = ("position",)
    sensors: int = 9
    seed: int = 0
    pairs: int = 256
    weighed: bool = False
    drawn: Drawn | None = None

    @property
    def tested(self) -> tuple[Protocol, ...]:
        """The protocols that are fair to it; where cases are drawn, those of `thesis` would be the ones that teach."""
        return tuple(each for each in TESTED[self.teaching] if self.drawn is None or each != "thesis")

    def key(self, checksums: Mapping[str, str]) -> str:
        """Checksum of all that the outcome depends on, its name aside; `checksums` are those of the stores."""
        told = asdict(self)
        told.pop("name")
        if self.drawn is None:
            told.pop("drawn")
        data = [checksums[name] for name in (self.cases.store, self.cases.truth) if name is not None]
        return hashlib.sha256(json.dumps([told, data], sort_keys=True).encode()).hexdigest()
