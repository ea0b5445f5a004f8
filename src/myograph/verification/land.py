r"""Cardiac benchmark, problem 1: a beam of passive heart muscle bent by a follower pressure.

    10 x 1 x 1 mm, fibres along x, clamped at x = 0;  Guccione: C 2 kPa, bf 8, bt 2, bfs 4, incompressible
    0.004 kPa on the bottom z = 0, which stays normal to it

The quantity is where the point (10, 0.5, 1) ends: its height z, not its displacement, which is one millimetre less.
Source: Land and others 2015, Proceedings of the Royal Society A 471; their codes lie between 4.0 and 4.2 mm, which is
why the tolerance is what it is; 4.17 where they agree.
"""

import numpy as np
from jaxtyping import Float

from myograph.materials.guccione import Guccione
from myograph.materials.law import Law
from myograph.mechanics.specimen import Box, Load, Specimen, solve
from myograph.verification.check import Check

HEART = Guccione(C=2e-3, bf=8.0, bt=2.0, bfs=4.0, bulk=10.0)
PRESSURE = 4e-6
"""0.004 kPa [MPa]."""
SIZE = (10.0, 1.0, 1.0)
POINT = (10.0, 0.5, 1.0)


def end_position(cells: tuple[int, int, int], law: Law = HEART) -> Float[np.ndarray, " 3"]:
    """Where the upper end of the beam comes to lie [mm]; the number of cells along y must be even."""
    beam = Specimen(Box(SIZE, cells), law, symmetry=())
    load = Load(displacement={"x_min": (0.0, 0.0, 0.0)}, pressure={"z_min": PRESSURE})
    return np.array(POINT) + solve(beam, load, steps=2).displacement_at(POINT)


def end_height() -> float:
    """Height z of the end [mm]."""
    return float(end_position((20, 2, 2))[2])


CHECKS = (Check("land.beam", "height z of the end [mm]", end_height, 4.17, "Land et al. 2015, problem 1", 0.01),)
