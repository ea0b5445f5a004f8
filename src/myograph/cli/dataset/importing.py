"""`myograph dataset import`: data of another program become a store."""

import shlex
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress

import myograph
from myograph.cli.options import Json, print_json
from myograph.ensemble.importing.importing import import_store


def import_(
    mapping: Annotated[Path, typer.Argument(help="TOML file that says what the data mean; see docs/datasets.md.")],
    out: Annotated[Path, typer.Option(help="Folder of the new store.")],
    json: Json = False,
) -> None:
    """Make a store of another program's files: points of each case in VTU, VTK, VTKHDF or NumPy, activations in CSV."""
    made_by = {"command": shlex.join(sys.argv), "myograph_version": myograph.__version__}
    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("cases", total=None)
        count = import_store(mapping, out, made_by, lambda done: progress.update(task, completed=done))
    if json:
        print_json({"cases": count, "store": str(out)})
    else:
        typer.echo(f"{count} cases: {out}")
