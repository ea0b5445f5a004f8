"""Section 6.2.1: target coordinates from nine sensors, both meshes, all baselines."""

from collections.abc import Sequence

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import MODES, Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import dots, far, heat, meshes
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.evaluation import Figure
from myograph.learning.gen.config import NetworkConfig

THESIS_RATE = {"learning_rate": 1e-4, "schedule": "constant"}


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Methods that learn from 32 cases, and those that learn from activations of many more."""
    few, many = corners(data), corners(data, support=True)
    small, large = size.share(2), size.share(size.large)
    rows = [taught_twice(name, name, few, size) for name in ("do_nothing", "affine", "thin_plate_spline", "gappy_pod")]
    rows += [
        taught_twice(f"gen_thesis_{axis**3}", "gen_thesis", few, size, options=_axis(axis), training={"steps": steps})
        for axis, steps in ((2, small), (size.large, large))
    ]
    as_thesis = {**THESIS_RATE, "steps": size.thesis_steps}
    improved = NetworkConfig.improved().model_dump()
    rows += [
        taught_twice("gen_thesis_8, its rate", "gen_thesis", few, size, options=_axis(2), training=as_thesis),
        taught_twice("gen_8", "gen", few, size, training={"steps": small}),
        taught_twice("gen_8, improved", "gen", few, size, options=improved, training={"steps": small}),
        taught_twice("neural_modes, sensors", "neural_modes", few, size, options=MODES),
        taught_twice("feed_forward", "feed_forward", many, size, training={"steps": small}),
        taught_twice("deeponet", "deeponet", many, size, training={"steps": small}, convention="material"),
        taught_twice("pod_gp", "pod_gp", many, size),
        taught_twice("neural_modes", "neural_modes", many, size),
    ]
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Meshes before and after, heat maps, all methods, errors over the distance."""
    small, large = "gen_thesis_8", f"gen_thesis_{outcome.size.large**3}"
    shown = (small, large, "gen_8, improved", "feed_forward")
    return (
        meshes(outcome, (small, large), "6.2 a, b, d, e"),
        *heat(outcome, shown, "strict", "mm", "6.2 c, f, g"),
        dots(outcome, "All methods under all protocols."),
        far(outcome, ("thin_plate_spline", *shown, "pod_gp"), "off_grid"),
    )


def _axis(nodes_per_axis: int) -> dict[str, int]:
    return {"nodes_per_axis": nodes_per_axis}


EXPERIMENT = Experiment(trials, figures)
