"""Run an ensemble: make the store or go on with it, compute what is missing, sum up."""

import os
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from myograph.ensemble.card.text import FIGURE
from myograph.ensemble.card.writing import CARD, add_cost, write_card
from myograph.ensemble.running.batch import Task
from myograph.ensemble.running.chains import batches
from myograph.ensemble.running.cluster import connected
from myograph.ensemble.running.drive import Batch, Drive, NoWorkersError
from myograph.ensemble.running.plugin import SolverPlugin
from myograph.ensemble.store.aside import sweep
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.plan import StorePlan, read_plan
from myograph.ensemble.store.repairing import forget_case
from myograph.ensemble.store.rows import states
from myograph.ensemble.store.summary import write_summary
from myograph.errors import InputError

Progress = Callable[[int], None]
_CLUSTERS = 3
"""How many clusters are started, each where the one before lost all its workers."""


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
    """

    workers: int | None = None
    scheduler: str | None = None
    slurm: Path | None = None
    seconds: float | None = None
    retries: int = 3
    again: bool = False

    def __post_init__(self) -> None:
        if self.workers is not None and self.workers < 1:
            raise InputError(f"workers: expected at least 1, got {self.workers}")
        if self.seconds is not None and not self.seconds > 0:
            raise InputError(f"time limit: expected a positive number of seconds, got {self.seconds:g}")
        if self.retries < 0:
            raise InputError(f"retries: expected at least 0, got {self.retries}")


@dataclass(frozen=True)
class Listener:
    """What a run tells while it works: cases that have a row, and the address of Dask's dashboard."""

    ready: Progress = lambda _: None
    dashboard: Callable[[str], None] = lambda _: None


def run_store(store: Path, options: RunOptions, listener: Listener = Listener()) -> dict[str, float | int | str]:
    """Compute all cases that have no row yet; those that failed have one.

    Returns the numbers of cases, done and failed ones, seconds and the store. Raises InputError where somebody else
    works on the store, where it cannot be written, and where the simulator cannot be made.
    """
    started = time.perf_counter()
    plan = read_plan(store)
    with locked(store, sum(state is not None for state in states(store, plan.size))):
        sweep(store)
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
    task = Task(str(store.resolve()), plan.simulator, options.seconds, options.retries)
    workers = min(options.workers or os.cpu_count() or 1, len(todo))
    for _ in range(_CLUSTERS):
        name = f"myograph-{uuid.uuid4().hex}"
        before = plan.size - sum(map(len, todo))
        try:
            with connected(workers, options.scheduler, options.slurm) as client:
                listener.dashboard(client.dashboard_link or "")
                client.register_plugin(SolverPlugin(task, name), name=name)
                try:
                    Drive(client, name, store, lambda count, before=before: listener.ready(before + count)).run(todo)
                finally:
                    client.unregister_worker_plugin(name)
            return
        except NoWorkersError:
            todo = missing(store, plan)
    raise InputError(f"{store}: all workers were lost, {_CLUSTERS} times; run it again with fewer of them")


def _sum_up(store: Path, plan: StorePlan, seconds: float) -> None:
    """Write what all cases have in common: their numbers, what they cost [s], and the card."""
    try:
        write_summary(store, plan)
        if seconds:
            add_cost(store, seconds)
        if not (store / CARD).exists():
            write_card(store)
    except OSError as problem:
        raise InputError(f"{store}: cannot be written ({problem.strerror}); free some room and run it again") from None
