"""The tables of all muscles in one folder, checked to belong together and to an arm."""

from pathlib import Path

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.limb.tables.provenance import table_key
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.table_file import load_table, table_path


def load_tables(folder: Path, arm: Arm, preset: str | None = None) -> dict[str, MuscleTable]:
    """Complete tables of all muscles of an arm, of one preset: the asked one, or that of the first.

    Raises InputError for a table that is missing, damaged, of another arm or of another preset, NotConvergedError for
    one with failed states.
    """
    tables: dict[str, MuscleTable] = {}
    for name in MUSCLES:
        path = table_path(folder, name)
        table = load_table(path)
        preset = preset or table.preset
        if table.preset != preset or table.key != table_key(arm, name, table.preset, table.spec):
            raise InputError(
                f"{path}: expected a table of this arm of preset '{preset}', got one of another arm or version,"
                f" or of preset '{table.preset}'; take another folder, or build it anew"
            )
        table.require_complete()
        tables[name] = table
    return tables
