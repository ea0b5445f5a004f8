"""`myograph arm`: draw and check the anatomy."""

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.case import MUSCLES
from myograph.cli.options import ArmFile, Json, Preset, print_json, read_arm
from myograph.files import write_whole
from myograph.mesh.presets import preset_mesh
from myograph.mesh.quality import scaled_jacobians


def arm(
    arm_file: ArmFile = None,
    out: Annotated[Path, typer.Option(help="The picture, PNG.")] = Path("arm.png"),
    preset: Preset = "quick",
    json: Json = False,
) -> None:
    """Draw the arm, five muscles and the bones, and check its meshes."""
    anatomy = read_arm(arm_file)
    summary = describe_arm(anatomy, preset)
    picture = draw_anatomy(anatomy, preset)
    write_whole(out, lambda file: file.write(picture))
    if json:
        print_json({**summary, "picture": str(out)})
        return
    typer.echo(f"{anatomy.name}, checksum {summary['checksum'][:12]}")
    for name, row in summary["muscles"].items():
        typer.echo(
            f"  {name:16} {row['length_mm']:6.1f} mm {row['volume_cm3']:6.1f} cm³ {row['nodes']:5d} nodes,"
            f" worst scaled Jacobian {row['worst_scaled_jacobian']:.3f}"
        )
    typer.echo(f"picture: {out}")


def describe_arm(anatomy: Arm, preset: str) -> dict[str, Any]:
    """Checksum of the arm, and size and mesh quality of each muscle."""
    rows = {}
    for name in MUSCLES:
        mesh = preset_mesh(anatomy, name, preset)
        rows[name] = {
            "length_mm": mesh.length,
            "volume_cm3": mesh.volume() / 1000,
            "nodes": len(mesh.points),
            "worst_scaled_jacobian": float(scaled_jacobians(mesh).min()),
        }
    return {"arm": anatomy.name, "checksum": arm_checksum(anatomy), "muscles": rows}


def draw_anatomy(anatomy: Arm, preset: str) -> bytes:
    """PNG of the arm in its reference pose."""
    from myograph.mesh.tissue import tendon_share
    from myograph.view import Surface, draw_arm
    from myograph.view.palette import MUSCLE_COLOURS

    muscles = []
    for name in MUSCLES:
        mesh = preset_mesh(anatomy, name, preset)
        share = tendon_share(anatomy, name, mesh)
        muscles.append(Surface(mesh.points, mesh.skin, name, MUSCLE_COLOURS[name], share))
    return draw_arm([*bone_surfaces(anatomy, 0.0), *muscles], anatomy.name)


def bone_surfaces(anatomy: Arm, flexion: float) -> list[Any]:
    """Capsules of the bones after a flexion [rad] from the reference pose."""
    from myograph.view import capsule
    from myograph.view.palette import BONE

    hinge = anatomy.hinge.frame()
    surfaces = []
    for bone in anatomy.bones.values():
        ends = np.array([bone.start, bone.end])
        if bone.moves_with == "forearm":
            ends = hinge.flex(ends, flexion)
        surfaces.append(capsule(ends[0], ends[1], bone.radius, "bones", BONE))
    return surfaces
