"""What a picture shows: solids in panels, and one colour bar for all of them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError

DECADES, MANY = 3, 10
"""Most powers of ten of a logarithmic bar; from the largest value over the median on that it is one."""


@dataclass(frozen=True)
class Solid:
    """A surface.

    Parameters
    ----------
    points, quads
        Nodes [mm] and quadrilaterals, counter-clockwise seen from outside.
    colour
        '#rrggbb', where there are no values.
    values
        Of the field at each node; None draws the solid in its colour.
    """

    name: str
    points: Float[np.ndarray, "nodes 3"]
    quads: Int[np.ndarray, "facets 4"]
    colour: str
    values: Float[np.ndarray, " nodes"] | None = None

    def __post_init__(self) -> None:
        if not len(self.quads):
            raise InputError(f"picture of {self.name}: expected a body with a surface, got one without")


@dataclass(frozen=True)
class Panel:
    """Solids under a title."""

    title: str
    solids: Sequence[Solid]


@dataclass(frozen=True)
class Colours:
    """How values become colours.

    Parameters
    ----------
    title
        Of the colour bar, with the unit.
    least, largest
        Ends of the bar.
    logarithmic
        Whether equal steps of colour are equal factors.
    """

    title: str
    least: float
    largest: float
    logarithmic: bool = False


def colours_of(title: str, panels: Sequence[Panel]) -> Colours | None:
    """A bar over all values of all panels; None where there are none.

    Tendons carry a hundred times the stress of a belly, which would be dark all over: such a bar is logarithmic, and
    what is below its end, or below zero, has the colour of its end.
    """
    found = [solid.values for panel in panels for solid in panel.solids if solid.values is not None]
    if not found:
        return None
    values = np.concatenate(found)
    least, middle, largest = (float(value) for value in (values.min(), np.median(values), values.max()))
    if largest > MANY * middle > 0:
        return Colours(title, max(least, largest / 10**DECADES), largest, logarithmic=True)
    return Colours(title, least, largest if largest > least else least + 1)
