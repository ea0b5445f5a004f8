"""`myograph export vtkhdf`: a movement of a model, or the cases of a dataset, for ParaView."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from myograph.cli.arm_model import (
    Load,
    ModelOrDataset,
    Movement,
    Rate,
    is_dataset,
    read_keys,
    read_models,
    steps_of_keys,
)
from myograph.cli.options import Json, print_json
from myograph.ensemble.spec import Body
from myograph.ensemble.store.opening import open_cases
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.export.steps import steps_of_cases
from myograph.export.vtkhdf import write_vtkhdf


def vtkhdf(
    model: ModelOrDataset = None,
    movement: Movement = None,
    muscle: Annotated[
        list[str] | None, typer.Option(help="Only these muscles; may be repeated. Of a dataset exactly one.")
    ] = None,
    rate: Rate = 20.0,
    load: Load = 0.0,
    out: Annotated[Path, typer.Option(help="The file, .vtkhdf.")] = Path("arm.vtkhdf"),
    json: Json = False,
) -> None:
    """Write all fields over the time of a movement, or of all cases of a dataset, with names and units."""
    if model is not None and is_dataset(model):
        count, names = _write_cases(Path(model), muscle or [], movement, out)
    else:
        found = read_models(model, None, muscle).muscles
        bodies = {name: Body(one.reference, one.skin, one.cells) for name, one in found.items()}
        count = write_vtkhdf(out, bodies, steps_of_keys(found, read_keys(movement, rate, load)))
        names = list(found)
    if json:
        print_json({"out": str(out), "muscles": names, "states": count})
        return
    typer.echo(f"{', '.join(names)}: {count} states\n  {out}")


def _write_cases(store: Path, muscles: list[str], movement: Path | None, out: Path) -> tuple[int, list[str]]:
    if len(muscles) != 1 or movement is not None:
        raise InputError(f"{store}: expected one --muscle and no --movement of a dataset, got {muscles or 'no muscle'}")
    cases = read_muscle(store, muscles[0])
    numbers = np.flatnonzero(open_cases(store)["state"].values == "done").tolist()
    return write_vtkhdf(out, {muscles[0]: cases.body}, steps_of_cases(cases, numbers)), muscles
