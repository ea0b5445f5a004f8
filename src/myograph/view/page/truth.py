"""Cases of a dataset that the page compares the model with: an even choice, of continuous activations if it has any."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.inference.low_rank import LowRankMuscle
from myograph.inference.truth import read_truth
from myograph.view.page.solving import SolveTime, solve_time

MOST_CASES = 12
PREFERRED = ("off_grid", "factorial")
SAME_PLACE = 1e-2
"""How far [mm] the reference bodies of dataset and model may be apart."""


@dataclass(frozen=True)
class TruthCase:
    """A case; positions [mm] and, where there is some, von Mises stress [MPa] of each muscle that the dataset has.

    `solve` is how long its solver takes for a case, where the dataset tells.
    """

    name: str
    activation: Float[np.ndarray, " muscles"]
    hand_load: float
    elbow_angle: float | None
    positions: Mapping[str, Float[np.ndarray, "nodes 3"]]
    stresses: Mapping[str, Float[np.ndarray, " nodes"]]
    solve: SolveTime | None = None


def read_truth_cases(dataset: Path, muscles: Mapping[str, LowRankMuscle], most: int = MOST_CASES) -> list[TruthCase]:
    """Some cases of a store, of a file of one muscle's cases, or of a folder of such files (MUSCLE.npz).

    Raises InputError where there are none of these muscles, or where their bodies are not the models'.
    """
    found = _read(dataset, tuple(muscles))
    if not found:
        raise InputError(f"{dataset}: expected cases of {', '.join(muscles)}, found none")
    for name, cases in found.items():
        _check_body(dataset, cases, muscles[name])
    first = next(iter(found.values()))
    if any(not np.array_equal(cases.activation, first.activation) for cases in found.values()):
        raise InputError(f"{dataset}: expected the same cases of all muscles, got different ones")
    return [_case(number, found) for number in _chosen(first, most).tolist()]


def _read(dataset: Path, muscles: tuple[str, ...]) -> dict[str, MuscleCases]:
    if not dataset.exists():
        raise InputError(f"{dataset}: expected the folder of a dataset, found nothing there")
    if dataset.suffix == ".npz":
        cases = read_truth(dataset)
        return {cases.muscle: cases} if cases.muscle in muscles else {}
    files = {name: dataset / f"{name}.npz" for name in muscles}
    if any(path.is_file() for path in files.values()):
        return {name: read_truth(path) for name, path in files.items() if path.is_file()}
    known = read_plan(dataset).muscles
    return {name: read_muscle(dataset, name) for name in muscles if name in known}


def _check_body(dataset: Path, cases: MuscleCases, muscle: LowRankMuscle) -> None:
    theirs, ours = cases.body.reference, muscle.reference
    if theirs.shape != ours.shape or not np.allclose(theirs, ours, rtol=0, atol=SAME_PLACE):
        raise InputError(
            f"{dataset}: expected the body of {muscle.muscle} that the model knows, of {len(ours)} nodes; got another"
            f" one of {len(theirs)} nodes; give the dataset of the same arm and preset"
        )


def _chosen(cases: MuscleCases, most: int) -> Int[np.ndarray, " some"]:
    named = next((found for word in PREFERRED if len(found := cases.named(word))), np.arange(len(cases)))
    return named[np.unique(np.linspace(0, len(named) - 1, min(most, len(named))).astype(int))]


def _case(number: int, found: Mapping[str, MuscleCases]) -> TruthCase:
    first = next(iter(found.values()))
    angle, one = float(first.elbow_angle[number]), np.array([number])
    written = " ".join(f"{value:.2f}" for value in first.activation[number])
    return TruthCase(
        f"{first.design[number]} {number}: {written}",
        first.activation[number],
        float(first.hand_load[number]),
        angle if np.isfinite(angle) else None,
        {name: cases.values("position", one)[0] for name, cases in found.items()},
        {name: cases.values("von_mises", one)[0] for name, cases in found.items() if "von_mises" in cases.fields},
        solve_time(first),
    )
