"""A bar of hexahedra whose cases keep their volume and their lower end, by a formula of the activations."""

import itertools

import numpy as np

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.mesh.hexahedra import lattice

CELLS, SIDE = 3, 20.0  # along z; mm


def bar():
    """So many cubes on each other: nodes in layers of nine, the first coordinate fastest."""
    layer = lattice((0.0, 0.5, 1.0))[:9]
    heights = np.arange(2 * CELLS + 1) / 2
    reference = np.concatenate([layer + np.array([0, 0, height]) for height in heights]) * SIDE
    cells = np.stack([np.arange(27) + 18 * cell for cell in range(CELLS)])
    return Body(reference, np.zeros((0, 4), dtype=np.int64), cells)


def sheared(reference, amount):
    """Layers slide along x and y, faster with height: det F = 1 everywhere."""
    x, y, z = np.moveaxis(reference, -1, 0)
    along = (z / SIDE) ** 2
    return np.stack([x + 4 * amount * along, y - 2 * amount * along, np.broadcast_to(z, along.shape)], axis=-1)


def bar_cases(clamped=True):
    """32 factorial and 8 off-grid cases; unless clamped, the lower end moves too."""
    factorial = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    activation = np.concatenate([factorial, np.random.default_rng(4).uniform(size=(8, 5))])
    body, amounts = bar(), activation @ [0.4, 0.6, 0.8, -0.2, -0.9]
    position = np.stack([sheared(body.reference, amount) for amount in amounts])
    if not clamped:
        position = position + amounts[:, None, None]
    words = ["factorial"] * 32 + ["off_grid"] * 8
    return cases_in_memory("biceps", body, activation, words, {"position": position.astype(np.float32)})
