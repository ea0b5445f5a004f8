"""Tables of many muscles, side by side in processes of one thread each.

Progress comes as calls with the muscle's name after every state. A table that lies ready in the folder, with the same
key, is taken as it is; so is every state that an earlier run solved and kept, so that an interrupted run goes on where
it was.
"""

from collections.abc import Sequence
from pathlib import Path

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES, check_muscle
from myograph.errors import InputError
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.provenance import table_key
from myograph.limb.tables.solve import FiniteElementStates, Progress, states_folder
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.state import StateStore
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.table_file import load_table, save_table, table_path
from myograph.processes import side_by_side

_LONGEST_FIRST = ("triceps", "biceps", "brachialis", "brachioradialis", "anconeus")


def tabulate(
    arm: Arm,
    preset: str,
    spec: TableSpec,
    folder: Path,
    progress: Progress,
    muscles: Sequence[str] = MUSCLES,
) -> dict[str, MuscleTable]:
    """Tables of muscles, in the order of `MUSCLES`; one with failed states says so when it is used.

    Raises InputError for an unknown muscle and for a folder that cannot be written.
    """
    wanted = [name for name in MUSCLES if name in {check_muscle(name) for name in muscles}]
    ready = {name: table for name in wanted if (table := _ready(arm, name, preset, spec, folder)) is not None}
    for name in ready:
        for _ in range(spec.most):
            progress(name)
    missing = [name for name in _LONGEST_FIRST if name in wanted and name not in ready]
    try:
        side_by_side(_tabulate_and_save, [(arm, name, preset, spec, folder) for name in missing], progress)
    finally:
        for name in missing:
            StateStore(states_folder(folder, name), "").sweep()
    keys = {name: table_key(arm, name, preset, spec) for name in missing}
    made = {name: load_table(table_path(folder, name), key) for name, key in keys.items()}
    return {name: (ready | made)[name] for name in wanted}


def tabulate_muscle(
    arm: Arm, name: str, preset: str, spec: TableSpec, progress: Progress, folder: Path | None = None
) -> MuscleTable:
    """Table of one muscle, in this process; its states are kept in a folder, if one is given."""
    return built(FiniteElementStates(arm, name, preset, progress, folder), spec)


def _ready(arm: Arm, name: str, preset: str, spec: TableSpec, folder: Path) -> MuscleTable | None:
    try:
        table = load_table(table_path(folder, name), table_key(arm, name, preset, spec))
    except InputError:
        return None
    return None if table.failures else table


def _tabulate_and_save(arm: Arm, name: str, preset: str, spec: TableSpec, folder: Path, progress: Progress) -> None:
    save_table(tabulate_muscle(arm, name, preset, spec, progress, folder), table_path(folder, name))
