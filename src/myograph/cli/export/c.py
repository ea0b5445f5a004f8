"""`myograph export c`: a muscle as a header and a source of C99."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from myograph.cli.arm_model import Model, read_muscle_model
from myograph.cli.options import Json, print_json
from myograph.errors import InputError
from myograph.export.c import Wanted, c_source, reduced_muscle
from myograph.files import write_whole

TOLERANCE_MM = 0.25


def c(
    model: Model = None,
    muscle: Annotated[str | None, typer.Option(help="Which muscle of the arm.")] = None,
    kind: Annotated[Literal["float", "int8"], typer.Option("--type", help="Of the modes' numbers.")] = "float",
    tolerance_mm: Annotated[
        float | None,
        typer.Option(
            help=f"Largest distance from the full model; without it {TOLERANCE_MM:g}, or none with --most-kb."
        ),
    ] = None,
    most_kb: Annotated[float | None, typer.Option(help="Largest size of the weights [1000 bytes].")] = None,
    all_nodes: Annotated[bool, typer.Option("--all-nodes", help="Nodes inside the muscle, too.")] = False,
    stress: Annotated[bool, typer.Option("--stress", help="Von Mises stress, too.")] = False,
    name: Annotated[str | None, typer.Option(help="Of files and functions; the muscle's without it.")] = None,
    out: Annotated[Path, typer.Option(help="Folder for the two files.")] = Path("."),
    json: Json = False,
) -> None:
    """Write a muscle as C99 without allocation: five activations and a load in, positions of the surface out."""
    found = read_muscle_model(model, muscle)
    wished = TOLERANCE_MM if tolerance_mm is None and most_kb is None else tolerance_mm
    reduced = reduced_muscle(found, Wanted(kind, wished, most_kb, not all_nodes, stress))
    source = c_source(reduced, name or found.muscle)
    if out.exists() and not out.is_dir():
        raise InputError(f"--out: expected a folder, got the file {out}")
    for file, text in source.files.items():
        write_whole(out / file, lambda place, text=text: place.write(text.encode()))
    paths = [str(out / file) for file in source.files]
    if json:
        print_json(
            {
                "out": paths,
                "muscle": found.muscle,
                "type": kind,
                "nodes": len(reduced.muscle.reference),
                "modes": reduced.modes,
                "errors": reduced.errors,
                "weight_bytes": reduced.bytes,
                "model_sha256": found.checksum,
            }
        )
        return
    modes = ", ".join(f"{count} modes of {field}" for field, count in reduced.modes.items())
    typer.echo(
        f"{found.muscle}: {len(reduced.muscle.reference)} nodes, {modes}, {reduced.bytes / 1000:.1f} kB of {kind}\n"
        f"  at most {reduced.errors['position']:.3g} mm from the full model\n  {', '.join(paths)}"
    )
