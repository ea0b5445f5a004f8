"""Section 6.2.1: target coordinates from nine sensors, both meshes, all baselines."""

from collections.abc import Sequence
from typing import Any

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import MODES, Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import dataset, dots, far, heat, meshes
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Chosen, Trial
from myograph.evaluation import Figure
from myograph.learning.gen.config import NetworkConfig

THESIS_RATE = {"learning_rate": 1e-4, "schedule": "constant"}


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Methods that learn from 32 cases, and those that learn from activations of many more."""
    few, many = corners(data), corners(data, support=True)
    small, large = size.training(2), size.training(size.large)
    as_thesis, benchmark = {**THESIS_RATE, "steps": size.thesis_steps}, {"steps": size.benchmark_steps}
    improved = NetworkConfig.improved().model_dump()

    def row(name: str, method: str, cases: Chosen, **asked: Any) -> list[Trial]:
        return taught_twice(name, method, cases, size, **{"seeds": size.seeds, "strict_seeds": size.seeds, **asked})

    rows = [row(name, name, few) for name in ("do_nothing", "affine", "thin_plate_spline", "gappy_pod")]
    rows += [
        row(f"gen_thesis_{axis**3}", "gen_thesis", few, options=_axis(axis), training=training)
        for axis, training in ((2, small), (size.large, large))
    ]
    rows += [
        row("gen_thesis_8, its rate", "gen_thesis", few, options=_axis(2), training=as_thesis),
        row("gen_8", "gen", few, training=small),
        row("gen_8, improved", "gen", few, options=improved, training=small),
        row("neural_modes, sensors", "neural_modes", few, options=MODES),
        row("feed_forward", "feed_forward", many, training=benchmark),
        row("deeponet", "deeponet", many, training={"steps": size.steps}, convention="material"),
        row("pod_gp", "pod_gp", many),
        row("neural_modes", "neural_modes", many),
    ]
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """The cases, meshes before and after, heat maps, all methods, errors over the distance."""
    small, large = "gen_thesis_8", f"gen_thesis_{outcome.size.large**3}"
    shown = (small, large, "gen_8, improved", "feed_forward")
    return (
        dataset(outcome, "5.1, 5.2"),
        meshes(outcome, (small, large), "6.2 a, b, d, e"),
        *heat(outcome, shown, "strict", "mm", "6.2 c, f, g"),
        dots(outcome, "All methods under all protocols."),
        far(outcome, ("thin_plate_spline", *shown, "pod_gp"), "off_grid"),
    )


def _axis(nodes_per_axis: int) -> dict[str, int]:
    return {"nodes_per_axis": nodes_per_axis}


EXPERIMENT = Experiment(trials, figures)
