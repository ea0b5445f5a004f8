"""`myograph ensemble check`: is a store what it says; with `--repair` it is made so."""

from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.ensemble.compute import Where, Workers, compute
from myograph.cli.options import Json, print_json
from myograph.ensemble.simulators import make_bodies
from myograph.ensemble.store.checking import Problem, check_store
from myograph.ensemble.store.lock import locked
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.repairing import forget_damage
from myograph.errors import NotConvergedError


def check(
    store: Annotated[Path, typer.Argument(help="Folder of the store.")],
    repair: Annotated[bool, typer.Option("--repair", help="Compute damaged and missing cases again.")] = False,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Check every array against its checksum, shape, finiteness and mesh.

    Exit code 3 where something is wrong and stays so.
    """
    plan = read_plan(store)
    problems = list(check_store(store, plan))
    left = _repaired(store, problems, workers) if repair and problems else problems
    if json:
        print_json({"ok": not left, "problems": [{"case": one.case, "what": one.what} for one in problems]})
    else:
        for one in problems:
            typer.echo(f"{_place(one)}: {one.what}")
        typer.echo(f"{plan.size} cases: " + ("all is well" if not left else f"{len(left)} problems"))
    if left:
        raise NotConvergedError(f"{store}: {len(left)} problems; 'myograph ensemble check --repair' removes them")


def _repaired(store: Path, problems: list[Problem], workers: int | None) -> list[Problem]:
    """Compute again what is damaged; the problems that are left."""
    plan = read_plan(store)
    with locked(store, 0):
        forget_damage(store, plan, problems, make_bodies(plan.simulator))
    compute(store, Where(workers, None, None, None))
    return list(check_store(store, plan))


def _place(problem: Problem) -> str:
    return "all cases" if problem.case is None else f"case {problem.case}"
