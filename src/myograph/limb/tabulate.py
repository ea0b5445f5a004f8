"""Tables of many muscles, side by side in processes of one thread each.

Progress comes as calls with the muscle's name after every solved state. A table that lies ready in the folder, with
the same key, is taken as it is; each finished table is kept, so that an interrupted run goes on where it was.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.limb.table import FIELDS_IN_TABLE, Grid, MuscleTable, Record, load_table, save_table, table_key
from myograph.processes import side_by_side

Progress = Callable[[str], None]
_COMPONENTS = {"position": (3,), "cauchy_stress": (6,), "fibre_stretch": (), "pressure": ()}
_LONGEST_FIRST = ("triceps", "biceps", "brachialis", "brachioradialis", "anconeus")


def tabulate(arm: Arm, preset: str, grid: Grid, folder: Path, progress: Progress) -> dict[str, MuscleTable]:
    """Table of every muscle, in the order of `MUSCLES`.

    Raises NotConvergedError where a state fails, after all others are solved and kept.
    """
    keys = {name: table_key(arm, name, preset, grid) for name in MUSCLES}
    ready = {name: table for name in MUSCLES if (table := _ready(folder / f"{name}.npz", keys[name])) is not None}
    missing = [name for name in _LONGEST_FIRST if name not in ready]
    for name in ready:
        for _ in range(grid.size):
            progress(name)
    side_by_side(_tabulate_and_save, [(name, arm, preset, grid, folder) for name in missing], progress)
    made = {name: load_table(folder / f"{name}.npz", keys[name]) for name in missing}
    tables = {name: (ready | made)[name] for name in MUSCLES}
    for table in tables.values():
        table.require_complete()
    return tables


def tabulate_muscle(arm: Arm, name: str, preset: str, grid: Grid, progress: Progress) -> MuscleTable:
    """Table of one muscle, in this process; failed states are NaN, with their reasons."""
    from myograph.mechanics.muscle import FailedState, FiniteElementMuscle

    muscle = FiniteElementMuscle(arm, name, preset)
    shape = (len(grid.angles), len(grid.activations))
    moments, steps = np.full(shape, np.nan), np.zeros(shape, dtype=np.int64)
    sound = {key: np.full(shape, np.nan) for key in ("volume_change", "smallest_jacobian", "penetration")}
    reasons = [[""] * shape[1] for _ in range(shape[0])]
    nodes = len(muscle.mesh.points)
    fields = {field: np.full((*shape, nodes, *_COMPONENTS[field]), np.nan) for field in FIELDS_IN_TABLE}
    for k, j, state in muscle.walk(grid.angles, grid.activations):
        if isinstance(state, FailedState):
            reasons[k][j] = state.reason
        else:
            moments[k, j], steps[k, j] = state.moment, state.newton_steps
            for key, values in sound.items():
                values[k, j] = getattr(state.soundness, key)
            for field, values in fields.items():
                values[k, j] = state.fields[field]
        progress(name)
    record = Record(newton_steps=steps, failures=np.array(reasons), **sound)
    key = table_key(arm, name, preset, grid)
    return MuscleTable(name, key, grid, moments, fields, muscle.mesh.points, muscle.mesh.skin, record)


def _ready(path: Path, key: str) -> MuscleTable | None:
    try:
        return load_table(path, key)
    except InputError:
        return None


def _tabulate_and_save(name: str, arm: Arm, preset: str, grid: Grid, folder: Path, progress: Progress) -> None:
    save_table(tabulate_muscle(arm, name, preset, grid, progress), folder / f"{name}.npz")
