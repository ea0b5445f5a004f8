"""Mesh sizes: does a larger graph help, and what became of that with the sign of listing 5.2?

All graphs are trained for as many steps.
"""

from collections.abc import Sequence

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import over
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.evaluation import Figure

SIGNS = {"right": {}, "legacy_sign": {"traps": {"legacy_sign": True}}}


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """The thesis's network over its nodes, with either sign."""
    few, training = corners(data), size.training(size.large)
    rows = []
    for sign, trap in SIGNS.items():
        for axis in size.meshes:
            name, options = _name(sign, axis), {"nodes_per_axis": axis, **trap}
            rows.append(taught_twice(name, "gen_thesis", few, size, size.seeds, options=options, training=training))
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Error over the number of nodes."""
    groups = {sign: {float(axis**3): _name(sign, axis) for axis in outcome.size.meshes} for sign in SIGNS}
    caption = (
        "Mean error over the number of graph nodes, with the right sign in the softmax and with that of listing 5.2; "
        f"bands: deviation over {outcome.size.seeds} seeds; 'strict' has one."
    )
    return (over(outcome, groups, ("nodes of the graph", caption), ("off_grid", "strict")),)


def _name(sign: str, axis: int) -> str:
    return f"{axis**3} nodes, {sign}"


EXPERIMENT = Experiment(trials, figures)
