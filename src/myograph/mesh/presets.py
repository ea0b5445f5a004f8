"""Mesh sizes by name: about 150, 1,000 and 4,000 Q2 nodes a muscle."""

import numpy as np

from myograph.anatomy.body import muscle_body
from myograph.anatomy.model import Arm
from myograph.errors import InputError
from myograph.mesh.muscle_mesh import MuscleMesh
from myograph.mesh.quality import check_mesh
from myograph.mesh.sweep import Resolution, Tube, sweep

RESOLUTIONS = {
    "tiny": Resolution(core=1, rings=0, along=8),
    "quick": Resolution(core=1, rings=1, along=20),
    "thesis": Resolution(core=2, rings=2, along=22),
}


def resolution(preset: str) -> Resolution:
    """Resolution of a preset; raise InputError for an unknown name."""
    if preset not in RESOLUTIONS:
        raise InputError(f"unknown preset '{preset}': expected one of {', '.join(RESOLUTIONS)}")
    return RESOLUTIONS[preset]


def muscle_mesh(arm: Arm, name: str, size: Resolution) -> MuscleMesh:
    """Checked mesh of the named muscle in the reference pose."""
    muscle = arm.muscles[name]
    body = muscle_body(arm, name, 2 * size.along + 1)
    flattening = np.full(len(body.areas), muscle.flattening)
    mesh = sweep(Tube(body.centres, body.areas, flattening, arm.hinge.frame().axis, body.length), size)
    check_mesh(mesh, name)
    return mesh
