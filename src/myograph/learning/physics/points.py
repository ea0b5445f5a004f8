r"""Integration points of elements: fields and their derivatives there, of the values at the nodes.

    field = sum_n N_n(ξ) field_n,    ∂field/∂X = sum_n field_n ⊗ ∂N_n/∂X,    ∂N_n/∂X = ∂N_n/∂ξ (∂X/∂ξ)⁻¹

Convention: integration points, as it is there that finite elements keep their volume.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.spec import Body
from myograph.mesh.kinds import element_of


@dataclass(frozen=True)
class Points:
    """Some points of a body.

    Parameters
    ----------
    nodes
        Of the element around each.
    values, slopes
        N_n [-] and ∂N_n/∂X [1/mm].
    """

    nodes: Int[np.ndarray, "points element_nodes"]
    values: Float[np.ndarray, "points element_nodes"]
    slopes: Float[np.ndarray, "points element_nodes 3"]

    def carry(self, field: Float[np.ndarray, "batch nodes width"]) -> Float[np.ndarray, "batch points width"]:
        """A field at the points, of its values at all nodes."""
        return np.einsum("pn,bpnx->bpx", self.values, field[:, self.nodes])

    def gradient(self, field: Float[np.ndarray, "batch nodes width"]) -> Float[np.ndarray, "batch points width 3"]:
        """Its derivative over X there."""
        return np.einsum("bpnx,pna->bpxa", field[:, self.nodes], self.slopes)


def random_points(body: Body, generator: np.random.Generator, count: int) -> Points:
    """So many integration points at random; raises InputError for a body without known elements."""
    element = element_of(body.cells)
    nodes = body.cells[generator.integers(len(body.cells), size=count)]
    local = element.places[generator.integers(len(element.places), size=count)]
    slopes = element.gradients(local)
    jacobians = np.einsum("pna,pnx->pxa", slopes, body.reference[nodes])
    return Points(nodes, element.values(local), np.einsum("pna,pax->pnx", slopes, np.linalg.inv(jacobians)))
