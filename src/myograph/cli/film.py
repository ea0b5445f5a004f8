"""`myograph film`: a movement of the arm, or the cases of a dataset, in three dimensions."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console

from myograph.cli.arm_model import Load, ModelOrDataset, Movement, Rate, read_keys, read_models
from myograph.cli.options import ArmFile, Json, print_json, read_arm
from myograph.cli.progress import Steps
from myograph.cli.reel import Reel, case_order, cases_reel, is_cases, movement_reel, read_cases
from myograph.cli.solids import Bones, Camera, Shown, Size, size_of, title_of
from myograph.errors import InputError
from myograph.view.picture import Stage, named_camera, write_film
from myograph.view.picture.film import check_film
from myograph.view.picture.solid import colours_of
from myograph.view.picture.stage import Setting

LOOKED_AT = 12
"""States whose places and values decide what is in view and how far the colour bar goes."""


def film(
    model: ModelOrDataset = None,
    movement: Movement = None,
    case: Annotated[
        list[int] | None, typer.Option(help="Of a dataset: which case; repeated, in this order. All without.")
    ] = None,
    by_angle: Annotated[
        bool, typer.Option("--by-angle", help="Of a dataset: cases from the straightest elbow to the most flexed.")
    ] = False,
    muscle: Annotated[list[str] | None, typer.Option(help="Only these muscles; may be repeated.")] = None,
    field: Shown = "muscle",
    camera: Camera = "oblique",
    rate: Rate = 20.0,
    load: Load = 0.0,
    bones: Bones = True,
    size: Size = "480x640",
    arm_file: ArmFile = None,
    out: Annotated[Path, typer.Option(help="The film: .gif, or .mp4 where imageio is installed.")] = Path("film.gif"),
    json: Json = False,
) -> None:
    """Film a movement, or the cases of a dataset: muscles deform and bones turn as the activations say."""
    check_film(out)
    if not (np.isfinite(rate) and rate > 0):
        raise InputError(f"--rate: expected a number above 0 a second, got {rate:g}")
    setting = Setting(named_camera(camera), size_of(size))
    if is_cases(model):
        _refuse(str(model), "a dataset", {"--movement": movement, "--load": load or None})
        cases = read_cases(Path(str(model)), muscle)
        name = Path(str(model)).resolve().name
        reel = cases_reel(name, cases, case_order(cases, case, by_angle), (field, bones), read_arm(arm_file))
    else:
        _refuse(model or "the arm", "a model", {"--case": case, "--by-angle": by_angle or None})
        models = read_models(model, arm_file, muscle)
        reel = movement_reel(models, read_keys(movement, rate, load), (field, bones))
    count = _film(reel, field, setting, (out, rate))
    if json:
        print_json({"out": str(out), "images": count, "seconds": count / rate, "muscles": list(reel.muscles)})
    else:
        typer.echo(f"{reel.name}: {count} images, {count / rate:.1f} s\n  {out}")


def _refuse(named: str, what: str, options: dict[str, object]) -> None:
    given = [option for option, value in options.items() if value is not None]
    if given:
        raise InputError(f"{named}: expected no {' and no '.join(given)} of {what}, got it; leave it out")


def _film(reel: Reel, field: str, setting: Setting, written: tuple[Path, float]) -> int:
    """Images drawn one after another, with one view and one colour bar for all; gives back their number."""
    out, rate = written
    some = np.unique(np.linspace(0, reel.count - 1, LOOKED_AT).astype(int))
    looked = [reel.panel(int(k)) for k in some]
    around = np.concatenate([solid.points for panel in looked for solid in panel.solids])
    colours = None if field == "muscle" else colours_of(title_of(field), looked)
    stage = Stage(looked[:1], setting, colours, around)

    def images() -> Iterator[np.ndarray]:
        with Steps(Console(stderr=True)).bars("film", {"images": reel.count}) as told:
            for k in range(reel.count):
                yield stage.image([reel.panel(k)])
                told("images")

    try:
        return write_film(out, images(), rate)
    finally:
        stage.close()
