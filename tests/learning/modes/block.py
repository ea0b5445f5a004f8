"""A block of one element whose fields are polynomials of the elbow's angle and its own activation."""

import itertools

import numpy as np

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.mesh.hexahedra import HEX27

OWN = 2  # the biceps
SIDE = 20.0  # mm
SHAPES = np.random.default_rng(5).normal(size=(4, 3, 3))
STRESSES = np.random.default_rng(6).normal(size=(3, 6, 3))


def angles(activation):
    """Elbow angle [rad] of activations (cases, 5)."""
    return 1.2 + 0.5 * np.tanh(activation @ [0.4, 0.6, 0.8, -0.2, -0.9])


def positions(reference, angle, own):
    """Positions [mm] (cases, nodes, 3): each amount is a polynomial of (angle, own)."""
    amounts = [angle - 1.2, (angle - 1.2) ** 2, own, own * (angle - 1.2)]
    size = (6.0, 2.0, 1.0, 0.5)
    moved = sum(s * c[:, None, None] * (reference @ m / SIDE) for s, c, m in zip(size, amounts, SHAPES, strict=True))
    return reference + moved


def stresses(reference, angle, own):
    """Cauchy stress [MPa] (cases, nodes, 6)."""
    amounts = [np.ones_like(own), own, own * angle]
    return sum(c[:, None, None] * (1 + reference @ m.T / SIDE) for c, m in zip(amounts, STRESSES, strict=True))


def von_mises(stress):
    """Von Mises stress [MPa]."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    return np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (yz**2 + xz**2 + xy**2))


def block(support=120, off_grid=24, known_angle=True):
    """27 nodes; factorial, support and off-grid cases of the biceps."""
    generator = np.random.default_rng(3)
    factorial = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    drawn = generator.integers(0, 11, size=(support, 5)) / 10
    activation = np.concatenate([factorial, drawn, generator.uniform(size=(off_grid, 5))])
    body = Body(HEX27.nodes * SIDE, np.zeros((0, 4), dtype=np.int64), np.arange(27)[None])
    angle, own = angles(activation), activation[:, OWN]
    stress = stresses(body.reference, angle, own)
    fields = {
        "position": positions(body.reference, angle, own),
        "cauchy_stress": stress,
        "von_mises": von_mises(stress),
        "fibre_stretch": 1 + 0.2 * (angle - 1.2)[:, None] * body.reference[:, 0] / SIDE,
    }
    return cases_in_memory(
        "biceps",
        body,
        activation,
        ["factorial"] * 32 + ["support"] * support + ["off_grid"] * off_grid,
        {name: values.astype(np.float32) for name, values in fields.items()},
        angle if known_angle else None,
    )
