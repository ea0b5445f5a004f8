"""`myograph verify`: published reference values, ours beside them."""

import math
import time
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from myograph.cli.options import Json, print_json
from myograph.cli.progress import Steps
from myograph.errors import MissingPackageError, NotConvergedError


def verify(
    only: Annotated[
        list[str] | None,
        typer.Option(help="Run one check (febio.ma20) or one family (febio) only; may be given several times."),
    ] = None,
    data: Annotated[
        Path | None,
        typer.Option(envvar="MYOGRAPH_REFERENCE_DATA", help="Folder of reference data that myograph does not bring."),
    ] = None,
    json: Json = False,
) -> None:
    """Compute published reference values and closed forms, and compare.

    Exit code 3 where a value lies outside its tolerance.
    """
    started = time.perf_counter()
    results, skipped = _run(only or [], data)
    for family, reason in skipped.items():
        typer.echo(f"myograph: skipped {family}: {reason}", err=True)
    if json:
        print_json({"checks": [_row(result) for result in results], "skipped": list(skipped)})
    else:
        _print_table(results, time.perf_counter() - started)
    failed = [result for result in results if not result.passed]
    if failed:
        raise NotConvergedError("\n".join(_complaint(result) for result in failed))


def _run(only: list[str], data: Path | None) -> tuple[list[Any], dict[str, str]]:
    try:
        from myograph.verification import table
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "simulate", "verifying") from None
    checks = table.select(only, data)
    families = dict.fromkeys(check.name.split(".")[0] for check in checks)
    totals = {family: sum(check.name.startswith(f"{family}.") for check in checks) for family in families}
    results = []
    with Steps().bars("verify", totals) as advance:
        for result in table.verify(only, data):
            results.append(result)
            advance(result.check.name.split(".")[0])
    return results, table.skipped(only, data)


def _row(result: Any) -> dict[str, Any]:
    return {
        "name": result.check.name,
        "value": _number(result.value),
        "reference": result.check.reference,
        "relative_error": _number(result.relative_error),
        "tolerance": result.check.tolerance,
        "passed": result.passed,
    }


def _number(value: float) -> float | None:
    """JSON has no NaN: a value that could not be computed is null."""
    return value if math.isfinite(value) else None


def _print_table(results: list[Any], seconds: float) -> None:
    table = Table(
        title="Ours beside what is known",
        title_justify="left",
        box=SIMPLE,
        show_edge=False,
        padding=(0, 1, 0, 0),
    )
    table.add_column("check", no_wrap=True)
    for name in ("value", "reference", "error", "tolerance"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("passed", justify="center", no_wrap=True)
    for result in results:
        check = result.check
        table.add_row(
            check.name,
            f"{result.value:.6g}",
            f"{check.reference:.6g}",
            f"{result.relative_error:.1e}",
            f"{check.tolerance:.0e}",
            "[green]yes[/]" if result.passed else "[red]NO[/]",
        )
    console = Console()
    console.print(table)
    console.print(f"{sum(r.passed for r in results)} of {len(results)} passed in {seconds:.0f} s")


def _complaint(result: Any) -> str:
    check = result.check
    if result.failure:
        return f"{check.name}: {result.failure}"
    return (
        f"{check.name}: {check.what} is {result.value:.10g}, {check.source} has {check.reference:.10g}:"
        f" off by {result.relative_error:.1e}, more than {check.tolerance:.0e}"
    )
