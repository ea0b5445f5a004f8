"""What every method can do that answers the queries of pairs from their sensors: a network, a baseline."""

from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float


@runtime_checkable
class Predictor(Protocol):
    """Answers where points of a muscle go from where a few of its nodes went."""

    @property
    def name(self) -> str:
        """As it stands in tables."""
        ...

    def predict(
        self, sensors: Float[np.ndarray, "batch sensors 6"], queries: Float[np.ndarray, "batch queries 3"]
    ) -> Float[np.ndarray, "batch queries 3"]:
        """Positions T in the target state [mm] of the points that sit at `queries` in the initial state.

        Parameters
        ----------
        sensors
            Positions (S, T) of the sensors in both states [mm].
        queries
            Positions S of the asked points in the initial state [mm].
        """
        ...
