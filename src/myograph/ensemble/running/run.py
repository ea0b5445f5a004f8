"""Run an ensemble: make the store or go on with it, compute what is missing, sum up."""

import os
import threading
import time
from dataclasses import dataclass, replace
from pathlib import Path

from myograph.ensemble.card.text import FIGURE
from myograph.ensemble.card.writing import CARD, add_cost, write_card
from myograph.ensemble.running.batch import Task
from myograph.ensemble.running.chains import batches
from myograph.ensemble.running.cluster import connected
from myograph.ensemble.running.drive import Batch, Drive
from myograph.ensemble.running.listener import NOBODY, Listener
from myograph.ensemble.running.lost import PlaceLostError
from myograph.ensemble.running.plugin import solvers
from myograph.ensemble.store.aside import sweep
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.repairing import forget_case
from myograph.ensemble.store.rows import states
from myograph.ensemble.store.summary import write_summary
from myograph.ensemble.store.tables import note_tables, simulator_of
from myograph.errors import InputError
from myograph.files import refusing

_CLUSTERS = 3
"""How many clusters are started, each where the one before lost all its workers, or its scheduler."""


@dataclass(frozen=True)
class RunOptions:
    """How to run; none of it changes what is computed.

    Parameters
    ----------
    workers
        Local processes; None: as many as processors.
    scheduler
        Address of a Dask scheduler that runs already.
    slurm
        TOML file of `SlurmConfig`.
    seconds
        A case that takes longer [s] has failed.
    retries
        How often a case is tried again when its process is lost.
    again
        Whether cases that failed in an earlier run are tried again.
    tables
        Folder of the tables, where they do not lie any more where they were.
    """

    workers: int | None = None
    scheduler: str | None = None
    slurm: Path | None = None
    seconds: float | None = None
    retries: int = 3
    again: bool = False
    tables: Path | None = None

    def __post_init__(self) -> None:
        if self.workers is not None and self.workers < 1:
            raise InputError(f"workers: expected at least 1, got {self.workers}")
        if self.scheduler is not None and self.slurm is not None:
            raise InputError("expected either a scheduler's address or a SLURM configuration, got both")
        if self.seconds is not None and not 0 < self.seconds <= threading.TIMEOUT_MAX:
            raise InputError(f"time limit: expected a positive number of seconds, got {self.seconds:g}; leave it out")
        if self.retries < 0:
            raise InputError(f"retries: expected at least 0, got {self.retries}")


def run_store(store: Path, options: RunOptions, listener: Listener = NOBODY) -> dict[str, float | int | str]:
    """Compute all cases that have no row yet; those that failed have one.

    Returns the numbers of cases, done and failed ones, seconds and the store. Raises InputError where somebody else
    works on the store, where it cannot be written, where the simulator or its tables are not there, and where workers
    or the scheduler are lost again and again.
    """
    started = time.perf_counter()
    plan = read_plan(store)
    with locked(store, sum(state is not None for state in states(store, plan.size))), refusing(store):
        sweep(store)
        wanted = {None, "failed"} if options.again else {None}
        if wanted & set(states(store, plan.size)):
            plan = replace(plan, simulator=simulator_of(store, plan, options.tables))
        if options.again:
            _forget_failed(store, plan)
        todo = missing(store, plan)
        if todo:
            for name in (CARD, FIGURE):
                (store / name).unlink(missing_ok=True)
            _run(store, plan, (options, listener), todo)
        _sum_up(store, plan, time.perf_counter() - started if todo else 0.0)
    found = states(store, plan.size)
    return {
        "cases": plan.size,
        "done": found.count("done"),
        "failed": found.count("failed"),
        "seconds": time.perf_counter() - started,
        "store": str(store),
    }


def _forget_failed(store: Path, plan: StorePlan) -> None:
    for case, state in enumerate(states(store, plan.size)):
        if state == "failed":
            forget_case(store, plan, case)


def missing(store: Path, plan: StorePlan) -> list[Batch]:
    """The batches with a case that has no row."""
    found = states(store, plan.size)
    groups = batches(plan.design.cases, plan.simulator.remembers)
    return [batch for batch in groups if any(found[case] is None for case in batch)]


def _run(store: Path, plan: StorePlan, how: tuple[RunOptions, Listener], todo: list[Batch]) -> None:
    options, listener = how
    note_tables(store, plan.simulator.tables)
    task = Task(str(store.resolve()), plan.simulator, options.seconds, options.retries)
    workers, lost = min(options.workers or os.cpu_count() or 1, len(todo)), ""
    for turn in range(_CLUSTERS):
        told = _counted(listener, plan.size - sum(map(len, todo)))
        try:
            with (
                connected(workers, options.scheduler, options.slurm) as place,
                solvers(place.client, task) as name,
            ):
                listener.dashboard(place.client.dashboard_link or "")
                Drive(place, name, store, told, seen=turn > 0).run(todo)
            return
        except PlaceLostError as problem:
            lost, todo = str(problem), missing(store, plan)
    raise InputError(f"{store}: the run was stopped {_CLUSTERS} times: {lost}; see to the workers and run it again")


def _counted(listener: Listener, before: int) -> Listener:
    """The listener, told the number of all cases that have a row: those of this run and those from before."""
    return replace(listener, ready=lambda count: listener.ready(before + count))


def _sum_up(store: Path, plan: StorePlan, seconds: float) -> None:
    """Write what all cases have in common: their numbers, what they cost [s], and the card."""
    write_summary(store, plan)
    if seconds:
        add_cost(store, seconds)
    if not (store / CARD).exists():
        write_card(store)
