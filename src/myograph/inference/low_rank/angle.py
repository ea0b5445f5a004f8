"""The place x of a muscle from the activations of all muscles and the load: a few small networks side by side.

x = mean over the members of  c + w · tanh(B tanh(A y + a) + b),    y = (activations and load - centre) / scale
"""

from dataclasses import dataclass, fields

import numpy as np
from jaxtyping import Float

from myograph.inference.low_rank.field import RANGE


@dataclass(frozen=True)
class AngleNetwork:
    """The networks of an arm; all its muscles share them.

    Parameters
    ----------
    centre, scale
        Of the inputs: the five activations in the order of `myograph.MUSCLES`, and the load at the hand [N].
    first, first_offset, second, second_offset, last, last_offset
        Weights of each member, input first.
    misfit
        Root mean square of what x misses in the training cases.
    ends
        The elbow's angles [rad] at x = -RANGE and x = RANGE; None where the model does not know them.
    """

    centre: Float[np.ndarray, " inputs"]
    scale: Float[np.ndarray, " inputs"]
    first: Float[np.ndarray, "members inputs width"]
    first_offset: Float[np.ndarray, "members width"]
    second: Float[np.ndarray, "members width width"]
    second_offset: Float[np.ndarray, "members width"]
    last: Float[np.ndarray, "members width"]
    last_offset: Float[np.ndarray, " members"]
    misfit: float
    ends: tuple[float, float] | None

    def x(self, activation: Float[np.ndarray, " muscles"], hand_load: float) -> tuple[float, float]:
        """x and its standard deviation."""
        told = (np.append(activation, hand_load) - self.centre) / self.scale
        hidden = np.tanh(told @ self.first + self.first_offset)
        hidden = np.tanh(np.einsum("mi,mio->mo", hidden, self.second) + self.second_offset)
        each = np.sum(hidden * self.last, axis=1) + self.last_offset
        return float(each.mean()), float(np.hypot(each.std(), self.misfit))

    def angle(self, x: float) -> float | None:
        """The elbow's angle [rad] at x; None where it is not known."""
        if self.ends is None:
            return None
        low, high = self.ends
        return low + (x + RANGE) / (2 * RANGE) * (high - low)

    def same(self, other: "AngleNetwork") -> bool:
        """Whether both are the same numbers."""
        pairs = ((getattr(self, item.name), getattr(other, item.name)) for item in fields(self))
        return all(np.array_equal(mine, theirs) for mine, theirs in pairs)
