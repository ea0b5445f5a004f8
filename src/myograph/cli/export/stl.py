"""`myograph export stl`: the surfaces of muscles in one state."""

from pathlib import Path
from typing import Annotated

import typer

from myograph.cli.arm_model import Activation, Load, Model, activation_row, read_models
from myograph.cli.options import Json, print_json
from myograph.errors import InputError
from myograph.export.stl import write_stl


def stl(
    model: Model = None,
    activation: Activation = None,
    load: Load = 0.0,
    muscle: Annotated[list[str] | None, typer.Option(help="Only these muscles; may be repeated.")] = None,
    out: Annotated[Path, typer.Option(help="The file, .stl, in mm.")] = Path("arm.stl"),
    json: Json = False,
) -> None:
    """Write the surfaces of the muscles at these activations, for printing and for other meshers."""
    found = read_models(model, None, muscle).muscles
    bare = [name for name, one in found.items() if not len(one.skin)]
    if bare:
        raise InputError(f"expected models that know the surface of their body, got none of {', '.join(bare)}")
    row = activation_row(activation)
    surfaces = {name: (one.at(row, load)["position"], one.skin) for name, one in found.items()}
    inside = all(one.inside(row, load) for one in found.values())
    count = write_stl(out, surfaces)
    if json:
        print_json({"out": str(out), "muscles": list(found), "triangles": count, "inside": inside})
        return
    verdict = "" if inside else "; OUTSIDE what the model was trained on: do not rely"
    typer.echo(f"{', '.join(found)}: {count} triangles{verdict}\n  {out}")
