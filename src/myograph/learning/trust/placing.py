r"""Which nodes are good sensors: pivoted QR of the modes.

    (Φ diag(s))ᵀ P = Q R,   Φ the modes of the positions, s how large their amounts are in training

Pivoting takes, one after the other, the node whose position is least known when those of the nodes before are known:
the three rows of a node belong together, the largest sum of squares wins, and all three are projected out.
Source: Manohar et al. 2018.
"""

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError
from myograph.learning.modes.pod import proper_modes


def qr_sensors(
    cases: MuscleCases, taught: Int[np.ndarray, " taught"], count: int, modes: int | None = None
) -> Int[np.ndarray, " sensors"]:
    """That many nodes, from the positions in these cases; as many modes as coordinates are measured, or those asked.

    Raises InputError unless that leaves something to ask.
    """
    if not 1 <= count < cases.nodes:
        raise InputError(f"expected between 1 and {cases.nodes - 1} sensors on {cases.nodes} nodes, got {count}")
    values = cases.values("position", taught).reshape(len(taught), -1)
    pod = proper_modes(values, 3 * count if modes is None else modes)
    weighted = (pod.modes * pod.spread[:, None]).T.reshape(cases.nodes, 3, -1)
    return np.sort(np.array(pivots(weighted, count)))


def pivots(rows: Float[np.ndarray, "nodes 3 modes"], count: int) -> list[int]:
    """Nodes in the order of what they add."""
    left, chosen = rows.astype(np.float64), []
    for _ in range(count):
        gain = np.square(left).sum(axis=(1, 2))
        gain[chosen] = -1.0
        chosen.append(int(gain.argmax()))
        directions = _basis(left[chosen[-1]])
        left = left - (left @ directions.T) @ directions
    return chosen


def _basis(rows: Float[np.ndarray, "3 modes"]) -> Float[np.ndarray, "rank modes"]:
    """Orthonormal rows that span these."""
    _, sizes, directions = np.linalg.svd(rows, full_matrices=False)
    return directions[sizes > 1e-12 * max(sizes.max(), 1e-300)]
