"""The bones of an arm as the page draws them: capsules in the reference pose, those of the forearm turn with it."""

from typing import Any

import numpy as np

from myograph.anatomy.model import Arm
from myograph.view.page.packing import Packer
from myograph.view.page.smoothing import triangles_of
from myograph.view.palette import BONE
from myograph.view.surface import capsule


def packed_bones(arm: Arm, packer: Packer) -> list[dict[str, Any]]:
    """A surface for each bone."""
    bones = []
    for name, bone in arm.bones.items():
        surface = capsule(np.array(bone.start), np.array(bone.end), bone.radius, name, BONE)
        bones.append(
            {
                "name": name,
                "colour": surface.colour,
                "points": packer.reals(surface.points),
                "triangles": packer.integers(triangles_of(surface.quads)),
                "moves": bone.moves_with == "forearm",
            }
        )
    return bones


def hinge_of(arm: Arm) -> dict[str, Any]:
    """The hinge that the forearm turns about, and the angle [rad] of the reference pose."""
    hinge = arm.hinge.frame()
    directions = {key: getattr(hinge, key).tolist() for key in ("point", "forward", "up", "axis")}
    return {**directions, "reference_angle": arm.reference_angle}
