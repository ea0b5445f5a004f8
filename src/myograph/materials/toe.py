r"""A fibre that is slack up to l = 1, then stiffens exponentially, then is straight.

    l dψ/dl = A (exp(B (l - 1)) - 1)  for 1 < l < end,    slope l + offset beyond,  continuous at the end

Convention: cauchy, l dψ/dl is the stress per present area.
Trap: the stress sets in at l = 1 with the slope A B at once.
"""

from dataclasses import dataclass
from functools import cache
from math import exp, log

import numpy as np

from myograph.materials.functions import Functions, Scalar
from myograph.materials.primitive import Piece, evaluated, primitive


@dataclass(frozen=True)
class ExponentialToe:
    """Amplitude and slope of the straight part [MPa]; rate and end of the toe [-]."""

    amplitude: float
    rate: float
    end: float
    slope: float

    def energy(self, stretch: Scalar, f: Functions) -> Scalar:
        """ψ [MPa], zero at rest."""
        last = self.amplitude * (exp(self.rate * (self.end - 1)) - 1)
        offset = last - self.slope * self.end
        beyond = f.where(stretch - self.end, stretch, self.end)
        straight = self.slope * (beyond - self.end) + offset * (f.log(beyond) - log(self.end))
        return evaluated(_pieces(self), stretch, f) + straight


@cache
def _pieces(toe: ExponentialToe) -> tuple[Piece, ...]:
    return primitive(lambda stretch: toe.amplitude * np.expm1(toe.rate * (stretch - 1)) / stretch, (1.0, toe.end))
