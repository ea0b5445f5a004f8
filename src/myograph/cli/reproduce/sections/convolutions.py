"""Convolutions: what happens between the nodes of the graph, all else alike."""

from collections.abc import Sequence
from typing import get_args

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import dots
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.evaluation import Figure
from myograph.learning.gen.config import Processor

AXIS = 3
"""Nodes of the graph along each axis."""


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """The network with each processor."""
    few, whole = corners(data), size.training(AXIS)
    training = {**whole, "steps": whole["steps"] // 2}
    rows = [
        taught_twice(name, "gen", few, size, options={"nodes_per_axis": AXIS, "processor": name}, training=training)
        for name in get_args(Processor)
    ]
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Dots."""
    return (dots(outcome, f"Processors on a graph of {AXIS**3} nodes, each trained alike."),)


EXPERIMENT = Experiment(trials, figures)
