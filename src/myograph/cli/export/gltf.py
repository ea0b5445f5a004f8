"""`myograph export gltf`: an arm that moves, for games, films and browsers."""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from myograph.anatomy.model import Arm
from myograph.cli.arm_model import Load, Model, Movement, Rate, read_keys, read_models
from myograph.cli.options import ArmFile, Json, print_json
from myograph.export.gltf import Keys, Rigid, Scene, Turning, shaped_muscle, write_gltf
from myograph.export.gltf.document import MAGIC
from myograph.export.gltf.shaped import elbow_angles
from myograph.export.target import check_place
from myograph.view.page.source import ArmModels
from myograph.view.palette import BONE, MUSCLE_COLOURS
from myograph.view.surface import capsule


def gltf(
    model: Model = None,
    movement: Movement = None,
    muscle: Annotated[list[str] | None, typer.Option(help="Only these muscles; may be repeated.")] = None,
    targets: Annotated[int, typer.Option(help="Morph targets of each muscle, at most.")] = 8,
    rate: Rate = 20.0,
    load: Load = 0.0,
    arm_file: ArmFile = None,
    out: Annotated[Path, typer.Option(help="The file, .glb.")] = Path("arm.glb"),
    json: Json = False,
) -> None:
    """Write muscles with morph targets, the bones, and a movement as glTF 2.0; metres, Y up."""
    check_place(out, MAGIC)
    models = read_models(model, arm_file, muscle)
    keys = read_keys(movement, rate, load)
    scene, notes = _scene(models, keys, targets)
    size = write_gltf(out, scene)
    errors = {shaped.name: shaped.error_mm for shaped in scene.muscles}
    if json:
        told = {"out": str(out), "bytes": size, "muscles": list(errors), "bones": [bone.name for bone in scene.bones]}
        print_json({**told, "states": len(keys.times), "errors_mm": errors, "notes": notes})
        return
    typer.echo(f"{models.name}: {', '.join(errors)}; {len(keys.times)} states, {size / 1e6:.2f} MB")
    typer.echo(f"  morph targets are at most {max(errors.values()):.2f} mm from all modes")
    for note in notes:
        typer.echo(f"  note: {note}")
    typer.echo(f"  {out}")


def _scene(models: ArmModels, keys: Keys, targets: int) -> tuple[Scene, list[str]]:
    """With what can be known of the bones, and what cannot."""
    muscles, arm = list(models.muscles.values()), models.arm
    if arm is None:
        centre, bones, turning = muscles[0].reference.mean(axis=0), [], None
        notes = ["no bones: the models were made with another arm; give its file by --arm"]
    else:
        angles = elbow_angles(muscles, keys)
        hinge = arm.hinge.frame()
        centre, bones = hinge.point, _bones(arm, angles is not None)
        turning = None if angles is None else Turning(-hinge.axis, angles - arm.reference_angle)
        notes = [] if turning else ["no bones of the forearm: the models do not tell the elbow's angle"]
    shaped = [shaped_muscle(one, keys, targets, centre, MUSCLE_COLOURS[one.muscle]) for one in muscles]
    return Scene(shaped, bones, keys.times, turning, centre), notes


def _bones(arm: Arm, moving: bool) -> list[Rigid]:
    """Capsules in the reference pose; those of the forearm only where it can be moved."""
    found = []
    for name, bone in arm.bones.items():
        moves = bone.moves_with == "forearm"
        if moving or not moves:
            shape = capsule(np.array(bone.start), np.array(bone.end), bone.radius, name, BONE)
            found.append(Rigid(name, BONE, shape.points, shape.quads, moves))
    return found
