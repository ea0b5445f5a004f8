"""What a section of the reproduction is: trials, and pictures of what they found."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.outcome import Figures, Outcome, Row, table_rows
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Chosen, Teaching, Trial

MODES = {"reads": "sensors"}
"""Neural modes that answer from the sensors."""


@dataclass(frozen=True)
class Experiment:
    """A section.

    Parameters
    ----------
    trials
        What is tried; simulates the cases that it needs.
    figures
        Pictures of what was found, in the order of the report.
    rows
        Of the table.
    """

    trials: Callable[[Data, Size], Sequence[Trial]]
    figures: Figures
    rows: Callable[[Outcome], list[Row]] = table_rows


def corners(data: Data, support: bool = False) -> Chosen:
    """The thesis's 32 cases, with random tenths to learn from if wanted, and continuous activations to test on."""
    return Chosen(
        "ensemble",
        data.numbers("ensemble", "factorial"),
        data.numbers("ensemble", "off_grid")[: data.size.off_grid],
        data.numbers("ensemble", "support")[: data.size.support] if support else (),
    )


def taught_twice(
    name: str, method: str, cases: Chosen, size: Size, seeds: int = 1, strict_seeds: int = 1, **asked: Any
) -> list[Trial]:
    """Trials of one row: taught by `off_grid`, which tests `thesis` too, and by `strict`; from so many seeds each."""
    each: dict[Teaching, int] = {"off_grid": seeds, "strict": strict_seeds}
    return [
        _seeded(Trial(name, method, cases, teaching, pairs=size.pairs, **asked), seed)
        for seed in range(max(each.values()))
        for teaching, count in each.items()
        if seed < count
    ]


def _seeded(trial: Trial, seed: int) -> Trial:
    training = {**trial.training, "seed": seed} if trial.training else {}
    return replace(trial, seed=seed, training=training)
