"""The numbers of all cases of a store as a CSV file: what was asked, what became of it, and how far its muscles went.

A row for each case, failed and missing ones too. Columns: case, state, design, activations by muscle's name,
`hand_load_n`, `prescribed_angle_deg`, `elbow_angle_deg`, `moment_nm_MUSCLE`; then for each stored muscle
the least, mean and largest value over its nodes of `displacement` and of every scalar field, such as
`biceps_von_mises_max_mpa`.
"""

import csv
import io
from pathlib import Path

import numpy as np

from myograph.case import MUSCLES
from myograph.ensemble.card.ranges import MuscleScalars, muscle_scalars
from myograph.ensemble.store.opening import open_cases
from myograph.ensemble.store.plan import read_plan
from myograph.export.target import write_place
from myograph.fields import FIELDS
from myograph.units import NEWTON_MM_PER_NEWTON_METRE

BEGINNING = "case,state,design,"
Row = dict[str, str]


def write_csv(path: Path, store: Path) -> int:
    """Write the file; gives back the number of cases. Raises InputError where it cannot be read or written."""
    plan = read_plan(store)
    rows = _asked(store)
    for scalars in [muscle_scalars(store, plan, muscle) for muscle in plan.muscles]:
        for case, row in enumerate(rows):
            row |= _summary(scalars, case) if row["state"] == "done" else {}
    names = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_place(path, BEGINNING.encode(), lambda place: place.write_text(text.getvalue(), encoding="utf-8"))
    return len(rows)


def _asked(store: Path) -> list[Row]:
    """What is asked of each case and what the arm answered; empty where there is no number."""
    cases = open_cases(store)
    columns = {
        **{name: cases["activation"].values[:, k] for k, name in enumerate(MUSCLES)},
        "hand_load_n": cases["hand_load"].values,
        "prescribed_angle_deg": np.degrees(cases["prescribed_angle"].values),
        "elbow_angle_deg": np.degrees(cases["elbow_angle"].values),
        **{
            f"moment_nm_{name}": cases["moment"].values[:, k] / NEWTON_MM_PER_NEWTON_METRE
            for k, name in enumerate(MUSCLES)
        },
    }
    words = zip(cases["state"].values.tolist(), cases["design"].values.tolist(), strict=True)
    return [
        {"case": str(case), "state": state, "design": word}
        | {name: _text(values[case]) for name, values in columns.items()}
        for case, (state, word) in enumerate(words)
    ]


def _summary(scalars: MuscleScalars, case: int) -> Row:
    row = {}
    for name, values in scalars.read(case, scalars.names).items():
        unit = {"1": "", "mm": "_mm", "MPa": "_mpa"}[FIELDS[name].unit if name in FIELDS else "mm"]
        for word, value in (("min", values.min()), ("mean", values.mean(dtype=float)), ("max", values.max())):
            row[f"{scalars.muscle}_{name}_{word}{unit}"] = _text(float(value))
    return row


def _text(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.9g}"
