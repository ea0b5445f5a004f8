"""Shapes of specimens [mm]: box, plane panel, sectors of a thick cylinder and of a thick sphere.

Each is a lattice of straight hexahedra; a curved one also says where a point of the straight body really lies. Faces
have names; those that are planes across a coordinate axis can be planes of symmetry.
"""

from dataclasses import dataclass
from math import isfinite, pi
from typing import Any, Protocol, runtime_checkable

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.mechanics.specimen.blocks import BOX_SIDES, Lattice, block, merged

Vector = tuple[float, float, float]


@runtime_checkable
class Shape(Protocol):
    """What a mesh can be made of."""

    @property
    def planes(self) -> dict[str, int]:
        """Faces that lie across a coordinate axis, and which: 0, 1, 2."""
        ...

    def lattice(self) -> Lattice:
        """Straight hexahedra."""
        ...

    def curved(self, place: tuple[Any, Any, Any]) -> tuple[Any, Any, Any] | None:
        """Where a point of the straight body lies in the reference body (NGSolve functions); None where just there."""
        ...


@dataclass(frozen=True)
class Box:
    """Cube or bar with a corner at the origin; faces x_min, x_max, y_min, y_max, z_min, z_max.

    Parameters
    ----------
    size
        Edges along x, y, z [mm].
    cells
        Elements along x, y, z.
    distortion
        How far inner vertices are moved at random from their places, over a cell's edge [-]; under 0.4. The same
        every time.
    """

    size: Vector = (1.0, 1.0, 1.0)
    cells: tuple[int, int, int] = (1, 1, 1)
    distortion: float = 0.0

    def __post_init__(self) -> None:
        _require_positive("size of the box", self.size)
        _require_counts("cells of the box", self.cells)
        if not 0 <= self.distortion < 0.4:
            raise InputError(f"distortion of the box: expected a number in [0, 0.4), got {self.distortion!r}")

    @property
    def planes(self) -> dict[str, int]:
        """All six faces."""
        return {name: k // 2 for k, name in enumerate(BOX_SIDES) if name}

    def lattice(self) -> Lattice:
        """Straight hexahedra."""
        axes = [np.linspace(0, edge, count + 1) for edge, count in zip(self.size, self.cells, strict=True)]
        return block(axes, self._distorted, BOX_SIDES)

    def curved(self, place: tuple[Any, Any, Any]) -> tuple[Any, Any, Any] | None:
        """Nothing is curved."""
        return None

    def _distorted(self, points: Float[np.ndarray, "vertices 3"]) -> Float[np.ndarray, "vertices 3"]:
        size = np.array(self.size)
        inside = ((points > 1e-9 * size) & (points < (1 - 1e-9) * size)).all(axis=1, keepdims=True)
        shift = np.random.default_rng(0).uniform(-1, 1, points.shape)
        return points + self.distortion * size / np.array(self.cells) * inside * shift


@dataclass(frozen=True)
class Panel:
    """Plane quadrilateral of even thickness, one element thick; faces named as those of a box.

    Parameters
    ----------
    corners
        In the plane z = 0, counter-clockwise [mm]; x_min runs from the fourth to the first, y_min from the first to
        the second.
    thickness
        Along z [mm].
    cells
        Elements along the first and the second pair of sides.
    """

    corners: tuple[tuple[float, float], tuple[float, float], tuple[float, float], tuple[float, float]]
    thickness: float = 1.0
    cells: tuple[int, int] = (1, 1)

    def __post_init__(self) -> None:
        _require_positive("thickness of the panel", (self.thickness,))
        _require_counts("cells of the panel", self.cells)
        here = np.array(self.corners, dtype=float)
        ahead, back = np.roll(here, -1, axis=0) - here, np.roll(here, 1, axis=0) - here
        if not (ahead[:, 0] * back[:, 1] - ahead[:, 1] * back[:, 0] > 0).all():
            raise InputError(f"corners of the panel: expected four, convex, counter-clockwise, got {self.corners!r}")

    @property
    def planes(self) -> dict[str, int]:
        """Top and bottom."""
        return {"z_min": 2, "z_max": 2}

    def lattice(self) -> Lattice:
        """Straight hexahedra."""
        axes = [np.linspace(0, 1, count + 1) for count in (*self.cells, 1)]
        return block(axes, self._bilinear, BOX_SIDES)

    def curved(self, place: tuple[Any, Any, Any]) -> tuple[Any, Any, Any] | None:
        """Nothing is curved."""
        return None

    def _bilinear(self, points: Float[np.ndarray, "vertices 3"]) -> Float[np.ndarray, "vertices 3"]:
        a, b, z = points.T
        weights = np.stack([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b], axis=1)
        return np.column_stack([weights @ np.array(self.corners, dtype=float), self.thickness * z])


@dataclass(frozen=True)
class ThickCylinder:
    """Quarter of a tube around the z axis; faces inner, outer, x_min (x = 0), y_min (y = 0), z_min, z_max.

    Parameters
    ----------
    inner, outer
        Radii [mm].
    length
        Along z [mm].
    cells
        Elements through the wall, around the quarter, along z.
    """

    inner: float
    outer: float
    length: float = 1.0
    cells: tuple[int, int, int] = (4, 4, 1)

    def __post_init__(self) -> None:
        _require_radii("cylinder", self.inner, self.outer)
        _require_positive("length of the cylinder", (self.length,))
        _require_counts("cells of the cylinder", self.cells)

    @property
    def planes(self) -> dict[str, int]:
        """All plane faces."""
        return {"x_min": 0, "y_min": 1, "z_min": 2, "z_max": 2}

    def lattice(self) -> Lattice:
        """A box of radius, angle and height."""
        ends = ((self.inner, self.outer), (0.0, pi / 2), (0.0, self.length))
        axes = [np.linspace(*pair, count + 1) for pair, count in zip(ends, self.cells, strict=True)]
        return block(axes, lambda points: points, ("inner", "outer", "y_min", "x_min", "z_min", "z_max"))

    def curved(self, place: tuple[Any, Any, Any]) -> tuple[Any, Any, Any] | None:
        """(r cos φ, r sin φ, z)."""
        radius, angle, height = place
        return radius * ngs.cos(angle), radius * ngs.sin(angle), height


@dataclass(frozen=True)
class ThickSphere:
    """Eighth of a hollow sphere around the origin; faces inner, outer, x_min (x = 0), y_min (y = 0), z_min (z = 0).

    Parameters
    ----------
    inner, outer
        Radii [mm].
    cells
        Elements through the wall, and along half an edge of the eighth.
    """

    inner: float
    outer: float
    cells: tuple[int, int] = (4, 3)

    def __post_init__(self) -> None:
        _require_radii("sphere", self.inner, self.outer)
        _require_counts("cells of the sphere", self.cells)

    @property
    def planes(self) -> dict[str, int]:
        """The three planes through the centre."""
        return {"x_min": 0, "y_min": 1, "z_min": 2}

    def lattice(self) -> Lattice:
        """The eighth of a hollow cube, in three blocks that meet along its diagonal."""
        wall = np.linspace(self.inner, self.outer, self.cells[0] + 1)
        across = np.tan(np.linspace(0, pi / 4, self.cells[1] + 1))
        blocks = []
        for k in range(3):
            low = (f"{'xyz'[(k + 1) % 3]}_min", f"{'xyz'[(k + 2) % 3]}_min")
            sides = ("inner", "outer", low[0], None, low[1], None)
            blocks.append(block((wall, across, across), _Frustum(k), sides))
        return merged(blocks)

    def curved(self, place: tuple[Any, Any, Any]) -> tuple[Any, Any, Any] | None:
        """The cube's surfaces, on which the largest coordinate is constant, become spheres of that radius."""
        x, y, z = place
        largest = ngs.IfPos(x - y, ngs.IfPos(x - z, x, z), ngs.IfPos(y - z, y, z))
        scale = largest / ngs.sqrt(x * x + y * y + z * z)
        return scale * x, scale * y, scale * z


@dataclass(frozen=True)
class _Frustum:
    """Lattice (s, η, ζ) to the point with coordinate s along axis k, s η and s ζ along the two that follow."""

    k: int

    def __call__(self, points: Float[np.ndarray, "vertices 3"]) -> Float[np.ndarray, "vertices 3"]:
        s, eta, zeta = points.T
        return np.roll(np.stack([s, s * eta, s * zeta], axis=1), self.k, axis=1)


def _require_positive(what: str, values: tuple[float, ...]) -> None:
    if not all(isfinite(value) and value > 0 for value in values):
        raise InputError(f"{what}: expected positive numbers of mm, got {values!r}")


def _require_counts(what: str, counts: tuple[int, ...]) -> None:
    if not all(isinstance(count, int) and count >= 1 for count in counts):
        raise InputError(f"{what}: expected whole numbers from 1 on, got {counts!r}")


def _require_radii(what: str, inner: float, outer: float) -> None:
    _require_positive(f"radii of the {what}", (inner, outer))
    if outer <= inner:
        raise InputError(f"radii of the {what}: expected inner < outer, got {inner:g} and {outer:g}")
