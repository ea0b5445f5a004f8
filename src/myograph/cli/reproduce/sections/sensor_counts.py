"""Number of sensors: how few of them a network needs, beside what linear methods make of the same."""

from collections.abc import Sequence

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import MODES, Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import over
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.evaluation import Figure

PLAIN = {"thin_plate_spline": {}, "gappy_pod": {}, "neural_modes": MODES}
LEAST = 4
"""Sensors of an affine map or a spline."""


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Each method with each number of random sensors."""
    few, training = corners(data), size.training(2)
    rows = []
    for count in size.sensors:
        rows.append(taught_twice(_name("gen_8", count), "gen", few, size, training=training, sensors=count))
        for method, options in PLAIN.items():
            if method != "thin_plate_spline" or count >= LEAST:
                rows.append(taught_twice(_name(method, count), method, few, size, options=options, sensors=count))
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Error over the number of sensors."""
    methods = ("gen_8", *PLAIN)
    groups = {method: {float(count): _name(method, count) for count in outcome.size.sensors} for method in methods}
    caption = "Mean error over the number of sensors, placed at random."
    return (over(outcome, groups, ("sensors", caption), ("off_grid", "strict")),)


def _name(method: str, count: int) -> str:
    return f"{method}, {count} sensors"


EXPERIMENT = Experiment(trials, figures)
