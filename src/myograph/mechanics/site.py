"""What the law needs to know everywhere in a muscle: fibre direction, fraction of belly, area of the section.

As functions between the nodes, and as arrays at the points of a rule, looked up there instead of computed anew.
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm
from myograph.mechanics.fibres import fibre_direction
from myograph.mechanics.law import Place
from myograph.mechanics.space import NodalSpace
from myograph.mesh.tissue import tendon_share


@dataclass(frozen=True, eq=False)
class SitePoints:
    """At points: unit fibre direction, fraction of belly (0 to 1), area of the section [mm²]."""

    fibre: Float[np.ndarray, "3 points"]
    fraction: Float[np.ndarray, " points"]
    area: Float[np.ndarray, " points"]

    def place(self, points: slice) -> Place:
        """Some of them, as the law wants them."""
        return Place(self.fraction[points], self.area[points])


class Site:
    """As functions in the reference body.

    Quadratics overshoot between the nodes: the fraction is clamped, the area interpolated by its logarithm.
    """

    def __init__(self, arm: Arm, name: str, space: NodalSpace) -> None:
        self._mesh = space.mesh
        fraction = space.field(1 - tendon_share(arm, name, space.muscle))
        self.fraction = ngs.IfPos(fraction, ngs.IfPos(fraction - 1, 1.0, fraction), 0.0)
        self.fibre = fibre_direction(space)
        self.area = ngs.exp(space.field(np.log(space.muscle.area)))

    def at(self, rule: ngs.IntegrationRule) -> SitePoints:
        """At the points of a rule in every element, one element after the other."""
        points = self._mesh.MapToAllElements(rule, ngs.VOL)
        fibre, fraction, area = (np.asarray(function(points)) for function in (self.fibre, self.fraction, self.area))
        return SitePoints(np.ascontiguousarray(fibre.T), fraction.ravel(), area.ravel())
