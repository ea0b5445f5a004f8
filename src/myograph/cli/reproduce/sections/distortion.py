"""Section 6.2.3: the maximum distortion criterion, that is von Mises stress by the right formula; Gaussian processes.

The thesis's equation 6.1 has (s_x - s_z)^2 where (s_y - s_z)^2 belongs: one row says what that slip is worth here.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome, Row, rounded, table_rows
from myograph.cli.reproduce.pictures import far, heat
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.evaluation import Figure
from myograph.fields import von_mises
from myograph.view.bands import Axes, Band, draw_bands

STRESS = ("von_mises",)
SLIP = "equation 6.1 as printed"
PARTS = 12
"""Of the muscle's length."""


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Networks from nine sensors that tell positions, or stresses too; methods that know the activations."""
    few, many = corners(data), corners(data, support=True)
    rows = [taught_twice("do_nothing", "do_nothing", few, size, size.seeds, asked=STRESS)]
    for axis in (2, size.large):
        training = size.training(axis)
        given = {"nodes_per_axis": axis, "outputs": (STRESS,)}
        told = {**given, "inputs": (("coordinates",), STRESS)}
        plain = {"training": training, "asked": STRESS}
        more = {**plain, "options": told, "known": ("position", "von_mises")}
        name = f"gen_thesis_{axis**3}"
        rows += [
            taught_twice(name, "gen_thesis", few, size, size.seeds, options=given, **plain),
            taught_twice(f"{name}, stress at sensors", "gen_thesis", few, size, size.seeds, **more),
        ]
    rows += [
        taught_twice("pod_gp", "pod_gp", many, size, size.seeds, asked=STRESS),
        taught_twice("neural_modes", "neural_modes", many, size, size.seeds, asked=("position", "cauchy_stress")),
    ]
    return [trial for row in rows for trial in row]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Heat map, error along the muscle, error over the distance."""
    shown = ("gen_thesis_8", f"gen_thesis_{outcome.size.large**3}", "pod_gp")
    return (
        *heat(outcome, shown, "strict", "mpa", "6.3 b"),
        _along(outcome, (*shown, "neural_modes")),
        far(outcome, (*shown, "neural_modes"), "off_grid", "MPa"),
    )


def rows(outcome: Outcome) -> list[Row]:
    """Those of the trials, and what the printed formula makes of the truth that `strict` tests."""
    cases = outcome.data.cases("ensemble")
    tested = np.unique(split_pairs(cases, "strict").test)
    stress = cases.values("cauchy_stress", tested).astype(np.float64)
    difference = np.abs(_as_printed(stress) - von_mises(stress))
    slip = {"von_mises_mean_mpa": rounded(difference.mean()), "von_mises_max_mpa": rounded(difference.max())}
    relative = rounded(difference.mean() / von_mises(stress).mean())
    return [*table_rows(outcome), {"name": SLIP, "protocol": "strict", **slip, "von_mises_relative": relative}]


def _as_printed(stress: Float[np.ndarray, "*points 6"]) -> Float[np.ndarray, "*points"]:
    x, y, z, yz, xz, xy = np.moveaxis(stress, -1, 0)
    return np.sqrt(0.5 * ((x - y) ** 2 + (x - z) ** 2 + (z - x) ** 2) + 3 * (xy**2 + yz**2 + xz**2))


def _along(outcome: Outcome, names: Sequence[str]) -> Figure:
    """Mean error over the place along the muscle: the insertion, at the forearm, is on the right."""
    reference = outcome.data.cases("ensemble").body.reference
    down = -reference[:, 2]
    place = (down - down.min()) / (down.max() - down.min())
    part = np.minimum((place * PARTS).astype(int), PARTS - 1)
    parts = [number for number in range(PARTS) if (part == number).any()]
    middle = (np.array(parts) + 0.5) / PARTS
    bands = []
    for name in names:
        errors = outcome.array(name, "strict", "node_mpa_strict")
        if errors is not None:
            bands.append(Band(name, middle, np.array([np.nanmean(errors[part == own]) for own in parts])))
    axes = Axes(
        "place along the muscle, from its origin (0) to its insertion (1)", "mean error of von Mises stress [MPa]"
    )
    caption = (
        "Error along the muscle, protocol strict, first seed: the thesis found its largest errors at the tendon's "
        "insertion."
    )
    return Figure(caption, draw_bands(bands, axes), caption)


EXPERIMENT = Experiment(trials, figures, rows)
