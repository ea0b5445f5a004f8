"""The cases of a store computed in this process, one after the other: for small ensembles, without Dask."""

from collections.abc import Callable
from pathlib import Path

from myograph.case import Simulator
from myograph.ensemble.store.aside import sweep
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import states
from myograph.ensemble.store.summary import write_summary
from myograph.ensemble.store.writing import write_failure, write_solution
from myograph.errors import InputError
from myograph.files import refusing


def compute_here(store: Path, simulator: Simulator, advance: Callable[[], None] = lambda: None) -> None:
    """Give every case that has no row yet its row, and sum up; `advance` is called after each.

    The simulator is that of the store's plan. Raises InputError for one that remembers earlier cases, where somebody
    else works on the store, and where it cannot be written.
    """
    plan = read_plan(store)
    if plan.simulator.remembers:
        raise InputError(
            f"{store}: expected a simulator without memory, got '{plan.simulator.kind}'; "
            "run it with 'myograph ensemble run'"
        )
    found = states(store, plan.size)
    with locked(store, sum(state is not None for state in found)), refusing(store):
        sweep(store)
        for number, case in enumerate(plan.design.cases):
            if found[number] is not None:
                continue
            try:
                solution = simulator(case)
            except Exception as problem:
                write_failure(store, plan, number, problem)
            else:
                write_solution(store, plan, number, solution)
            advance()
        write_summary(store, plan)
