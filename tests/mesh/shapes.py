"""Bodies whose surface and volume are known."""

from itertools import product

import numpy as np

from myograph.mesh.surface import closed_surface, skin_of
from myograph.mesh.sweep import Resolution, Tube, sweep
from myograph.mesh.tetrahedra import EDGES

FINE = Resolution(core=4, rings=1, along=24)


def box_triangles(size=(1.0, 1.0, 1.0), cells=(1, 1, 1)):
    """Points and outward triangles of a box whose faces are grids."""
    points, triangles = [], []
    for axis in range(3):
        one, other = (axis + 1) % 3, (axis + 2) % 3
        u, v = np.arange(cells[one] + 1), np.arange(cells[other] + 1)
        for side in (0, 1):
            grid = np.zeros((len(u), len(v), 3))
            grid[..., axis] = side
            grid[..., one], grid[..., other] = np.meshgrid(u / cells[one], v / cells[other], indexing="ij")
            index = len(points) + np.arange(len(u) * len(v)).reshape(len(u), len(v))
            points += (grid.reshape(-1, 3) * size).tolist()
            a, b, c, d = index[:-1, :-1].ravel(), index[1:, :-1].ravel(), index[1:, 1:].ravel(), index[:-1, 1:].ravel()
            quads = np.stack([a, b, c, d], axis=1)[:, :: 1 if side else -1]
            triangles += [*quads[:, [0, 1, 2]].tolist(), *quads[:, [0, 2, 3]].tolist()]
    return np.array(points), np.array(triangles)


def box(size=(1.0, 1.0, 1.0), cells=(1, 1, 1)):
    return closed_surface(*box_triangles(size, cells), "box")


def spindle_mesh(ends=6.0, middle=18.0, length=100.0, size=FINE):
    """Swept hexahedra of round sections, slim at the ends, along z."""
    stations = 2 * size.along + 1
    share = np.linspace(0, 1, stations)
    radius = ends + (middle - ends) * np.sin(np.pi * share) ** 2
    centres = np.outer(share * length, [0.0, 0.0, 1.0])
    return sweep(Tube(centres, np.pi * radius**2, np.ones(stations), np.array([0.0, 1.0, 0.0]), length), size)


def spindle(**sizes):
    return skin_of(spindle_mesh(**sizes))


def box_of_tetrahedra(size=(1.0, 1.0, 1.0), cells=(1, 1, 1)):
    """Nodes and 10-node cells: every small box is cut into six tetrahedra around its diagonal."""
    counts = np.array(cells) + 1
    index = np.arange(counts.prod()).reshape(counts)
    corners = np.stack(
        np.meshgrid(*(np.linspace(0, s, n) for s, n in zip(size, counts, strict=True)), indexing="ij"), -1
    )
    tetrahedra = []
    for start in product(*(range(n) for n in cells)):
        for path in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (0, 2, 1), (2, 1, 0)):
            place, along = np.array(start), [np.array(start)]
            for axis in path:
                place = place + np.eye(3, dtype=int)[axis]
                along.append(place)
            four = [int(index[tuple(p)]) for p in along]
            tetrahedra.append(four if path in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else [four[k] for k in (0, 2, 1, 3)])
    points = corners.reshape(-1, 3)
    edges = np.sort(np.array(tetrahedra)[:, EDGES], axis=2).reshape(-1, 2)
    ends, which = np.unique(edges, axis=0, return_inverse=True)
    cells10 = np.column_stack([tetrahedra, len(points) + which.reshape(-1, 6)])
    return np.vstack([points, points[ends].mean(axis=1)]), cells10
