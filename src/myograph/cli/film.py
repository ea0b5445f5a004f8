"""`myograph film`: a movement of the arm in three dimensions."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console

from myograph.cli.arm_model import Load, Model, Movement, Rate, read_keys, read_models
from myograph.cli.options import ArmFile, Json, print_json
from myograph.cli.progress import Steps
from myograph.cli.solids import Bones, Camera, Shown, Size, bone_solids, model_solid, size_of, title_of
from myograph.export.gltf import Keys
from myograph.view.page.source import ArmModels
from myograph.view.picture import Panel, Stage, named_camera, write_film
from myograph.view.picture.film import check_film
from myograph.view.picture.solid import colours_of
from myograph.view.picture.stage import Setting

LOOKED_AT = 12
"""States whose places and values decide what is in view and how far the colour bar goes."""


def film(
    model: Model = None,
    movement: Movement = None,
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
    """Film a movement: muscles deform and bones turn as the activations say."""
    check_film(out)
    viewer = named_camera(camera)
    models = read_models(model, arm_file, muscle)
    keys = read_keys(movement, rate, load)
    shown = (field, bones)
    some = np.unique(np.linspace(0, len(keys.times) - 1, LOOKED_AT).astype(int))
    looked = [_panel(models, keys, int(k), shown) for k in some]
    around = np.concatenate([solid.points for panel in looked for solid in panel.solids])
    colours = None if field == "muscle" else colours_of(title_of(field), looked)
    stage = Stage(looked[:1], Setting(viewer, size_of(size)), colours, around)

    def images() -> Iterator[np.ndarray]:
        with Steps(Console(stderr=True)).bars("film", {"images": len(keys.times)}) as told:
            for k in range(len(keys.times)):
                yield stage.image([_panel(models, keys, k, shown)])
                told("images")

    try:
        count = write_film(out, images(), rate)
    finally:
        stage.close()
    if json:
        print_json({"out": str(out), "images": count, "seconds": count / rate, "muscles": list(models.muscles)})
    else:
        typer.echo(f"{models.name}: {count} images, {count / rate:.1f} s\n  {out}")


def _panel(models: ArmModels, keys: Keys, k: int, shown: tuple[str, bool]) -> Panel:
    field, bones = shown
    row, muscles = keys.activations[k], models.muscles.values()
    angle = next(iter(muscles)).elbow_angle(row, keys.hand_load)
    outside = "" if all(one.inside(row, keys.hand_load) for one in muscles) else "\nOUTSIDE the training"
    elbow = "" if angle is None else f", elbow {np.degrees(angle):.0f}°"
    solids = [model_solid(one, row, keys.hand_load, field) for one in muscles]
    return Panel(
        f"{keys.times[k]:.2f} s{elbow}{outside}", [*(bone_solids(models.arm, angle) if bones else []), *solids]
    )
