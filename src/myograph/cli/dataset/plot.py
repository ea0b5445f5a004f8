"""`myograph dataset plot`: a field of a muscle, in two states and as a distribution."""

from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.dataset.info import Store
from myograph.cli.dataset.pictures import field_picture
from myograph.cli.options import Json, print_json
from myograph.export.target import check_place, write_place

Muscle = Annotated[str, typer.Option(help="Which muscle, such as biceps.")]
PNG = b"\x89PNG"


def plot(
    store: Store,
    muscle: Muscle,
    out: Annotated[Path, typer.Option(help="PNG file.")],
    field: Annotated[
        str | None, typer.Option(help="A scalar field, or displacement; without it von_mises, where it is stored.")
    ] = None,
    json: Json = False,
) -> None:
    """Draw a muscle where it is least and most active, and how often each value of a field occurs in all cases."""
    check_place(out, PNG)
    picture = field_picture(store, muscle, field)
    write_place(out, PNG, lambda place: place.write_bytes(picture))
    if json:
        print_json({"out": str(out)})
    else:
        typer.echo(str(out))
