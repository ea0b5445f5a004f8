"""`myograph bench learn`: all methods side by side."""

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.options import Json, print_json
from myograph.cli.progress import Steps
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import MissingPackageError


def learn(
    data: Annotated[Path | None, typer.Option(help="Folder of a store; without it, a rod that bends.")] = None,
    muscle: Annotated[str, typer.Option(help="Of the store.")] = "biceps",
    steps: Annotated[int, typer.Option(help="Of the methods that are trained in steps.", min=1)] = 300,
    method: Annotated[list[str] | None, typer.Option(help="Only this one; several times for more.")] = None,
    json: Json = False,
) -> None:
    """Train all methods on the same cases: size, seconds to train, milliseconds to answer, error in mm."""
    try:
        from myograph.learning.bent_rod import bent_rod
        from myograph.learning.comparison import ROWS, compare
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "train", "comparing methods") from None
    cases = bent_rod() if data is None else read_muscle(data, muscle)
    names = method or list(ROWS)
    with Steps().bars("methods", {"begun": len(names)}) as advance:
        found = compare(cases, steps, names, lambda _: advance("begun"))
    if json:
        print_json({name: asdict(row) for name, row in found.rows.items()})
        return
    typer.echo(f"{'':20}{'parameters':>12}{'stored':>12}{'train_s':>10}{'predict_ms':>12}{'mean_mm':>10}")
    for name, row in found.rows.items():
        typer.echo(
            f"{name:20}{row.parameters:12d}{row.stored:12d}{row.train_s:10.1f}{row.predict_ms:12.3f}{row.mean_mm:10.3f}"
        )
    for name, reason in found.left_out.items():
        typer.echo(f"{name}: left out: {reason}")
