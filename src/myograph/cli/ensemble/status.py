"""`myograph ensemble status`: how far a store is."""

import time
from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.options import Json, print_json
from myograph.ensemble.store.lock import is_locked, runner
from myograph.ensemble.store.opening import reasons
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import states


def status(store: Annotated[Path, typer.Argument(help="Folder of the store.")], json: Json = False) -> None:
    """Say how many cases are done, failed and missing, whether somebody works on them, and the time left."""
    plan = read_plan(store)
    found = states(store, plan.size)
    missing = found.count(None)
    who = runner(store) if is_locked(store) else None
    left = None
    if who is not None and plan.size - missing > who.ready:
        left = missing * (time.time() - who.started) / (plan.size - missing - who.ready)
    failures = reasons(store)
    result = {
        "cases": plan.size,
        "done": found.count("done"),
        "failed": found.count("failed"),
        "missing": missing,
        "running": who is not None,
        "seconds_left": left,
        "failures": [{"case": case, "reason": reason} for case, reason in failures.items()],
    }
    if json:
        print_json(result)
        return
    work = f"at work: process {who.pid} on {who.host}" if who else "nobody at work"
    rest = f", {left:.0f} s left" if left is not None else ""
    typer.echo(f"{plan.size} cases: {result['done']} done, {result['failed']} failed, {missing} missing; {work}{rest}")
    for case, reason in failures.items():
        typer.echo(f"  case {case}: {reason}")
