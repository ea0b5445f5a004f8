"""States of muscles as solids for a picture, of a model or of a dataset; the bones where they are known."""

from collections.abc import Mapping
from typing import Annotated, Literal

import numpy as np
import typer
from jaxtyping import Float, Int

from myograph.anatomy.model import Arm
from myograph.cli.arm import bone_surfaces
from myograph.errors import InputError
from myograph.fields import FIELDS
from myograph.inference.low_rank import LowRankMuscle
from myograph.view.palette import MUSCLE_COLOURS
from myograph.view.picture import CAMERAS, Solid

FieldName = Literal["muscle", "von_mises", "fibre_stretch", "displacement", "half_width_90"]
Shown = Annotated[
    FieldName,
    typer.Option("--field", help="What colours say: which muscle, a field, the way from rest, or the 90 % interval."),
]
Camera = Annotated[str, typer.Option(help=f"Seen from: {', '.join(CAMERAS)}.")]
Bones = Annotated[bool, typer.Option(help="Draw the bones.")]
Size = Annotated[str, typer.Option(help="Width and height of the image [pixels].")]
TITLES = {
    "von_mises": "von Mises stress [MPa]",
    "fibre_stretch": "fibre stretch [-]",
    "displacement": "displacement from rest [mm]",
    "half_width_90": "nine of ten positions within [mm]",
}
Fields = Mapping[str, Float[np.ndarray, "nodes ..."]]


def size_of(text: str) -> tuple[int, int]:
    """Such as '800x600'; raises InputError for anything else."""
    width, _, height = text.lower().partition("x")
    if not (width.isdigit() and height.isdigit()):
        raise InputError(f"--size: expected such as 800x600, got '{text}'")
    return int(width), int(height)


def model_solid(muscle: LowRankMuscle, row: Float[np.ndarray, " muscles"], load: float, shown: str) -> Solid:
    """A muscle at these activations; raises InputError for a field that its model does not have."""
    found = dict(muscle.at(row, load))
    if shown == "displacement":
        rest = muscle.at(np.zeros(len(row)), load)["position"]
        found["displacement"] = np.linalg.norm(found["position"] - rest, axis=1)
    if shown == "half_width_90":
        if "position" not in muscle.half_width_90:
            raise InputError(
                f"{muscle.name}: expected a calibrated model for --field half_width_90, got one that is not"
            )
        deviation = muscle.deviations(muscle.place(row, load))["position"]
        found["half_width_90"] = muscle.half_width_90["position"] * deviation
    return solid_of(muscle.muscle, found, muscle.skin, shown)


def solid_of(name: str, fields: Fields, skin: Int[np.ndarray, "facets 4"], shown: str) -> Solid:
    """A muscle with the field that is shown; raises InputError for one that is not there, and for no surface."""
    if shown != "muscle" and shown not in fields:
        known = [field for field in TITLES if field in fields]
        raise InputError(f"{name}: expected one of the fields {', '.join(['muscle', *known])}, got '{shown}'")
    values = None if shown == "muscle" else np.asarray(fields[shown], dtype=float)
    return Solid(name, np.asarray(fields["position"], dtype=float), skin, MUSCLE_COLOURS[name], values)


def bone_solids(arm: Arm | None, angle: float | None) -> list[Solid]:
    """The bones at an elbow's angle [rad]; none where arm or angle are not known."""
    if arm is None or angle is None or not np.isfinite(angle):
        return []
    surfaces = bone_surfaces(arm, angle - arm.reference_angle)
    names = list(arm.bones)
    return [Solid(name, one.points, one.quads, one.colour) for name, one in zip(names, surfaces, strict=True)]


def title_of(shown: str) -> str:
    """Of the colour bar."""
    unit = FIELDS[shown].unit if shown in FIELDS else ""
    return TITLES.get(shown, f"{shown} [{unit}]")
