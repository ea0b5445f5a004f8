r"""Patch test: a distorted mesh whose boundary follows a homogeneous deformation reproduces it, to round-off.

u = (F - 1) X on the whole boundary  =>  F and the stress are the same everywhere inside
"""

from typing import Literal

import numpy as np

from myograph.materials.law import Law
from myograph.materials.mooney_rivlin import MooneyRivlin
from myograph.mechanics.specimen import Box, Load, Specimen, solve
from myograph.verification.check import Check

GRADIENT = ((1.2, 0.1, 0.05), (-0.05, 0.9, 0.1), (0.1, 0.02, 0.95))
LAW = MooneyRivlin(c1=1.0, c2=0.5, K=1000.0, contraction="fibre", active_stress=0.5)
_FIBRE = (0.6, 0.0, 0.8)


def deviation(element: Literal["hexahedra", "tetrahedra"], law: Law = LAW) -> float:
    """Largest deviation of F from the prescribed one at any integration point [-]."""
    shape = Box(size=(1.0, 2.0, 3.0), cells=(3, 3, 3), distortion=0.3)
    specimen = Specimen(shape, law, fibre=_FIBRE, symmetry=(), element=element)
    state = solve(specimen, Load(gradient=GRADIENT, activation=1.0))
    return float(np.abs(state.samples.F - np.array(GRADIENT)).max())


_SOURCE = "theory of finite elements"
CHECKS = (
    Check("patch.hexahedra", "deviation of F, Q2–Q1 [-]", lambda: deviation("hexahedra"), 0.0, _SOURCE, 1e-9),
    Check("patch.tetrahedra", "deviation of F, P2–P1 [-]", lambda: deviation("tetrahedra"), 0.0, _SOURCE, 1e-9),
)
