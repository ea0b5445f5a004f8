"""Section 6.2.2: how a node moves, instead of where it comes to: as a vector, or as a direction and a length."""

from collections.abc import Sequence

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import dots, heat
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.evaluation import Figure

FEATURES = ("coordinates", "displacement", "direction_and_scale")


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """The thesis's network, both meshes, with each feature in and out."""
    few = corners(data)
    rows = [taught_twice("do_nothing", "do_nothing", few, size, size.seeds)]
    for axis in (2, size.large):
        for feature in FEATURES:
            plain = {"inputs": ((feature,),), "outputs": ((feature,),)} if feature != "coordinates" else {}
            options, training = {"nodes_per_axis": axis, **plain}, size.training(axis)
            name = f"gen_thesis_{axis**3}, {feature}"
            rows.append(taught_twice(name, "gen_thesis", few, size, size.seeds, options=options, training=training))
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Heat map and dots."""
    shown = [f"gen_thesis_8, {feature}" for feature in FEATURES]
    return (
        *heat(outcome, shown, "strict", "mm", "6.3 a"),
        dots(outcome, "Coordinates, displacement, and direction with length, under all protocols."),
    )


EXPERIMENT = Experiment(trials, figures)
