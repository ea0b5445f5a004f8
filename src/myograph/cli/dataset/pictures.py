"""Pictures of a store: the one of its card, and a field of a muscle."""

from pathlib import Path

import numpy as np

from myograph.case import MUSCLES
from myograph.ensemble.card.ranges import MuscleScalars, distribution, muscle_scalars
from myograph.ensemble.card.text import FIGURE
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.store.opening import open_cases
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.fields import FIELDS
from myograph.files import write_whole
from myograph.view.dataset import PaintedState, PaintedStates, draw_card, draw_field

SHOWN = "biceps"
"""The muscle of a card, where it is stored; else the first one."""
BINS = 60


def draw_card_figure(store: Path) -> bool:
    """Draw the card's figure into the store; whether there is matplotlib, and any case to draw."""
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        return False
    plan = read_plan(store)
    if not (open_cases(store)["state"].values == "done").any():
        return False
    muscle = SHOWN if SHOWN in plan.muscles else plan.muscles[0]
    field = "von_mises" if "von_mises" in plan.fields else "displacement"
    picture = card_picture(read_muscle(store, muscle), field)
    write_whole(store / FIGURE, lambda file: file.write(picture))
    return True


def card_picture(cases: MuscleCases, field: str) -> bytes:
    """PNG of the answered cases at a glance, the muscle painted by a scalar field."""
    activations = {name: cases.activation[:, k] for k, name in enumerate(MUSCLES)}
    return draw_card(np.degrees(cases.elbow_angle), activations, painted_states(cases, field))


def field_picture(store: Path, muscle: str, field: str | None) -> bytes:
    """A field of a muscle, in two states and as a distribution over all answered cases, design by design.

    Raises InputError for a muscle or a scalar field that is not there, and where there is no answer yet.
    """
    plan, cases = read_plan(store), read_muscle(store, muscle)
    scalars = muscle_scalars(store, plan, muscle)
    name = field or ("von_mises" if "von_mises" in scalars.names else "displacement")
    if name not in scalars.names:
        raise InputError(f"{store}: expected one of the scalar fields {', '.join(scalars.names)}, got '{name}'")
    edges, counts = _distribution(store, scalars, name)
    return draw_field(painted_states(cases, name), edges, counts)


def _distribution(store: Path, scalars: MuscleScalars, name: str) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    cases = open_cases(store)
    done, words = cases["state"].values == "done", cases["design"].values
    groups = {str(word): np.flatnonzero(done & (words == word)).tolist() for word in dict.fromkeys(words[done])}
    return distribution(scalars, groups, name, BINS)


def painted_states(cases: MuscleCases, field: str) -> PaintedStates:
    """A muscle where it is least and where it is most active; `displacement` is from its reference body."""
    own = cases.activation[:, MUSCLES.index(cases.muscle)]
    chosen = list(dict.fromkeys([int(own.argmin()), int(own.argmax())]))
    positions = cases.values("position", np.array(chosen))
    if field == "displacement":
        values = np.linalg.norm(positions - cases.body.reference, axis=-1)
    else:
        values = cases.values(field, np.array(chosen))
    states = [
        PaintedState(_title(cases, case), points, painted)
        for case, points, painted in zip(chosen, positions, values, strict=True)
    ]
    return PaintedStates(states, cases.body.skin, f"{cases.muscle}: {_words(field)}{_unit(field)}")


def _title(cases: MuscleCases, case: int) -> str:
    activation, angle = cases.activation[case, MUSCLES.index(cases.muscle)], np.degrees(cases.elbow_angle[case])
    return f"activation {activation:.2g}" + ("" if np.isnan(angle) else f"\nelbow at {angle:.0f}°")


def _words(field: str) -> str:
    return field.replace("_", " ").replace("mises", "Mises")


def _unit(field: str) -> str:
    unit = FIELDS[field].unit if field in FIELDS else "mm"
    return "" if unit == "1" else f" [{unit}]"
