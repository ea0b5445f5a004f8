"""Where the tables of a store lie: noted in its provenance, for they may move; what they say is part of the plan.

Tables beside the store are noted as `../NAME`, so that both may move together; others with their whole path.
"""

from dataclasses import replace
from pathlib import Path

from myograph.ensemble.simulators import describe_simulator
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.plan import StorePlan
from myograph.ensemble.store.provenance import add_provenance, provenance
from myograph.errors import InputError

_NOTE = "tables"


def note(store: Path, tables: str | None) -> dict[str, str]:
    """What the provenance of a store says of its tables."""
    if tables is None:
        return {}
    folder = Path(tables).resolve()
    return {_NOTE: f"../{folder.name}" if folder.parent == store.resolve().parent else str(folder)}


def noted_tables(store: Path, plan: StorePlan) -> Path | None:
    """Where the tables lay when the store was last computed; None where it needs none, or does not say."""
    told = provenance(store).get(_NOTE) or plan.simulator.tables
    return None if told is None else (store.resolve() / told).resolve()


def simulator_of(store: Path, plan: StorePlan, asked: Path | None) -> SimulatorSpec:
    """The simulator of a store with its tables where they lie now: in the asked folder, else where they were.

    Raises InputError where there are none, and where the asked ones are not those that the store was made with.
    """
    noted = noted_tables(store, plan)
    folder = noted if asked is None else asked.resolve()
    if plan.described.get("tables") and (folder is None or not folder.is_dir()):
        place = "" if folder is None else f" at {folder}"
        raise InputError(f"{store}: expected the tables it was made with, found none{place}; say where with --tables")
    if folder is None:
        return plan.simulator
    spec = replace(plan.simulator, tables=str(folder))
    if folder != noted and describe_simulator(spec) != plan.described:
        raise InputError(f"{folder}: expected the tables that {store} was made with, got others; take another folder")
    return spec


def note_tables(store: Path, tables: str | None) -> None:
    """Remember where the tables lie now; raises OSError without room."""
    told = note(store, tables)
    if told.items() - provenance(store).items():
        add_provenance(store, told)
