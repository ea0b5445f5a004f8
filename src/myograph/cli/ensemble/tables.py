"""The tables that an ensemble needs: those in a folder, or new ones."""

from pathlib import Path

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES
from myograph.cli.progress import Steps
from myograph.errors import MissingPackageError
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table_file import table_path
from myograph.mesh.presets import resolution


def tables_ready(arm: Arm, preset: str, folder: Path) -> None:
    """Build the tables that are missing in the folder; those that are there are checked when they are used.

    Raises InputError for an unknown preset, NotConvergedError where a state fails.
    """
    resolution(preset)
    names = [name for name in MUSCLES if not table_path(folder, name).exists()]
    if not names:
        return
    try:
        import myograph.mechanics.muscle  # noqa: F401
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "simulate", "building tables") from None
    from myograph.limb.tables.tabulate import tabulate

    spec = TableSpec()
    with Steps().bars("states, at most", dict.fromkeys(names, spec.most)) as advance:
        tables = tabulate(arm, preset, spec, folder, advance, names)
    for table in tables.values():
        table.require_complete()
