"""A profile of 200 values over two parameters: 49 evaluations on a sparse grid, few modes, one smooth function.

A drop of dye spreads: u(x; D, t) = w / s exp(-x² / 2 s²), s² = w² + 2 D t, in mm and s. Any other computation that
answers a few parameters with many numbers takes the place of `profile`.
"""

import numpy as np

from myograph.interpolation import Domain, Hierarchizer, SparseGrid, basis, compress

PLACES_MM = np.linspace(-10, 10, 200)
WIDTH_MM = 2.0
BOX = Domain(lower=np.array([0.1, 0.0]), upper=np.array([0.5, 10.0]))
"""Diffusivity [mm²/s] and time [s]."""


def profile(diffusivity: float, time: float) -> np.ndarray:
    """Concentration at all places, 1 at the middle of the first drop."""
    variance = WIDTH_MM**2 + 2 * diffusivity * time
    return WIDTH_MM / np.sqrt(variance) * np.exp(-(PLACES_MM**2) / (2 * variance))


def errors(degree: int = 3) -> tuple[int, int, float, float]:
    """Number of evaluations and modes; largest error of the profiles, and of their derivatives by diffusivity."""
    hierarchizer = Hierarchizer(SparseGrid.regular(2, 4), basis("modified_clenshaw_curtis", degree), BOX)
    modes = compress(np.stack([profile(*point) for point in hierarchizer.points]), tolerance=1e-4)
    spline = hierarchizer.interpolant(modes.coefficients)

    points = BOX.from_unit(np.random.default_rng(0).uniform(size=(300, 2)))
    step = np.array([1e-5, 0.0])
    exact = np.stack([profile(*point) for point in points])
    slopes = np.stack([(profile(*(point + step)) - profile(*(point - step))) / 2e-5 for point in points])
    error = np.abs(modes.expand(spline(points)) - exact).max()
    error_slope = np.abs(spline.gradient(points)[..., 0] @ modes.vectors - slopes).max()
    return len(hierarchizer.points), len(modes.vectors), float(error), float(error_slope)


if __name__ == "__main__":
    evaluations, number, error, error_slope = errors()
    print(
        f"{evaluations} evaluations, {number} modes: error {error:.1e}, of the derivative {error_slope:.1e} per mm²/s"
    )
