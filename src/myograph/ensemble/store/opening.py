"""A store as `xarray` datasets: read lazily, also while it is being written.

`open_muscle` has these variables (units in their attributes, from `myograph.fields`):

    activation, moment              (cases, muscles)      in the order of `myograph.MUSCLES`, the coordinate `muscles`
    hand_load, prescribed_angle     (cases,)              N, rad; NaN where the arm finds its equilibrium
    elbow_angle                     (cases,)              rad
    design, state                   (cases,)              where the case comes from; 'done', 'failed' or 'missing'
    position                        (cases, nodes, axes)  mm
    cauchy_stress                   (cases, nodes, voigt) MPa
    von_mises, pressure             (cases, nodes)        MPa
    fibre_stretch                   (cases, nodes)
    reference_position              (nodes, axes)         material coordinates X, mm
    surface_quads, connectivity     node indices of the skin, outward normal, and of the elements
    sensor_nodes                    the standard sensors

A case that failed, or has not been computed yet, is NaN in every field; one whose run was killed may have some fields
already, its `state` is 'missing' all the same. Learning reads a store by
`myograph.ensemble.store.reading.read_muscle`.
"""

from pathlib import Path

import numpy as np
import xarray as xr

from myograph.case import MUSCLES
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.provenance import provenance
from myograph.ensemble.store.rows import Row, read_row
from myograph.errors import InputError
from myograph.fields import AXES, FIELDS, VOIGT

STATES = ("missing", "done", "failed")
"""The meanings of the codes 0, 1, 2 on disk."""


def open_muscle(store: Path, muscle: str) -> xr.Dataset:
    """The dataset of one muscle; its fields are read when they are used.

    Raises InputError where there is no store, a damaged one, or one without this muscle.
    """
    plan = read_plan(store)
    if muscle not in plan.muscles:
        raise InputError(f"{store}: expected one of {', '.join(plan.muscles)}, got '{muscle}'")
    try:
        fields = xr.open_zarr(store, group=muscle, consolidated=False, chunks=None, mask_and_scale=False)
    except Exception as problem:
        raise InputError(f"{store}: '{muscle}' cannot be read: {problem}; see 'myograph ensemble check'") from None
    cases = open_cases(store)
    coordinates = {"muscles": list(MUSCLES), "axes": list(AXES), "voigt": list(VOIGT)}
    return fields.merge(cases, combine_attrs="drop_conflicts").assign_coords(coordinates)


def open_cases(store: Path) -> xr.Dataset:
    """What is asked and what became of it, without fields; a damaged row counts as missing."""
    plan = read_plan(store)
    dataset = cases_dataset(plan, [readable_row(store, case) for case in range(plan.size)])
    words = np.array(plan.design.words)
    named = np.array(STATES)[dataset["state"].values]
    attributes = {"simulator": plan.simulator.kind, "identity": plan.identity, **provenance(store)}
    return dataset.assign(design=("cases", words), state=("cases", named)).assign_attrs(attributes)


def reasons(store: Path) -> dict[int, str]:
    """The failed cases and why."""
    rows = (readable_row(store, case) for case in range(read_plan(store).size))
    return {row.case: row.reason for row in rows if row is not None and row.state == "failed"}


def cases_dataset(plan: StorePlan, rows: list[Row | None]) -> xr.Dataset:
    """All cases in numbers, as they lie on disk; words are codes with their meanings (CF conventions)."""
    cases, words = plan.design.cases, sorted(set(plan.design.words))
    missing = Row(-1, "failed")
    angles = [np.nan if row is None or row.elbow_angle is None else row.elbow_angle for row in rows]
    moments = [[(row or missing).moments.get(name, np.nan) for name in MUSCLES] for row in rows]
    codes = [STATES.index("missing" if row is None else row.state) for row in rows]
    prescribed = [np.nan if case.elbow_angle is None else case.elbow_angle for case in cases]
    data = {
        "activation": _variable("activation", ("cases", "muscles"), [case.activations for case in cases]),
        "hand_load": _variable("hand_load", ("cases",), [case.hand_load for case in cases]),
        "prescribed_angle": xr.Variable(
            ("cases",),
            np.array(prescribed, dtype="<f8"),
            {"units": "rad", "long_name": "asked elbow flexion; NaN where the arm finds its equilibrium"},
        ),
        "elbow_angle": _variable("elbow_angle", ("cases",), angles),
        "moment": _variable("moment", ("cases", "muscles"), moments),
        "state": _coded(codes, STATES),
        "design": _coded([words.index(word) for word in plan.design.words], tuple(words)),
    }
    return xr.Dataset(data, attrs={"muscles": " ".join(MUSCLES)})


def _variable(name: str, names: tuple[str, ...], values: object) -> xr.Variable:
    attributes = {"units": FIELDS[name].unit, "long_name": FIELDS[name].meaning}
    return xr.Variable(names, np.array(values, dtype="<f8"), attributes)


def _coded(codes: list[int], meanings: tuple[str, ...]) -> xr.Variable:
    attributes = {"flag_values": list(range(len(meanings))), "flag_meanings": " ".join(meanings)}
    return xr.Variable(("cases",), np.array(codes, dtype="<i4"), attributes)


def readable_row(store: Path, case: int) -> Row | None:
    """The row of a case; None where it has none yet, or a damaged one."""
    try:
        return read_row(store, case)
    except InputError:
        return None
