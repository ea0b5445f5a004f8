"""`myograph dataset export`: a store as files of other programs."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from myograph.cli.dataset.info import Store
from myograph.cli.options import Json, print_json
from myograph.ensemble.store.reading import read_numbered
from myograph.errors import InputError
from myograph.export.csv import write_csv
from myograph.export.plaid import write_plaid
from myograph.export.steps import steps_of_cases
from myograph.export.vtkhdf import write_vtkhdf

Format = Literal["vtkhdf", "csv", "plaid"]


def export(
    store: Store,
    to: Annotated[Format, typer.Option(help="vtkhdf (ParaView), csv (numbers of all cases) or plaid.")],
    out: Annotated[Path, typer.Option(help="File; for plaid a folder.")],
    muscle: Annotated[str | None, typer.Option(help="Which muscle; csv takes all of them.")] = None,
    json: Json = False,
) -> None:
    """Write the cases of a store for another program; in VTKHDF the time is the number of the case."""
    if (to == "csv") != (muscle is None):
        raise InputError(f"--to {to}: expected {'no' if to == 'csv' else 'a'} --muscle, got {muscle or 'none'}")
    if muscle is None:
        count = write_csv(out, store)
    else:
        cases, numbers = read_numbered(store, muscle)
        if to == "vtkhdf":
            count = write_vtkhdf(out, {muscle: cases.body}, steps_of_cases(cases, numbers))
        else:
            count = write_plaid(out, cases, numbers)
    if json:
        print_json({"out": str(out), "cases": count})
    else:
        typer.echo(f"{count} cases: {out}")
