"""Fit biceps and triceps to the forces of a published two-muscle upper limb; write what was found into an arm's file.

    python calibration/calibrate.py SAMPLES.csv [--arm FILE.toml] [--preset quick] [--figure calibration.png]

SAMPLES.csv holds one sample a line: elbow angle [degrees], activation, triceps force [N], biceps force [N] (J.
Valentin, PhD thesis 2019, repository valentjn/thesis). Every other sample, by angle and activation, is fitted; the rest
judges. First the curves are fitted in one dimension, on the muscle's line of action (seconds), then the muscle itself
by finite elements: residuals at the preset's size, their derivatives by differences at size tiny. The force of a muscle
is its moment about the elbow over the moment arm of its line of action.

The arm's file keeps its comments; it gets the fitted parameters and a table `calibration` with the relative L2 errors.
"""

import argparse
import sys
import warnings
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from rich.console import Console
from scipy.optimize import least_squares

from myograph.anatomy.body import line_of_action
from myograph.anatomy.load import built_in_arm, load_arm
from myograph.anatomy.model import Arm
from myograph.errors import InputError, MyographError, NotConvergedError
from myograph.files import write_whole
from myograph.limb.tables.solve import FiniteElementStates
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.tabulate import tabulate_muscle
from one_dimension import fit_line
from parameters import values_of, with_values, write_values

COLUMNS = {"triceps": 2, "biceps": 3}
FITTED = {
    "biceps": (
        "tissue.prestretch",
        "belly.passive_stress",
        "belly.passive_exponent",
        "belly.peak_stress",
        "belly.optimal_stretch",
        "belly.width_ascending",
    ),
    "triceps": (
        "tissue.prestretch",
        "belly.passive_stress",
        "belly.knee_strain",
        "belly.peak_stress",
        "belly.optimal_stretch",
        "belly.width_ascending",
    ),
}
SHOWN = TableSpec(most_states=49, held_out=0)
"""Of the table whose curves the figure shows."""
RANGE = 0.4
"""Largest change of a parameter's logarithm in the fit by finite elements."""
STEP = 0.01
"""Relative change of a parameter for the derivatives."""
SOURCE = "J. Valentin, PhD thesis 2019, repository valentjn/thesis: 49 finite-element samples"


def main() -> None:
    """Fit both muscles, write the arm's file, draw the figure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("samples", type=Path)
    parser.add_argument(
        "--arm", type=Path, help="the arm's TOML file to start from and to write; without it nothing is written"
    )
    parser.add_argument("--preset", default="quick", help="size of the muscles whose forces are fitted")
    parser.add_argument("--steps", type=int, default=4, help="most steps of the fit; 0 only judges")
    parser.add_argument(
        "--start", choices=("line", "arm"), default="line", help="from the line of action, or as the arm is"
    )
    parser.add_argument("--figure", type=Path, help="draw forces over angles here, PNG")
    options = parser.parse_args()
    console = Console(stderr=True)
    try:
        samples = read_samples(options.samples)
        arm = load_arm(options.arm) if options.arm else built_in_arm()
        with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
            results = list(pool.map(partial(_fit_muscle, arm, samples, options), COLUMNS))
    except MyographError as error:
        console.print(str(error), style="red")
        sys.exit(error.exit_code)
    for name, (values, _, errors) in zip(COLUMNS, results, strict=True):
        console.print(f"{name}: {values}, relative L2 fitted {errors[0]:.4f}, unseen {errors[1]:.4f}")
        if options.arm:
            write_values(options.arm, name, values, _record(errors, samples, options.preset))
    if options.figure:
        from figure import draw

        tables = {name: result[1] for name, result in zip(COLUMNS, results, strict=True)}
        picture = draw(arm, tables, samples, COLUMNS)
        write_whole(options.figure, lambda file: file.write(picture))


def read_samples(path: Path) -> np.ndarray:
    """Samples sorted by angle and activation; raise InputError for a file that is not such a table."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            samples = np.loadtxt(path, ndmin=2)
    except (OSError, ValueError, UserWarning) as problem:
        raise InputError(f"{path}: expected lines of four numbers ({problem})") from None
    if samples.shape[1] != 4 or len(samples) < 10 or not np.isfinite(samples).all():
        raise InputError(f"{path}: expected at least 10 lines of four finite numbers, got shape {samples.shape}")
    return samples[np.lexsort((samples[:, 1], samples[:, 0]))]


def forces(arm: Arm, name: str, samples: np.ndarray, preset: str) -> np.ndarray:
    """Forces [N] at the samples, each solved: moment over the moment arm of the line of action.

    Raises NotConvergedError for a state that fails.
    """
    line = line_of_action(arm.muscles[name], arm.hinge.frame())
    angles = np.radians(samples[:, 0])
    states = FiniteElementStates(arm, name, preset, lambda _: None)(np.column_stack([angles, samples[:, 1]]))
    for state in states:
        if state.failure:
            raise NotConvergedError(state.failure)
    moments = np.array([state.moment for state in states])
    return moments / np.array([line.moment_arm(angle - arm.reference_angle) for angle in angles])


def _fit_muscle(arm: Arm, samples: np.ndarray, options: argparse.Namespace, name: str):
    keys, published = FITTED[name], np.abs(samples[:, COLUMNS[name]])
    seen = np.arange(len(samples)) % 2 == 0
    cache: dict[tuple, np.ndarray] = {}

    def arm_at(x: np.ndarray) -> Arm:
        return with_values(arm, name, dict(zip(keys, np.exp(x), strict=True)))

    def fitted(x: np.ndarray, preset: str) -> np.ndarray:
        key = (preset, *x.tolist())
        if key not in cache:
            cache[key] = forces(arm_at(x), name, samples[seen], preset)
        return cache[key]

    def residual(x: np.ndarray, preset: str = options.preset) -> np.ndarray:
        error = (fitted(x, preset) - published[seen]) / np.linalg.norm(published[seen])
        Console(stderr=True).print(f"{name} {preset}: {np.exp(x).round(4)} relative L2 {np.linalg.norm(error):.4f}")
        return error

    def jacobian(x: np.ndarray) -> np.ndarray:
        here = residual(x, "tiny")
        return np.stack([residual(x + STEP * unit, "tiny") - here for unit in np.eye(len(x))], axis=1) / STEP

    here = values_of(arm, name, keys)
    from_line = options.steps and options.start == "line"
    found = start = np.log(fit_line(arm, name, samples[seen], published[seen], here) if from_line else [*here.values()])
    if options.steps:
        low = np.where(np.array(keys) == "belly.passive_exponent", 0.0, start - RANGE)
        found = least_squares(residual, start, jac=jacobian, max_nfev=options.steps, bounds=(low, start + RANGE)).x
    ours = forces(arm_at(found), name, samples, options.preset)
    errors = [
        float(np.linalg.norm((ours - published)[part]) / np.linalg.norm(published[part])) for part in (seen, ~seen)
    ]
    table = tabulate_muscle(arm_at(found), name, options.preset, SHOWN, lambda _: None) if options.figure else None
    return dict(zip(keys, np.exp(found).round(5).tolist(), strict=True)), table, errors


def _record(errors: list[float], samples: np.ndarray, preset: str) -> dict:
    return {
        "source": SOURCE,
        "preset": preset,
        "samples_fitted": (len(samples) + 1) // 2,
        "samples_unseen": len(samples) // 2,
        "error_fitted": round(errors[0], 4),
        "error_unseen": round(errors[1], 4),
    }


if __name__ == "__main__":
    main()
