"""Specimens: a piece of material of a simple shape, how it is held and loaded, and what comes of it.

    state = solve(Specimen(Box(), MooneyRivlin(c1=1, K=1000)), Load(displacement={"x_max": (0.3, None, None)}))

Frozen descriptions in, numbers in mm, N and MPa out; for verification, for trying a law, for teaching.
"""

from myograph.mechanics.specimen.description import Load, Specimen
from myograph.mechanics.specimen.shapes import Box, Panel, Shape, ThickCylinder, ThickSphere
from myograph.mechanics.specimen.solve import solve
from myograph.mechanics.specimen.state import LoadStep, Samples, SpecimenState

__all__ = [
    "Box",
    "Load",
    "LoadStep",
    "Panel",
    "Samples",
    "Shape",
    "Specimen",
    "SpecimenState",
    "ThickCylinder",
    "ThickSphere",
    "solve",
]
