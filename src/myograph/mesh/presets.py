"""Mesh sizes by name: about 150, 1,000 and 4,000 Q2 nodes a muscle.

A small muscle has the next coarser layout where the named one would give it cells far smaller than the others': where
such a one is bent sharply around a joint, very small cells resolve creases of the surface, and solves fail.
"""

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

SMALLEST_CELL = 100.0
"""Mean volume of a muscle's cells [mm³], at least; those of the biceps have 730 at 'thesis'."""


def resolution(preset: str) -> Resolution:
    """Resolution of a preset; raise InputError for an unknown name."""
    if preset not in RESOLUTIONS:
        raise InputError(f"unknown preset '{preset}': expected one of {', '.join(RESOLUTIONS)}")
    return RESOLUTIONS[preset]


def preset_mesh(arm: Arm, name: str, preset: str) -> MuscleMesh:
    """Checked mesh of the named muscle, of a preset's size; raise InputError for an unknown preset."""
    wanted = resolution(preset)
    finest_first = [size for size in reversed(RESOLUTIONS.values()) if size.cells <= wanted.cells]
    volume = muscle_body(arm, name, 2 * wanted.along + 1).volume
    size = next((size for size in finest_first if volume / size.cells >= SMALLEST_CELL), finest_first[-1])
    return muscle_mesh(arm, name, size)


def muscle_mesh(arm: Arm, name: str, size: Resolution) -> MuscleMesh:
    """Checked mesh of the named muscle in the reference pose."""
    muscle = arm.muscles[name]
    body = muscle_body(arm, name, 2 * size.along + 1)
    flattening = np.full(len(body.areas), muscle.flattening)
    mesh = sweep(Tube(body.centres, body.areas, flattening, arm.hinge.frame().axis, body.length), size)
    check_mesh(mesh, name)
    return mesh
