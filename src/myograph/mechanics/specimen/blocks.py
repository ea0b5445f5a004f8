"""Straight hexahedra on lattices, block by block, with named faces.

A block's six sides carry names in the order first direction low and high, second low and high, third low and high; a
side without a name lies inside the body, against another block.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

Place = Callable[[Float[np.ndarray, "vertices 3"]], Float[np.ndarray, "vertices 3"]]
Sides = tuple[str | None, str | None, str | None, str | None, str | None, str | None]
BOX_SIDES: Sides = ("x_min", "x_max", "y_min", "y_max", "z_min", "z_max")

_CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
_SAME_PLACE = 9
"""Decimals, relative to the body's size, to which vertices of neighbouring blocks agree."""


@dataclass(frozen=True)
class Lattice:
    """Vertices, hexahedra (bottom counter-clockwise, then top), and quadrilaterals by face, outward normal.

    The first vertex of a quadrilateral is the lowest of its lattice.
    """

    points: Float[np.ndarray, "vertices 3"]
    cells: Int[np.ndarray, "cells 8"]
    faces: dict[str, Int[np.ndarray, "_ 4"]]


def block(axes: Sequence[Float[np.ndarray, " _"]], place: Place, sides: Sides) -> Lattice:
    """One block: the lattice of three rising sequences of coordinates, moved by `place`, which keeps orientation."""
    counts = [len(axis) for axis in axes]
    numbers = np.arange(np.prod(counts)).reshape(counts)
    coordinates = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    inner = [slice(0, count - 1) for count in counts]
    outer = [slice(1, count) for count in counts]
    corners = [numbers[tuple(outer[d] if c[d] else inner[d] for d in range(3))].ravel() for c in _CORNERS]
    faces = {name: _side(numbers, k // 2, k % 2) for k, name in enumerate(sides) if name}
    return Lattice(place(coordinates), np.stack(corners, axis=1), faces)


def merged(blocks: Sequence[Lattice]) -> Lattice:
    """One lattice of several blocks: vertices at the same place become one, faces of the same name are joined."""
    points = np.concatenate([each.points for each in blocks])
    size = np.abs(points).max()
    _, first, number = np.unique(np.round(points / size, _SAME_PLACE), axis=0, return_index=True, return_inverse=True)
    starts = np.cumsum([0, *(len(each.points) for each in blocks)])
    cells = [number[each.cells + start] for each, start in zip(blocks, starts, strict=False)]
    faces: dict[str, list[np.ndarray]] = {}
    for each, start in zip(blocks, starts, strict=False):
        for name, quads in each.faces.items():
            faces.setdefault(name, []).append(number[quads + start])
    return Lattice(points[first], np.concatenate(cells), {name: np.concatenate(q) for name, q in faces.items()})


def tetrahedra(cells: Int[np.ndarray, "cells 8"]) -> Int[np.ndarray, "tetrahedra 4"]:
    """Six tetrahedra around the main diagonal of each hexahedron; neighbours agree on the diagonals of their faces."""
    paths = ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))
    return np.concatenate([cells[:, [0, a, b, 6]] for a, b in paths])


def triangles(quads: Int[np.ndarray, "quads 4"]) -> Int[np.ndarray, "triangles 3"]:
    """Two triangles of each quadrilateral, along the diagonal from its lowest vertex."""
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _side(numbers: Int[np.ndarray, "_ _ _"], direction: int, high: int) -> Int[np.ndarray, "_ 4"]:
    flat = np.take(numbers, -1 if high else 0, axis=direction)
    a, b, c, d = flat[:-1, :-1], flat[1:, :-1], flat[1:, 1:], flat[:-1, 1:]
    outward = bool(high) == (direction != 1)
    order = (a, b, c, d) if outward else (a, d, c, b)
    return np.stack([corner.ravel() for corner in order], axis=1)
