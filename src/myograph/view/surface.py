"""Surfaces of quadrilaterals: what pictures are made of."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError


@dataclass(frozen=True)
class Surface:
    """The skin of a body.

    Parameters
    ----------
    points
        Nodes [mm]; those that no quadrilateral uses are not drawn.
    quads
        Corners of the quadrilaterals; counter-clockwise seen from outside.
    name
        For the legend; surfaces of one name share an entry, an empty name has none.
    colour
        Of the belly, as '#rrggbb'.
    tendon
        Fraction of tendon at each node, 0 (belly) to 1 (tendon, white); None where all is belly.
    """

    points: Float[np.ndarray, "nodes 3"]
    quads: Int[np.ndarray, "facets 4"]
    name: str
    colour: str
    tendon: Float[np.ndarray, " nodes"] | None = None

    def __post_init__(self) -> None:
        if len(self.quads) == 0 or self.quads.min() < 0 or self.quads.max() >= len(self.points):
            raise InputError(
                f"surface '{self.name}': expected quadrilaterals with corners among the {len(self.points)} points, "
                f"got {len(self.quads)} with corners {self.quads.min(initial=0)} to {self.quads.max(initial=-1)}"
            )
        if not np.isfinite(self.points[self.quads]).all():
            raise InputError(f"surface '{self.name}': expected finite coordinates, got NaN or infinity")


def node_normals(
    points: Float[np.ndarray, "nodes 3"], quads: Int[np.ndarray, "facets 4"]
) -> Float[np.ndarray, "nodes 3"]:
    """Outward unit normals: mean over the quadrilaterals around each node, weighted by their area."""
    a, b, c, d = np.moveaxis(points[quads], 1, 0)
    area_normal = np.cross(c - a, d - b)
    normals = np.zeros_like(points, dtype=float)
    for corner in range(4):
        np.add.at(normals, quads[:, corner], area_normal)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(length > 0, length, 1.0)


def capsule(
    start: Float[np.ndarray, " 3"], end: Float[np.ndarray, " 3"], radius: float, name: str, colour: str
) -> Surface:
    """Cylinder of `radius` [mm] from `start` to `end` [mm] with half a ball on each end, for a bone.

    A grid of longitudes and latitudes; each pole is one node, so that the surface is closed.
    """
    length = float(np.linalg.norm(end - start))
    if not (radius > 0 and length > 0):
        raise InputError(f"capsule '{name}': expected a radius and a length above 0, got {radius} and {length} mm")
    latitude = np.linspace(-np.pi / 2, np.pi / 2, 18)
    low, high = latitude[:9], latitude[9:]
    barrel = np.linspace(0, length, 13)
    height = np.concatenate([radius * np.sin(low), barrel, length + radius * np.sin(high)])
    width = np.concatenate([radius * np.cos(low), np.full(13, radius), radius * np.cos(high)])
    turn = np.linspace(0, 2 * np.pi, 32, endpoint=False)
    along = (end - start) / length
    first = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
    first /= np.linalg.norm(first)
    circle = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * np.cross(along, first)
    rings = start + height[:, None, None] * along + width[:, None, None] * circle
    points = np.concatenate([rings[0, :1], rings[1:-1].reshape(-1, 3), rings[-1, :1]])
    node = np.clip(np.arange(rings[..., 0].size).reshape(len(height), -1) - len(turn) + 1, 0, len(points) - 1)
    following = np.roll(node, -1, axis=1)
    quads = np.stack([node[:-1], following[:-1], following[1:], node[1:]], axis=-1).reshape(-1, 4)
    return Surface(points, quads, name, colour)
