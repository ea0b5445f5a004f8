"""`myograph view`: the living page of an arm, one HTML file."""

from pathlib import Path
from typing import Annotated

import typer

from myograph.case import MUSCLES
from myograph.cli.arm_model import model_folder
from myograph.cli.options import ArmFile, Json, print_json, read_arm
from myograph.errors import InputError
from myograph.files import write_whole
from myograph.inference.shipped import ARM, shipped_models
from myograph.limb.motion.activation_file import Activations, read_activations
from myograph.view.page import (
    ArmModels,
    PageArm,
    SolveTime,
    filled_page,
    is_network,
    page_content,
    read_arm_models,
    read_network,
    read_runtime,
    read_template,
    read_truth_cases,
    shipped_solve_time,
)

Network = Annotated[
    str | None,
    typer.Option(help="A saved network that answers anywhere, such as 'gen-biceps': asked in the page beside MODEL."),
]


def view(
    model: Annotated[
        str | None,
        typer.Argument(
            help="Folder of a saved model of neural modes, or of one for each muscle; or a shipped model by its name. "
            "The shipped arm without it, and where it is a network that answers anywhere."
        ),
    ] = None,
    out: Annotated[Path, typer.Option(help="The page, one HTML file.")] = Path("page.html"),
    movement: Annotated[
        Path | None, typer.Option(help="Activations over time to play: CSV, or OpenSim's .sto, as of 'myograph move'.")
    ] = None,
    truth: Annotated[
        Path | None, typer.Option(help="Dataset (store of an ensemble) whose cases the page compares the model with.")
    ] = None,
    network: Network = None,
    arm_file: ArmFile = None,
    json: Json = False,
) -> None:
    """Write a page that opens in any browser, offline: sliders for the muscles, and the arm that follows them."""
    _check_place(out)
    template = read_template()
    folder, beside = _folders(model, network)
    models = read_arm_models(folder, read_arm(arm_file))
    asked = None if beside is None else read_network(beside, models)
    runtime = "" if asked is None else read_runtime()
    cases = read_truth_cases(truth, models.muscles) if truth else []
    played = _movement(movement)
    name = movement.name if movement else ""
    content = page_content(PageArm(models, cases, played, name, asked, _solve_time(models)))
    page = filled_page(template, content, runtime).encode()
    write_whole(out, lambda file: file.write(page))
    if json:
        print_json(
            {
                "page": str(out),
                "bytes": len(page),
                "muscles": list(models.muscles),
                "vertices": content.vertices,
                "fields": list(content.fields),
                "network": content.network,
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


def _folders(model: str | None, network: str | None) -> tuple[Path, Path | None]:
    """Of the modes, and of the network beside them; a model that has no modes is a network beside the shipped arm."""
    folder = _folder(model)
    beside = None if network is None else _folder(network)
    if beside is not None and not is_network(beside):
        raise InputError(
            f"--network {network}: expected a network that answers anywhere, got none; modes are the MODEL"
        )
    if not is_network(folder):
        return folder, beside
    if beside is not None:
        raise InputError(f"{folder}: expected neural modes beside --network, got another network")
    return model_folder(None), folder


def _folder(named: str | None) -> Path:
    folder = model_folder(named)
    if not folder.exists():
        known = ", ".join([ARM, *shipped_models()])
        raise InputError(
            f"{named}: expected the folder of a saved model, found nothing there; shipped ones are {known}"
        )
    return folder


def _solve_time(models: ArmModels) -> SolveTime | None:
    """Of the finite elements that the shipped models are held against, where they are of the same arm."""
    found = (shipped_solve_time(name, told.origin.arm_checksum) for name, told in models.told.items())
    return next((time for time in found if time is not None), None)


def _movement(path: Path | None) -> Activations | None:
    return None if path is None else read_activations(path, MUSCLES)


def _check_place(out: Path) -> None:
    if out.is_dir() or out.suffix.lower() not in (".html", ".htm"):
        what = "the folder " if out.is_dir() else ""
        raise InputError(f"--out: expected a file such as page.html, got {what}{out}")
