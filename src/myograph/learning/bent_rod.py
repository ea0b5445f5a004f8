"""Cases of formulas, for timing methods where no store is at hand: a rod that bends, swells and is pulled.

Nodes of a square rod along z; with activation a its axis is an arc of the angle w·a, its sides grow by a fifth of a_2.
Says nothing about muscles; errors on it only show that a method learns at all.
"""

import itertools

import numpy as np

from myograph.ensemble.muscle_cases import MuscleCases, cases_in_memory
from myograph.ensemble.spec import Body

LENGTH, SIDE = 250.0, 20.0  # mm
BENDING = np.array([0.4, 0.5, 0.7, -0.1, -0.5])


def bent_rod(sections: int = 40, across: int = 5, off_grid: int = 16) -> MuscleCases:
    """32 factorial and some off-grid cases of sections x across² nodes."""
    ticks = np.linspace(-SIDE / 2, SIDE / 2, across)
    heights = np.linspace(0, LENGTH, sections)
    reference = np.stack([axis.ravel() for axis in np.meshgrid(heights, ticks, ticks, indexing="ij")], axis=1)[:, ::-1]
    factorial = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    activation = np.concatenate([factorial, np.random.default_rng(0).uniform(size=(off_grid, 5))])
    angle = np.abs(activation @ BENDING)[:, None] + 0.1
    x, y, z = reference.T
    turned = angle * z / LENGTH
    wide = 1 + 0.2 * activation[:, 2:3]
    from_centre = LENGTH / angle + wide * x
    position = np.stack(
        [
            from_centre * np.cos(turned) - LENGTH / angle,
            np.broadcast_to(wide * y, turned.shape),
            from_centre * np.sin(turned),
        ],
        axis=-1,
    )
    words = ["factorial"] * len(factorial) + ["off_grid"] * off_grid
    body = Body(np.ascontiguousarray(reference), np.zeros((0, 4), dtype=np.int64), np.zeros((0, 8), dtype=np.int64))
    return cases_in_memory("biceps", body, activation, words, {"position": position.astype(np.float32)}, angle[:, 0])
