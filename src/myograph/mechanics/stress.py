"""What a solved muscle tells: stress, stretch and pressure at the nodes.

Cauchy stress  sigma = P Fᵀ / J  with P the derivative of the energy over F; evaluated inside every element where it is
most exact, extrapolated to its nodes and averaged over the elements that share a node.
"""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from myograph.fields import von_mises
from myograph.materials.jets import Jet
from myograph.materials.stress import PRESSURE, Deformation
from myograph.mechanics.elements import mixed_elements
from myograph.mechanics.layout import LAYOUTS
from myograph.mechanics.problem import MuscleProblem

_VOIGT_ENTRIES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


class FieldReader:
    """Evaluates the fields of one muscle for any of its states."""

    def __init__(self, problem: MuscleProblem) -> None:
        self._problem = problem
        inside = LAYOUTS[problem.mesh.element.kind].recovery
        self._elements = mixed_elements(problem.space.mesh, inside)
        self._site = problem.site.at(inside)

    def read(self, vector: Float[np.ndarray, " unknowns"]) -> Mapping[str, Float[np.ndarray, "nodes ..."]]:
        """Fields by their names in `myograph.fields`, at the problem's present controls."""
        everywhere = slice(0, len(self._elements.numbers))
        deformation = Deformation(self._elements.deformation_gradient(vector, everywhere), self._site.fibre)
        pressure = self._elements.pressure(vector, everywhere)
        at, place = deformation.invariants(second=False), self._site.place(slice(None))
        energy = self._problem.law.energy(at, Jet.variable(PRESSURE, pressure, second=False), place)
        sigma = deformation.cauchy_stress(energy)
        voigt = [0.5 * (sigma[i, j] + sigma[j, i]) for i, j in _VOIGT_ENTRIES]
        values = self._problem.space.recovered(np.stack([*voigt, np.sqrt(at.I4.value), pressure], axis=1))
        return {
            "position": self._problem.positions(vector),
            "cauchy_stress": values[:, :6],
            "von_mises": von_mises(values[:, :6]),
            "fibre_stretch": values[:, 6],
            "pressure": values[:, 7],
        }
