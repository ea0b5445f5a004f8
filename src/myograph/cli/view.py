"""`myograph view`: the living page of an arm, one HTML file."""

from pathlib import Path
from typing import Annotated

import typer

from myograph.case import MUSCLES
from myograph.cli.options import ArmFile, Json, print_json, read_arm
from myograph.errors import InputError
from myograph.files import write_whole
from myograph.inference.shipped import models_folder
from myograph.limb.motion.activation_file import Activations, read_activations
from myograph.view.page import PageArm, filled_page, page_content, read_arm_models, read_template, read_truth_cases

SHIPPED = "arm"


def view(
    model: Annotated[
        Path | None,
        typer.Argument(
            help="Folder of a saved model of neural modes, or of one for each muscle; the shipped arm without it."
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="The page, one HTML file.")] = Path("page.html"),
    movement: Annotated[
        Path | None, typer.Option(help="Activations over time to play: CSV, or OpenSim's .sto, as of 'myograph move'.")
    ] = None,
    truth: Annotated[
        Path | None, typer.Option(help="Dataset (store of an ensemble) whose cases the page compares the model with.")
    ] = None,
    arm_file: ArmFile = None,
    json: Json = False,
) -> None:
    """Write a page that opens in any browser, offline: sliders for the muscles, and the arm that follows them."""
    template = read_template()
    models = read_arm_models(_folder(model), read_arm(arm_file))
    cases = read_truth_cases(truth, models.muscles) if truth else []
    played = _movement(movement)
    content = page_content(PageArm(models, cases, played, movement.name if movement else ""))
    page = filled_page(template, content).encode()
    _check_place(out)
    write_whole(out, lambda file: file.write(page))
    if json:
        print_json(
            {
                "page": str(out),
                "bytes": len(page),
                "muscles": list(models.muscles),
                "vertices": content.vertices,
                "fields": list(content.fields),
                "truth_cases": len(cases),
                "movement_s": None if played is None else float(played.times[-1] - played.times[0]),
                "notes": list(content.notes),
            }
        )
        return
    typer.echo(f"{content.title}: {', '.join(models.muscles)}; {content.vertices} vertices, {len(page) / 1e6:.1f} MB")
    for note in content.notes:
        typer.echo(f"  note: {note}")
    typer.echo(f"  {out}: open it in a browser")


def _folder(model: Path | None) -> Path:
    if model is not None:
        return model
    shipped = models_folder() / SHIPPED
    if not shipped.is_dir():
        raise InputError("this installation has no arm of its own; expected MODEL, the folder of saved models")
    return shipped


def _movement(path: Path | None) -> Activations | None:
    return None if path is None else read_activations(path, MUSCLES)


def _check_place(out: Path) -> None:
    if out.is_dir():
        raise InputError(f"--out: expected a file such as page.html, got the folder {out}")
