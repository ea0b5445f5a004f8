"""`myograph ensemble check`: is a store what it says; with `--repair` it is made so."""

from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.ensemble.compute import Tables, Where, Workers, compute, run_options
from myograph.cli.options import Json, print_json
from myograph.ensemble.simulators import make_bodies
from myograph.ensemble.store.checking import Problem, check_store
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.repairing import forget_damage
from myograph.errors import NotConvergedError
from myograph.files import refusing


def check(
    store: Annotated[Path, typer.Argument(help="Folder of the store.")],
    repair: Annotated[bool, typer.Option("--repair", help="Compute damaged and missing cases again.")] = False,
    workers: Workers = None,
    tables: Tables = None,
    json: Json = False,
) -> None:
    """Check every array against its checksum, shape, finiteness and mesh.

    Exit code 3 where something is wrong and stays so.
    """
    plan = read_plan(store)
    if repair:
        problems, left = _repaired(store, Where(workers, tables=tables))
    else:
        problems = left = list(check_store(store, plan))
    if json:
        print_json({"ok": not left, "problems": [{"case": one.case, "what": one.what} for one in problems]})
    else:
        for one in problems:
            typer.echo(f"{_place(one)}: {one.what}")
        typer.echo(f"{plan.size} cases: " + ("all is well" if not left else f"{len(left)} problems"))
    if left:
        raise NotConvergedError(f"{store}: {len(left)} problems; 'myograph ensemble check --repair' removes them")


def _repaired(store: Path, where: Where) -> tuple[list[Problem], list[Problem]]:
    """Compute again what is damaged; the problems that there were, found while nobody else worked, and those left."""
    plan, options = read_plan(store), run_options(where)
    with locked(store, 0), refusing(store):
        found = list(check_store(store, plan))
        if not found:
            return [], []
        again = any(not one.summed_up for one in found)
        forget_damage(store, plan, found, make_bodies(plan.simulator) if again else {})
    compute(store, options)
    return found, list(check_store(store, plan))


def _place(problem: Problem) -> str:
    return "all cases" if problem.case is None else f"case {problem.case}"
