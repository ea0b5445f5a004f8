r"""The law of a muscle as FElupe gets it: its energy without the pressure, and what it needs at the integration points.

    W = g_m (c1 (I1bar - 3) + c2 (I2bar - 3))(F G0) + g_f (ψ_passive + a ψ_active)(F G0)       belly
      + g_t c1 (I1bar - 3)(F) + g_s ψ_strand(F)                                                tendon

A second writing of src/myograph/mechanics/law.py with the laws `gauss` and `toe_tendon`, in operations that NumPy,
tensortrax and JAX all know, for FElupe's own environment: it must not import myograph.
"""

from math import pi, sqrt

import numpy as np

SITE = 9
"""Numbers at each integration point: fibre (3), pre-stretch, shares g of matrix, fibre, tendon, strand, activation."""


def energy(C, site, law, f):
    """Energy [MPa] without its pressure; `f` brings sqrt, log, erf and choose(condition, then, otherwise)."""
    a, (stretch, matrix, fibre, tendon, strand, activation), belly = site[:3], site[3:9], law["belly"]
    I1 = C[0, 0] + C[1, 1] + C[2, 2]
    Ca = [C[i, 0] * a[0] + C[i, 1] * a[1] + C[i, 2] * a[2] for i in range(3)]
    I4, I5 = a[0] * Ca[0] + a[1] * Ca[1] + a[2] * Ca[2], Ca[0] ** 2 + Ca[1] ** 2 + Ca[2] ** 2
    square = C[0, 0] ** 2 + C[1, 1] ** 2 + C[2, 2] ** 2 + 2 * (C[0, 1] ** 2 + C[0, 2] ** 2 + C[1, 2] ** 2)
    shrink = _determinant(C) ** (-1 / 3)
    k = 1 / stretch
    m = stretch * stretch - k
    I1e = k * I1 + m * I4
    I2e = 0.5 * (I1e * I1e - k * k * square - 2 * k * m * I5 - m * m * I4 * I4)
    ground = belly["c1"] * (shrink * I1e - 3) + belly["c2"] * (shrink * shrink * I2e - 3)
    along = f.sqrt(I4)
    contraction = _passive(stretch * along, belly, f) + activation * _active(stretch * along, belly, f)
    sheath = law["tendon"]["c1"] * (shrink * I1 - 3)
    pull = _strand(along - 1, law["tendon"], f)
    return matrix * ground + fibre * contraction + tendon * sheath + strand * pull


def _determinant(C):
    first = C[0, 0] * (C[1, 1] * C[2, 2] - C[1, 2] * C[1, 2])
    second = C[0, 1] * (C[0, 1] * C[2, 2] - C[1, 2] * C[0, 2])
    return first - second + C[0, 2] * (C[0, 1] * C[1, 2] - C[1, 1] * C[0, 2])


def _passive(stretch, belly, f):
    rising = _power(stretch - 1, belly["passive_exponent"], belly["toe"], f)
    if belly["knee_drop"]:
        rising = rising - belly["knee_drop"] * _power(stretch - 1 - belly["knee_strain"], 1.0, belly["toe"], f)
    return belly["passive_stress"] * rising


def _power(strain, n, toe, f):
    q = 0.5 * (strain + f.sqrt(strain * strain + toe**2))
    tail = f.log(q) if n == 1 else q ** (n - 1) / (n - 1)
    return q ** (n + 1) / (n + 1) + 0.25 * toe**2 * tail


def _active(stretch, belly, f):
    x = stretch / belly["optimal_stretch"] - 1
    sides = [0.5 * sqrt(pi) * belly[w] * f.erf(x / belly[w]) for w in ("width_descending", "width_ascending")]
    return belly["peak_stress"] * belly["optimal_stretch"] * f.choose(x > 0, *sides)


def _strand(strain, tendon, f):
    toe = tendon["toe"]
    linear = 0.5 * strain * strain - 0.5 * toe * strain + toe**2 / 6
    return tendon["modulus"] * f.choose(strain > toe, linear, f.choose(strain > 0, strain**3 / (6 * toe), 0.0 * strain))


def sites(problem, tissue, ramp, activation):
    """The numbers at the integration points at one load, shape (SITE, cells, quad)."""
    share, area = problem["fraction"], problem["area"]
    stretch = 1 + ramp * share * (tissue["prestretch"] - 1)
    thin = tissue["full_area"] / area - 1
    matrix = share * (1 + 0.5 * (thin + np.sqrt(thin**2 + 0.01)))
    strand = (1 - share) * tissue["tendon_area"] / area
    fibre = ramp * share * tissue["pcsa"] / (area * stretch)
    rows = np.stack([stretch, matrix, fibre, 1 - share, strand, np.full_like(area, activation)])
    return np.concatenate([np.moveaxis(problem["fibre"], 2, 0), rows])
