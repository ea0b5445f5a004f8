r"""Stress and elasticity of an energy W of the invariants of F and a fibre, from its derivatives over the invariants.

    P_ij = Σ_a W_a ∂I_a/∂F_ij
    A_ijkl = Σ_ab W_ab ∂I_a/∂F_ij ∂I_b/∂F_kl + Σ_a W_a ∂²I_a/∂F_ij ∂F_kl

with b = F a0, y = C a0, B = F Fᵀ:

    ∂I1 = 2 F                     ∂²I1 = 2 δik δjl
    ∂I2 = 2 (I1 F - F C)          ∂²I2 = 4 Fij Fkl + 2 I1 δik δjl - 2 (δik Clj + Fil Fkj + Bik δjl)
    ∂I4 = 2 b ⊗ a0                ∂²I4 = 2 δik aj al
    ∂I5 = 2 (b ⊗ y + F y ⊗ a0)    ∂²I5 = 2 (δjl bi bk + Fil aj bk + al Fkj bi + al aj Bki + δik (aj yl + al yj))
    ∂J  = cof F                   ∂²J  = ε_ikm ε_jln Fmn

Components come first and points last, so that every operation runs over many points at once.

Source: Holzapfel, Nonlinear Solid Mechanics, 2000, sections 6.2 and 6.8.
"""

from dataclasses import dataclass, fields
from functools import cached_property
from itertools import permutations

import numpy as np
from jaxtyping import Float

from myograph.materials.invariants import Invariants
from myograph.materials.jets import First, Jet

PRESSURE = len(fields(Invariants))
"""Number of the pressure among the variables; the invariants come before it, in their order."""
_I1, _I2, _I4, _I5, _J = range(PRESSURE)
_CYCLES = [(i, j, k, 1.0 if (j - i) % 3 == 1 else -1.0) for i, j, k in permutations(range(3))]


@dataclass(frozen=True, eq=False)
class Deformation:
    """Deformation gradients and unit fibre directions in the reference body, at points."""

    F: Float[np.ndarray, "3 3 points"]
    fibre: Float[np.ndarray, "3 points"]

    def invariants(self, second: bool = True) -> Invariants:
        """All five as variables: jets with first and, if wanted, second derivatives."""
        I1, square = np.trace(self._metric), np.einsum("ijn,ijn->n", self._metric, self._metric)
        I4, I5 = (np.einsum("in,in->n", v, v) for v in (self._b, self._y))
        values = (I1, 0.5 * (I1 * I1 - square), I4, I5, self._volume)
        return Invariants(*(Jet.variable(k, value, second) for k, value in enumerate(values)))

    def stress(self, energy: Jet) -> Float[np.ndarray, "3 3 points"]:
        """First Piola–Kirchhoff stress P."""
        return self._combined(energy.first)

    def cauchy_stress(self, energy: Jet) -> Float[np.ndarray, "3 3 points"]:
        """σ = P Fᵀ / J."""
        return _product(self.stress(energy), self.F.swapaxes(0, 1)) / self._volume

    def stress_by_pressure(self, energy: Jet) -> Float[np.ndarray, "3 3 points"]:
        """Derivative of P over the pressure."""
        assert energy.second is not None
        return self._combined({k: d for (k, other), d in energy.second.items() if other == PRESSURE})

    def elasticity(self, energy: Jet) -> Float[np.ndarray, "3 3 3 3 points"]:
        """∂²W / ∂F_ij ∂F_kl, stored as [j, i, k, l, point], in which order elements multiply it."""
        weights = self._weights(energy)
        result = np.zeros((3, 3, 3, 3, self.F.shape[-1]))
        for k in sorted({k for pair in weights for k in pair}):
            others = self._combined({n if m == k else m: d for (m, n), d in weights.items() if k in (m, n)})
            slopes = self._slopes(k)
            for i, j in np.ndindex(3, 3):
                result[j, i] += slopes[i, j] * others
        self._add_bends(result, energy.first)
        return result

    def _weights(self, energy: Jet) -> dict[tuple[int, int], np.ndarray]:
        """Second derivatives over the invariants, with the part of I2's bend that is a product of I1's slopes."""
        assert energy.second is not None
        weights = {pair: d for pair, d in energy.second.items() if PRESSURE not in pair}
        if _I2 in energy.first:
            weights[_I1, _I1] = weights.get((_I1, _I1), 0.0) + energy.first[_I2]
        return weights

    def _combined(self, weights: First) -> np.ndarray:
        """Sum of the slopes of the invariants, each times its weight."""
        total = np.zeros_like(self.F)
        for k, weight in weights.items():
            if k != PRESSURE:
                total += weight * self._slopes(k)
        return total

    def _slopes(self, k: int) -> np.ndarray:
        """Derivative of the invariant of this number over F; each is formed once."""
        if k not in self._known:
            self._known[k] = self._derived(k)
        return self._known[k]

    def _derived(self, k: int) -> np.ndarray:
        F = self.F
        if k == _I1:
            return 2 * F
        if k == _I2:
            return 2 * (np.trace(self._metric) * F - _product(F, self._metric))
        if k == _I4:
            return 2 * self._b[:, None] * self.fibre
        if k == _I5:
            return 2 * (self._b[:, None] * self._y + _product(F, self._y[:, None])[:, 0][:, None] * self.fibre)
        return np.stack([np.cross(F[i], F[j], axis=0) for i, j in ((1, 2), (2, 0), (0, 1))])

    def _add_bends(self, result: np.ndarray, first: First) -> None:
        """Add the second derivatives of the invariants, each times the first of the energy."""
        none = np.zeros(self.F.shape[-1])
        w1, w2, w4, w5, wJ = (first.get(k, none) for k in range(PRESSURE))
        F, a, b, y = self.F, self.fibre, self._b, self._y
        B = _product(F, F.swapaxes(0, 1))
        mixed = w5 * y + w4 * a
        along = 2 * (a[:, None] * mixed + w5 * y[:, None] * a - w2 * self._metric)
        for j in range(3):
            along[j, j] += 2 * (w1 + w2 * np.trace(self._metric))
        across = 2 * (w5 * b[:, None] * b - w2 * B)
        for k, j in np.ndindex(3, 3):
            result[j, k, k] += along[j]
            result[j, :, k, j] += across[:, k]
            result[j, :, k] += (2 * (w5 * a[j] * b[k] - w2 * F[k, j])) * F
            result[j, :, k] += (2 * w5 * (F[k, j] * b + a[j] * B[k]))[:, None] * a
        for i, k, m, sign in _CYCLES:
            for j, to, n, other in _CYCLES:
                result[j, i, k, to] += sign * other * wJ * F[m, n]

    @cached_property
    def _known(self) -> dict[int, np.ndarray]:
        return {}

    @cached_property
    def _volume(self) -> np.ndarray:
        """J."""
        return np.einsum("in,in->n", self.F[0], self._slopes(_J)[0])

    @cached_property
    def _metric(self) -> np.ndarray:
        """C."""
        return _product(self.F.swapaxes(0, 1), self.F)

    @cached_property
    def _b(self) -> np.ndarray:
        return _product(self.F, self.fibre[:, None])[:, 0]

    @cached_property
    def _y(self) -> np.ndarray:
        return _product(self._metric, self.fibre[:, None])[:, 0]


def _product(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Matrix product, point by point."""
    total = one[:, 0, None] * other[0]
    for k in range(1, len(other)):
        total += one[:, k, None] * other[k]
    return total
