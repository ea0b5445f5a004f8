r"""A muscle from samples of its force and a lever arm: M(θ, a) = ± F(θ, a) l(θ).

The samples lie on a sparse grid of Clenshaw–Curtis points, whose levels and indices are found from the coordinates, or
on a full grid of any angles and activations. F is a cubic spline: hierarchical (modified Clenshaw–Curtis) or a tensor
product (not-a-knot). l is a polynomial in the angle in degrees, as lever arms are printed.
Source: Valentin, Sprenger, Pflüger, Röhrle 2018.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float
from numpy.polynomial import Polynomial
from scipy.interpolate import RectBivariateSpline

from myograph.errors import InputError
from myograph.interpolation import Domain, SparseGrid, basis, interpolate, tree
from myograph.limb.moment import MomentCurve, MuscleMoment, curve_of
from myograph.limb.spline_moment import SplineMoment
from myograph.units import degrees

MOST_LEVELS = 9
"""Finest level that is believed: finer points lie nearer to each other than printed coordinates tell."""
ON_GRID = 1e-6
"""How far a coordinate may lie from a Clenshaw–Curtis point, over the width of the range; print rounds."""


@dataclass(frozen=True, eq=False)
class TabulatedForce:
    """A `MuscleMoment` made of a force and a lever arm.

    Parameters
    ----------
    force
        Tension over (angle [rad], activation): `moment` means N here.
    lever
        Lever arm [mm] over the angle in degrees, times 1 for a flexor and -1 for an extensor.
    """

    force: MuscleMoment
    lever: Polynomial

    def moment(self, angles: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
        """Moments [N*mm] at angles [rad]; raises InputError outside the samples' range."""
        return self.force.moment(angles, activation) * self.lever(np.degrees(angles))

    def moment_gradient(self, angle: float, activation: float) -> tuple[float, float, float]:
        """M [N*mm], dM/dangle [N*mm/rad] and dM/dactivation [N*mm]."""
        force, by_angle, by_activation = self.force.moment_gradient(angle, activation)
        lever = float(self.lever(degrees(angle)))
        turn = degrees(float(self._slope(degrees(angle))))
        return force * lever, by_angle * lever + force * turn, by_activation * lever

    def curve(self, activation: float) -> MomentCurve:
        """The moment over the angle alone."""
        return _LeverCurve(curve_of(self.force, activation), self.lever)

    @cached_property
    def _slope(self) -> Polynomial:
        return self.lever.deriv()


@dataclass(frozen=True)
class _LeverCurve:
    force: MomentCurve
    lever: Polynomial

    def __call__(self, angles: Float[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        return self.force(angles) * self.lever(np.degrees(angles))

    def at(self, angle: float) -> float:
        lever = 0.0
        for coefficient in reversed(self.lever.coef):
            lever = lever * degrees(angle) + coefficient
        return self.force.at(angle) * float(lever)


class FullGridForce:
    """A force [N] on a full grid of angles [rad] and activations; cubic not-a-knot spline in both.

    Raises InputError for fewer than four angles or activations.
    """

    def __init__(
        self,
        angles: Float[np.ndarray, " angles"],
        activations: Float[np.ndarray, " levels"],
        forces: Float[np.ndarray, "angles levels"],
    ) -> None:
        if len(angles) < 4 or len(activations) < 4:
            raise InputError(
                f"expected at least 4 angles and 4 activations on a full grid, got {len(angles)} and {len(activations)}"
            )
        self._bounds = ((angles[0], angles[-1]), (activations[0], activations[-1]))
        self._spline = RectBivariateSpline(angles, activations, forces, kx=3, ky=3, s=0)

    def moment(self, angles: Float[np.ndarray, " points"], activation: float) -> Float[np.ndarray, " points"]:
        """Forces [N] at angles [rad]; raises InputError outside the samples' range."""
        if angles.size:
            self._check(float(angles.min()), activation)
            self._check(float(angles.max()), activation)
        return self._spline.ev(angles, activation)

    def moment_gradient(self, angle: float, activation: float) -> tuple[float, float, float]:
        """Force [N] and its derivatives by angle [N/rad] and activation [N]."""
        self._check(angle, activation)
        value, by_angle, by_activation = (
            float(self._spline.ev(angle, activation, dx=dx, dy=dy)) for dx, dy in ((0, 0), (1, 0), (0, 1))
        )
        return value, by_angle, by_activation

    def _check(self, angle: float, activation: float) -> None:
        for value, (low, high), what in zip((angle, activation), self._bounds, ("angle", "activation"), strict=True):
            slack = 1e-9 * (high - low)
            if not low - slack <= value <= high + slack:
                raise InputError(f"{what}: expected {low:g} to {high:g}, got {value:g}")


def tabulated_force(
    samples: Float[np.ndarray, "samples 3"], angle_range: tuple[float, float], lever: Polynomial
) -> TabulatedForce:
    """A muscle from rows (angle [rad], activation, tension [N]) in any order.

    Raises InputError where a number is missing, a point comes twice, or the points are neither a full grid that covers
    the range nor a sparse grid of Clenshaw–Curtis points on it.
    """
    bad = np.flatnonzero(~np.isfinite(samples).all(axis=1))
    if len(bad):
        raise InputError(f"expected numbers, got {samples[bad[0]].tolist()} in sample {bad[0] + 1}")
    angles, activations = np.unique(samples[:, 0]), np.unique(samples[:, 1])
    if len(angles) * len(activations) == len(samples):
        return TabulatedForce(_full(samples, (angles, activations), angle_range), lever)
    return TabulatedForce(_sparse(samples, angle_range), lever)


def _full(samples: np.ndarray, axes: tuple[np.ndarray, np.ndarray], angle_range: tuple[float, float]) -> FullGridForce:
    angles, activations = axes
    order = np.lexsort((samples[:, 1], samples[:, 0]))
    expected = np.stack(np.meshgrid(angles, activations, indexing="ij"), axis=-1).reshape(-1, 2)
    if not np.array_equal(samples[order, :2], expected):
        raise InputError("expected every angle with every activation once, got a point twice")
    slack = ON_GRID * (angle_range[1] - angle_range[0])
    covered = angles[0] <= angle_range[0] + slack and angles[-1] >= angle_range[1] - slack
    if not covered or activations[0] > 0 or activations[-1] < 1:
        raise InputError(
            f"expected samples from {degrees(angle_range[0]):g} to {degrees(angle_range[1]):g} degrees and activations"
            f" from 0 to 1, got {degrees(angles[0]):g} to {degrees(angles[-1]):g} and {activations[0]:g} to"
            f" {activations[-1]:g}"
        )
    return FullGridForce(angles, activations, samples[order, 2].reshape(len(angles), len(activations)))


def _sparse(samples: np.ndarray, angle_range: tuple[float, float]) -> SplineMoment:
    domain = Domain(np.array([angle_range[0], 0.0]), np.array([angle_range[1], 1.0]))
    grid = clenshaw_curtis_grid((samples[:, :2] - domain.lower) / domain.widths)
    name = "clenshaw_curtis" if grid.boundary else "modified_clenshaw_curtis"
    return SplineMoment(interpolate(grid, basis(name, 3), samples[:, 2], domain))


def clenshaw_curtis_grid(points: Float[np.ndarray, "points dimension"]) -> SparseGrid:
    """The grid that these points of the unit cube, (1 - cos(π i 2^-l))/2 in each coordinate, belong to.

    Raises InputError for any other point, for a point that comes twice, and for one whose parents are missing.
    """
    index = np.rint(np.arccos(np.clip(1 - 2 * points, -1, 1)) / np.pi * 2**MOST_LEVELS).astype(int)
    apart = np.abs((1 - np.cos(np.pi * index / 2**MOST_LEVELS)) / 2 - points) > ON_GRID
    if apart.any():
        row = int(np.argwhere(apart)[0, 0])
        shares = ", ".join(f"{share:.6g}" for share in points[row])
        raise InputError(
            "expected a full grid (every angle with every activation) or Clenshaw–Curtis points of the range,"
            f" got sample {row + 1} at shares ({shares}) of the range"
        )
    level = np.full(points.shape, MOST_LEVELS)
    while (coarser := (index % 2 == 0) & (level > 0)).any():
        index, level = np.where(coarser, index // 2, index), np.where(coarser, level - 1, level)
    grid = SparseGrid(level, index)
    known = tree.keys(grid.levels, grid.indices)
    missing = {parent for point in known for parent in tree.parents(point, grid.boundary)} - set(known)
    if missing:
        raise InputError(f"expected a sparse grid with the parents of all its points, got one without {len(missing)}")
    return grid
