"""The along-muscle coordinate and the section areas of a body that was not swept along a line.

Both come from the potential u between origin and insertion. Its level surfaces are the sections, their middles the
centre line. With the flux Φ = ∫ |∇u|² dV, a step of the line is about ds = A du / Φ, so that the rough length below a
level is s = Σ w |∇u| / Φ over the integration points (of volume w) below it; the line through the middles of slabs of
equal rough length gives the true one. The area of a section is A(s) = dV/ds, smoothed.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.interpolate import PchipInterpolator
from scipy.signal import savgol_filter

from myograph.errors import InputError
from myograph.mesh.laplace import potential, space_gradients
from myograph.mesh.tetrahedra import TET10, subdivided_rule

SLABS = 100
_MIDDLES = (np.arange(SLABS) + 0.5) / SLABS
_WINDOW = 7
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
class _Samples:
    """Integration points in the order of their potential: potential, slope [1/mm], place [mm], volume [mm³]."""

    level: Float[np.ndarray, " samples"]
    slope: Float[np.ndarray, " samples"]
    place: Float[np.ndarray, "samples 3"]
    volume: Float[np.ndarray, " samples"]

    @property
    def steps(self) -> Float[np.ndarray, " samples"]:
        """Rough length [mm] that each point adds to the line."""
        return self.volume * self.slope / (self.volume @ self.slope**2)


def stations(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 10"], ends: Ends, name: str
) -> Stations:
    """Coordinate and areas of a body of tetrahedra between two faces of nodes; `name` is for messages.

    Raises InputError where a part of the body lies beside the way from face to face: fibres have no direction there.
    """
    values = potential(TET10, points, cells, ends)
    samples = _samples(points, cells, values)
    steps = samples.steps
    total, rough = float(steps.sum()), np.cumsum(steps) - 0.5 * steps
    share, length = _centre_line(samples, rough / total, points[ends[0]].mean(axis=0), points[ends[1]].mean(axis=0))
    slab = _slab(share(rough / total))
    sections = np.bincount(slab, samples.volume, SLABS) * SLABS / length
    if sections.min() <= 0:
        raise InputError(f"mesh of {name}: its elements are as long as the body; choose a smaller element size")
    _check_directions(samples, sections[slab], name)
    below = np.interp(values, np.hstack([0.0, samples.level, 1.0]), np.hstack([0.0, rough / total, 1.0]))
    along = np.clip(share(below), 0.0, 1.0)
    along[ends[0]], along[ends[1]] = 0.0, 1.0
    smooth = savgol_filter(np.log(sections), _WINDOW, 2)
    return Stations(along, np.exp(np.interp(along, _MIDDLES, np.asarray(smooth))), length)


def _centre_line(
    samples: _Samples, rough: Float[np.ndarray, " samples"], start: np.ndarray, end: np.ndarray
) -> tuple[PchipInterpolator, float]:
    """Function from the share of the rough length to that of the true one, and the true length [mm]."""
    slab, steps = _slab(rough), samples.steps
    weight = np.maximum(np.bincount(slab, steps, SLABS), 1e-300)
    middles = np.stack([np.bincount(slab, steps * x, SLABS) / weight for x in samples.place.T], axis=1)
    line = np.vstack([start, middles, end])
    reached = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    return PchipInterpolator(np.hstack([0.0, _MIDDLES, 1.0]), reached / reached[-1]), float(reached[-1])


def _slab(share: Float[np.ndarray, " samples"]) -> Int[np.ndarray, " samples"]:
    return np.clip((share * SLABS).astype(int), 0, SLABS - 1)


def _samples(
    points: Float[np.ndarray, "nodes 3"], cells: Int[np.ndarray, "cells 10"], values: Float[np.ndarray, " nodes"]
) -> _Samples:
    rule = subdivided_rule()
    gradients, volumes = space_gradients(TET10, points, cells, rule)
    shape = TET10.values(rule[0])
    level = (values[cells] @ shape.T).ravel()
    slope = np.linalg.norm(np.einsum("cqna,cn->cqa", gradients, values[cells]), axis=2).ravel()
    place = np.einsum("qn,cna->cqa", shape, points[cells]).reshape(-1, 3)
    order = np.argsort(level)
    return _Samples(level[order], slope[order], place[order], volumes.ravel()[order])


def _check_directions(samples: _Samples, section: Float[np.ndarray, " samples"], name: str) -> None:
    """The flux through a section is that through all; where a part of it carries none, no fibres lead through."""
    flux = samples.volume @ samples.slope**2
    still = samples.slope * section < _STILL * flux
    volume = float(samples.volume[still].sum())
    if volume > _STILL_SHARE * samples.volume.sum():
        centre = (samples.volume[still] @ samples.place[still] / volume).round(1).tolist()
        raise InputError(
            f"mesh of {name}: the fibres have no direction in {volume / 1000:.2f} cm³ around {centre} mm, which lie"
            " beside the way from the origin to the insertion; expected the two at the ends of the body: move them,"
            " attach that part too, or cut it off"
        )
