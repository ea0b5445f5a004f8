r"""Is a predicted shape one that tissue can take: det F near 1, ends where they belong.

    x(ξ) = sum_i N_i(ξ) x_i,   F = ∂x/∂ξ (∂X/∂ξ)⁻¹,   J = det F

Muscle keeps its volume: the truth itself has J near 1 at the integration points, as far as its elements hold it there.
Predicted positions are judged beside it.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.mesh.kinds import element_of


@dataclass(frozen=True)
class VolumeRatios:
    """J over all integration points of all cases [-].

    Parameters
    ----------
    mean, deviation, least, largest
        Of J.
    negative
        Share of the points where tissue is turned over.
    change
        Mean of |J - 1|.
    """

    mean: float
    deviation: float
    least: float
    largest: float
    negative: float
    change: float

    @property
    def largest_change(self) -> float:
        """Largest |J - 1|."""
        return max(abs(self.least - 1), abs(self.largest - 1))


def volume_ratios(body: Body, positions: Float[np.ndarray, "cases nodes 3"]) -> VolumeRatios:
    """J of positions of all nodes [mm]; raises InputError for another number of nodes, or elements not known."""
    element = element_of(body.cells)
    if positions.shape[1:] != body.reference.shape:
        raise InputError(f"positions: expected {len(body.reference)} nodes in each case, got {positions.shape[1:]}")
    before = element.determinants(body.reference, body.cells, element.places)
    ratios = np.stack([element.determinants(case, body.cells, element.places) / before for case in positions])
    return VolumeRatios(
        float(ratios.mean()),
        float(ratios.std()),
        float(ratios.min()),
        float(ratios.max()),
        float((ratios <= 0).mean()),
        float(np.abs(ratios - 1).mean()),
    )


def fixed_nodes(positions: Float[np.ndarray, "cases nodes 3"], tolerance: float = 1e-3) -> Int[np.ndarray, " fixed"]:
    """Nodes that stay within the tolerance [mm] in all cases: the end that is clamped to a resting bone."""
    return np.flatnonzero(np.linalg.norm(np.ptp(positions, axis=0), axis=-1) <= tolerance)
