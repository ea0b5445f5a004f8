"""What a film shows: a panel for each image, of a model's movement or of the cases of a dataset."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Int

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.cli.arm_model import MOST_STATES, is_dataset
from myograph.cli.solids import bone_solids, model_solid, solid_of
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.export.gltf import Keys
from myograph.inference.truth import read_truth
from myograph.view.page.source import ArmModels
from myograph.view.picture import Panel, Solid

Shown = tuple[str, bool]
"""The field that is shown, and whether the bones are."""


@dataclass(frozen=True)
class Reel:
    """The images of a film: their number, and what the k-th shows."""

    name: str
    muscles: tuple[str, ...]
    count: int
    panel: Callable[[int], Panel]


def movement_reel(models: ArmModels, keys: Keys, shown: Shown) -> Reel:
    """The movement of a model, in its own time."""
    field, bones = shown
    muscles = models.muscles.values()

    def panel(k: int) -> Panel:
        row = keys.activations[k]
        angle = next(iter(muscles)).elbow_angle(row, keys.hand_load)
        outside = "" if all(one.inside(row, keys.hand_load) for one in muscles) else "\nOUTSIDE the training"
        solids = [model_solid(one, row, keys.hand_load, field) for one in muscles]
        drawn = bone_solids(models.arm, angle) if bones else []
        return Panel(f"{keys.times[k]:.2f} s{_elbow(angle)}{outside}", [*drawn, *solids])

    return Reel(models.name, tuple(models.muscles), len(keys.times), panel)


def is_cases(named: str | None) -> bool:
    """Whether it is the folder of a store, or a file of one muscle's cases."""
    return is_dataset(named) or (named is not None and named.endswith(".npz"))


def read_cases(source: Path, muscles: list[str] | None) -> Mapping[str, MuscleCases]:
    """The cases of some or all muscles; raises InputError where there are none."""
    if source.suffix == ".npz":
        found = read_truth(source)
        if muscles and found.muscle not in muscles:
            raise InputError(f"{source}: expected cases of {', '.join(muscles)}, got those of {found.muscle}")
        return {found.muscle: found}
    return {name: read_muscle(source, name) for name in muscles or read_plan(source).muscles}


def cases_reel(
    name: str, cases: Mapping[str, MuscleCases], order: Int[np.ndarray, " some"], how: Shown, arm: Arm
) -> Reel:
    """Cases in this order; bones where these were computed with this arm."""
    field, bones = how
    first = next(iter(cases.values()))
    same = first.attributes.get("arm_checksum", "") == arm_checksum(arm)
    rest = {muscle: _at_rest(one) for muscle, one in cases.items()} if field == "displacement" else {}

    def panel(k: int) -> Panel:
        number = int(order[k])
        solids = [_solid(one, number, field, rest.get(muscle)) for muscle, one in cases.items()]
        angle = float(first.elbow_angle[number])
        drawn = bone_solids(arm if same and bones else None, angle)
        return Panel(f"case {number}{_elbow(angle)}", [*drawn, *solids])

    return Reel(name, tuple(cases), len(order), panel)


def case_order(cases: Mapping[str, MuscleCases], asked: list[int] | None, by_angle: bool) -> Int[np.ndarray, " some"]:
    """The cases that are asked, or all; as they are, or from the straightest elbow on. Raises InputError for others."""
    first = next(iter(cases.values()))
    order = np.arange(len(first)) if not asked else np.array(asked)
    if not 0 <= order.min() <= order.max() < len(first):
        raise InputError(f"--case: expected cases from 0 to {len(first) - 1}, got {', '.join(map(str, asked or []))}")
    if len(order) > MOST_STATES:
        raise InputError(f"expected at most {MOST_STATES} cases in a film, got {len(order)}; choose some with --case")
    return order[np.argsort(first.elbow_angle[order], kind="stable")] if by_angle else order


def _solid(cases: MuscleCases, number: int, field: str, rest: np.ndarray | None) -> Solid:
    one = np.array([number])
    fields = {key: cases.values(key, one)[0] for key in {"position", *({field} & set(cases.fields))}}
    if rest is not None:
        fields["displacement"] = np.linalg.norm(fields["position"] - rest, axis=1)
    return solid_of(cases.muscle, fields, cases.body.skin, field)


def _at_rest(cases: MuscleCases) -> np.ndarray:
    return cases.values("position", cases.activation.sum(axis=1).argmin(keepdims=True))[0]


def _elbow(angle: float | None) -> str:
    return "" if angle is None or not np.isfinite(angle) else f", elbow {np.degrees(angle):.0f}°"
