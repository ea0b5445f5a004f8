"""What a solved muscle tells: stress, stretch and pressure at the nodes.

Cauchy stress  sigma = P Fᵀ / J  with P the derivative of the energy over F; evaluated inside every element at its
nodes and averaged over the elements that share a node.
"""

from collections.abc import Mapping

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.fields import von_mises
from myograph.mechanics.problem import MuscleProblem

_VOIGT_ENTRIES = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


class FieldReader:
    """Evaluates the fields of one muscle for any of its states."""

    def __init__(self, problem: MuscleProblem) -> None:
        self._problem = problem
        self._state = ngs.GridFunction(problem.unknowns)
        F = (ngs.Id(3) + ngs.Grad(self._state.components[0])).MakeVariable()
        pressure = self._state.components[1]
        P = problem.law.energy(F, pressure, problem.site).Diff(F)
        sigma = (P * F.trans) / ngs.Det(F)
        along = F * problem.site.fibre
        stretch = ngs.sqrt(ngs.InnerProduct(along, along))
        voigt = [0.5 * (sigma[i, j] + sigma[j, i]) for i, j in _VOIGT_ENTRIES]
        self._readings = ngs.CoefficientFunction((*voigt, stretch, pressure)).Compile()

    def read(self, vector: Float[np.ndarray, " unknowns"]) -> Mapping[str, Float[np.ndarray, "nodes ..."]]:
        """Fields by their names in `myograph.fields`, at the problem's present controls."""
        self._state.vec.FV().NumPy()[:] = vector
        values = self._problem.space.at_nodes(self._readings)
        return {
            "position": self._problem.positions(vector),
            "cauchy_stress": values[:, :6],
            "von_mises": von_mises(values[:, :6]),
            "fibre_stretch": values[:, 6],
            "pressure": values[:, 7],
        }
