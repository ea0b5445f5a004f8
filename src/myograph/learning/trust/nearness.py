r"""Whether activations are near those of training.

    distance d(α) = min over training cases of |α - α_i|
    near          d(α) <= the largest distance of a training case from its nearest other one

and within the least and the largest of every muscle, and of the load. Where training has the corners of the cube alone,
the distance between neighbours is one, and nearly all of the cube is near: then intervals, too, promise little.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from myograph.ensemble.muscle_cases import MuscleCases

ROUNDING = 1e-6


@dataclass(frozen=True)
class Nearness:
    """Of activations and load to those of training: (cases, muscles + 1), the load over its range."""

    low: Float[np.ndarray, " inputs"]
    high: Float[np.ndarray, " inputs"]
    reach: float
    tree: KDTree

    def near(
        self, activation: Float[np.ndarray, "batch muscles"], hand_load: Float[np.ndarray, " batch"]
    ) -> Bool[np.ndarray, " batch"]:
        """The verdict on each."""
        asked = np.column_stack([activation, hand_load])
        slack = ROUNDING * np.maximum(1.0, np.abs(self.high))
        within = ((asked >= self.low - slack) & (asked <= self.high + slack)).all(axis=1)
        distance, _ = self.tree.query(asked / _unit(self.low, self.high))
        return within & (distance <= self.reach + ROUNDING)


def nearness(cases: MuscleCases, taught: Int[np.ndarray, " taught"]) -> Nearness:
    """Of these training cases, of which there are at least two."""
    told = np.column_stack([cases.activation[taught], cases.hand_load[taught]])
    low, high = told.min(axis=0), told.max(axis=0)
    scaled = np.unique(told / _unit(low, high), axis=0)
    tree = KDTree(scaled)
    apart = tree.query(scaled, k=2)[0][:, 1] if len(scaled) > 1 else np.zeros(1)
    return Nearness(low, high, float(apart.max()), tree)


def _unit(low: Float[np.ndarray, " inputs"], high: Float[np.ndarray, " inputs"]) -> Float[np.ndarray, " inputs"]:
    """Activations count as they are; the load over its range."""
    unit = np.ones_like(low)
    unit[-1] = max(high[-1] - low[-1], 1.0)
    return unit
