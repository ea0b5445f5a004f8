"""The tables that an ensemble needs: those in a folder, or new ones."""

from pathlib import Path

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES
from myograph.cli.table import build_tables
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table_file import table_path
from myograph.mesh.presets import resolution


def tables_ready(arm: Arm, preset: str, folder: Path) -> None:
    """Build the tables that are missing in the folder; those that are there are checked when they are used.

    Raises InputError for an unknown preset, NotConvergedError where a state fails.
    """
    resolution(preset)
    names = [name for name in MUSCLES if not table_path(folder, name).exists()]
    if names:
        for table in build_tables(arm, preset, TableSpec(), folder, names).values():
            table.require_complete()
