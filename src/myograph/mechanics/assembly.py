r"""Energy, residual and tangent of a body of mixed elements from an energy density W(F, p) of invariants.

    residual:  r_ia = Σ_q w P_ij ∂_j N_a,     r_c = Σ_q w ∂W/∂p M_c
    tangent:   K_ia,kb = Σ_q w ∂_j N_a A_ijkl ∂_l N_b,
               K_ia,c = Σ_q w ∂P_ij/∂p ∂_j N_a M_c,   K_cd = Σ_q w ∂²W/∂p² M_c M_d

P and A come from exact derivatives of W over the invariants (materials/jets.py, materials/stress.py). All points of a
block of elements are worked on together, and what is multiplied are matrices: some three times as fast as NGSolve's
differentiation of the same energy, interpreted, which tests hold it against.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.materials.invariants import Invariants
from myograph.materials.jets import Jet
from myograph.materials.stress import PRESSURE, Deformation
from myograph.mechanics.elements import Elements
from myograph.mechanics.pattern import Pattern

Density = Callable[[Invariants, Jet, slice], Jet]
"""W [MPa] from the invariants, the pressure, and which integration points these are."""


@dataclass(frozen=True, eq=False)
class Assembly:
    """A body of one energy density.

    Parameters
    ----------
    fibre
        Unit direction in the reference body at all integration points.
    density
        May change between calls, with the loads.
    """

    elements: Elements
    fibre: Float[np.ndarray, "3 points"]
    density: Density

    @cached_property
    def pattern(self) -> Pattern:
        """Where the entries of its element matrices go."""
        return Pattern(self.elements)

    @property
    def matrix(self) -> ngs.BaseMatrix:
        """The matrix that `tangent` fills."""
        return self.pattern.matrix

    def energy(self, vector: Float[np.ndarray, " unknowns"]) -> float:
        """Integral of W [N mm]."""
        total = 0.0
        for block in self.elements.blocks():
            _, density = self._density(vector, block, second=False)
            total += float(self._weights(block) @ density.value)
        return total

    def residual(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Derivative of the energy over all unknowns: force [N], volume [mm³]."""
        elements, parts = self.elements, []
        for block in elements.blocks():
            deformation, density = self._density(vector, block, second=False)
            cells, quad, _, functions = elements.gradients[block].shape
            stress = _points_first(self._weights(block) * deformation.stress(density).swapaxes(0, 1))
            forces = stress.reshape(cells, quad * 3, 3).swapaxes(1, 2) @ self._gradients(block)
            slope = self._weights(block) * density.first[PRESSURE]
            volumes = slope.reshape(cells, quad) @ elements.shapes
            parts.append(np.concatenate([forces.reshape(cells, 3 * functions), volumes], axis=1))
        return np.bincount(
            elements.all_numbers.ravel(), weights=np.concatenate(parts).ravel(), minlength=elements.unknowns
        )

    def tangent(self, vector: Float[np.ndarray, " unknowns"]) -> None:
        """Fill the matrix with the second derivative of the energy."""
        self.pattern.fill(np.concatenate([self._element_matrices(vector, block) for block in self.elements.blocks()]))

    def deformation_gradient(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, "points 3 3"]:
        """F at all integration points."""
        blocks = [self.elements.deformation_gradient(vector, block) for block in self.elements.blocks()]
        return _points_first(np.concatenate(blocks, axis=2))

    def cauchy_stress(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, "points 3 3"]:
        """σ = P Fᵀ / J at all integration points [MPa]."""
        parts = [self._density(vector, block, second=False) for block in self.elements.blocks()]
        return _points_first(np.concatenate([deformation.cauchy_stress(density) for deformation, density in parts], 2))

    def _element_matrices(self, vector: np.ndarray, block: slice) -> np.ndarray:
        """Of the elements of a block, in the order of mechanics/pattern.py."""
        deformation, density = self._density(vector, block, second=True)
        gradients, shapes = self.elements.gradients[block], self.elements.shapes
        weighted = density * self._weights(block)
        cells, quad, _, functions = gradients.shape
        at_points = gradients.reshape(cells * quad, 3, functions)
        elasticity = _points_first(deformation.elasticity(weighted)).reshape(cells * quad, 27, 3)
        right = (elasticity @ at_points).reshape(cells, quad * 3, 9 * functions)
        stiffness = self._gradients(block).swapaxes(1, 2) @ right
        slope = _points_first(deformation.stress_by_pressure(weighted)) @ at_points
        coupling = (slope.reshape(cells, quad, 3 * functions).swapaxes(1, 2) @ shapes).reshape(cells, -1)
        assert weighted.second is not None
        bend = np.broadcast_to(weighted.second[PRESSURE, PRESSURE], (cells * quad,)).reshape(cells, quad)
        pressure = bend @ (shapes[:, :, None] * shapes[:, None, :]).reshape(quad, -1)
        return np.concatenate([stiffness.reshape(cells, -1), coupling, coupling, pressure], axis=1).ravel()

    def _density(self, vector: np.ndarray, block: slice, second: bool) -> tuple[Deformation, Jet]:
        """Deformation and W at the integration points of a block; no number where an element is inside out."""
        points = self.elements.points(block)
        deformation = Deformation(self.elements.deformation_gradient(vector, block), self.fibre[:, points])
        pressure = Jet.variable(PRESSURE, self.elements.pressure(vector, block), second)
        with np.errstate(invalid="ignore", over="ignore", divide="ignore"):
            return deformation, self.density(deformation.invariants(second), pressure, points)

    def _weights(self, block: slice) -> np.ndarray:
        return self.elements.weights[block].ravel()

    def _gradients(self, block: slice) -> np.ndarray:
        """[cell, point and direction, function]."""
        cells, quad, _, functions = self.elements.gradients[block].shape
        return self.elements.gradients[block].reshape(cells, quad * 3, functions)


def _points_first(components: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(np.moveaxis(components, -1, 0))
