"""The along-muscle coordinate and the section areas of a body that was not swept along a line.

Both come from the potential u between origin and insertion, whose level surfaces are the sections. With the flux
Φ = ∫ |∇u|² dV and the area A(u) of a level surface, a step along the muscle is ds = A du / Φ = (∫ |∇u| dV over the
slab) / Φ; s is scaled to the length of the line through the middles of the sections. The area of a section is
A(s) = dV/ds, smoothed. The integrals over slabs are exact for a potential that is linear on the eight small
tetrahedra that the nodes of each element make.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.interpolate import PchipInterpolator
from scipy.signal import savgol_filter

from myograph.errors import InputError
from myograph.mesh.laplace import potential
from myograph.mesh.tetrahedra import SMALL, TET10

_LEVELS, _SECTIONS, _LINE, _WINDOW = 300, 100, 25, 7
_STILL, _STILL_SHARE = 0.01, 0.0005
"""Gradient over that of its section below which fibres have no direction, and the share of the volume that may."""

Ends = tuple[Int[np.ndarray, " origin"], Int[np.ndarray, " insertion"]]


@dataclass(frozen=True)
class Stations:
    """Where the nodes are along the muscle, the section areas there [mm²], the centre line's length [mm]."""

    along: Float[np.ndarray, " nodes"]
    area: Float[np.ndarray, " nodes"]
    length: float


@dataclass(frozen=True)
class _Pieces:
    """Small tetrahedra: potential at the corners in rising order, slope [1/mm], middle [mm], share of the curved
    element's volume [mm³]."""

    levels: Float[np.ndarray, "pieces 4"]
    slope: Float[np.ndarray, " pieces"]
    middle: Float[np.ndarray, "pieces 3"]
    volume: Float[np.ndarray, " pieces"]

    def below(
        self, level: Float[np.ndarray, " levels"], weights: Float[np.ndarray, "pieces sums"]
    ) -> Float[np.ndarray, "levels sums"]:
        """For each level, the weights summed over the shares of the pieces that lie below it."""
        return np.stack([_share_below(each, self.levels) @ weights for each in level])


def stations(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 10"], ends: Ends, name: str
) -> Stations:
    """Coordinate and areas of a body of tetrahedra between two faces of nodes; `name` is for messages.

    Raises InputError where a part of the body lies beside the way from face to face: fibres have no direction there.
    """
    values = np.clip(potential(TET10, points, cells, ends), 0.0, 1.0)
    pieces = _pieces(points, cells, values)
    levels = np.unique(np.quantile(values, np.linspace(0, 1, _LEVELS)))
    flux = pieces.volume @ pieces.slope**2
    steps = pieces.volume * pieces.slope / flux
    sums = pieces.below(levels, np.column_stack([steps, pieces.volume, steps[:, None] * pieces.middle]))
    rising = np.concatenate([[True], np.diff(sums[:, 0]) > 1e-9 * sums[-1, 0]])
    levels, sums = levels[rising], sums[rising]
    share = sums[:, 0] / sums[-1, 0]
    length = _line_length(share, sums[:, 2:] / sums[-1, 0], points[ends[0]].mean(axis=0), points[ends[1]].mean(axis=0))
    along = np.clip(np.interp(values, levels, share), 0.0, 1.0)
    edges = np.linspace(0, 1, _SECTIONS + 1)
    sections = np.diff(np.interp(edges, share, sums[:, 1])) * _SECTIONS / length
    _check_directions(
        pieces, np.interp(pieces.levels.mean(axis=1), levels[1:], np.diff(sums[:, 1]) / np.diff(levels)), name
    )
    smooth = np.asarray(savgol_filter(np.log(sections), _WINDOW, 2))
    return Stations(along, np.exp(np.interp(along, edges[:-1] + 0.5 / _SECTIONS, smooth)), length)


def _pieces(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 10"], values: Float[np.ndarray, " nodes"]
) -> _Pieces:
    corners = cells[:, SMALL].reshape(-1, 4)
    places, levels = points[corners], values[corners]
    sides = places[:, 1:] - places[:, :1]
    slope = np.linalg.norm(np.linalg.solve(sides, (levels[:, 1:] - levels[:, :1])[..., None])[..., 0], axis=1)
    straight = np.abs(np.linalg.det(sides)).reshape(len(cells), -1)
    volume = straight * (TET10.volumes(points, cells).sum(axis=1) / straight.sum(axis=1))[:, None]
    return _Pieces(np.sort(levels, axis=1), slope, places.mean(axis=1), volume.ravel())


def _share_below(level: float, corners: Float[np.ndarray, "pieces 4"]) -> Float[np.ndarray, " pieces"]:
    """Share of each tetrahedron in which a linear function with these values at the corners, rising, is below a level.

    A corner is cut off below the second value and above the third; between them, three tetrahedra lie below.
    """
    a, b, c, d = corners.T

    def ratio(low: np.ndarray, high: np.ndarray) -> np.ndarray:
        return np.clip((level - low) / np.maximum(high - low, 1e-300), 0.0, 1.0)

    ac, ad, bc, bd = ratio(a, c), ratio(a, d), ratio(b, c), ratio(b, d)
    between = bc * bd + ac * bd * (1 - bc) + ac * ad * (1 - bd)
    above = 1 - (1 - ratio(a, d)) * (1 - bd) * (1 - ratio(c, d))
    return np.where(level < b, ratio(a, b) * ac * ad, np.where(level < c, between, above))


def _line_length(
    share: Float[np.ndarray, " levels"], sums: Float[np.ndarray, "levels 3"], start: np.ndarray, end: np.ndarray
) -> float:
    """Length [mm] of the line through the middles of slabs of equal steps, from the one face to the other."""
    at = np.linspace(0, 1, _LINE + 1)
    middles = np.diff(PchipInterpolator(share, sums)(at), axis=0) * _LINE
    return float(np.linalg.norm(np.diff(np.vstack([start, middles, end]), axis=0), axis=1).sum())


def _check_directions(pieces: _Pieces, growth: Float[np.ndarray, " pieces"], name: str) -> None:
    """`growth` is dV/du = A² / Φ of the section through each piece, where slopes should be near Φ / A."""
    usual = np.sqrt(pieces.volume @ pieces.slope**2 / np.maximum(growth, 1e-300))
    still = pieces.slope < _STILL * usual
    volume = float(pieces.volume[still].sum())
    if volume > _STILL_SHARE * pieces.volume.sum():
        centre = (pieces.volume[still] @ pieces.middle[still] / volume).round(1).tolist()
        raise InputError(
            f"mesh of {name}: the fibres have no direction in {volume / 1000:.2f} cm³ around {centre} mm, which lie"
            " beside the way from the origin to the insertion; expected the two at the ends of the body: move them,"
            " attach that part too, or cut it off"
        )
