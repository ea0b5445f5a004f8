"""The sections by the names that they are asked for, in the order of the report."""

from myograph.cli.reproduce.experiment import Experiment
from myograph.cli.reproduce.sections import (
    activation_steps,
    complexity,
    convolutions,
    direct_cases,
    direction_vector,
    distortion,
    edge,
    mesh_sizes,
    sensor_counts,
    target_coordinates,
)
from myograph.errors import InputError

EXPERIMENTS: dict[str, Experiment] = {
    "6.2.1": target_coordinates.EXPERIMENT,
    "6.2.2": direction_vector.EXPERIMENT,
    "6.2.3": distortion.EXPERIMENT,
    "6.2.4": complexity.EXPERIMENT,
    "meshes": mesh_sizes.EXPERIMENT,
    "sensors": sensor_counts.EXPERIMENT,
    "steps": activation_steps.EXPERIMENT,
    "direct": direct_cases.EXPERIMENT,
    "convolutions": convolutions.EXPERIMENT,
    "edge": edge.EXPERIMENT,
}


def check_sections(names: list[str]) -> list[str]:
    """The names in the order of the report, each once; raises InputError for one that is none."""
    for name in names:
        if name not in EXPERIMENTS:
            raise InputError(f"section '{name}': expected one of {', '.join(EXPERIMENTS)}")
    return [name for name in EXPERIMENTS if name in names]
