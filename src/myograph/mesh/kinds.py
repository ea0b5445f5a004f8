"""The kinds of elements there are, by how many nodes each has."""

import numpy as np
from jaxtyping import Int

from myograph.errors import InputError
from myograph.mesh.element import Element
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.tetrahedra import TET10

ELEMENTS: dict[int, Element] = {len(element.nodes): element for element in (HEX27, TET10)}
"""Number of nodes -> element."""


def element_of(cells: Int[np.ndarray, "cells _"]) -> Element:
    """The element that cells are of; raises InputError where that is none known."""
    count = cells.shape[1] if len(cells) else 0
    if count not in ELEMENTS:
        raise InputError(f"elements: expected {' or '.join(map(str, ELEMENTS))} nodes each, got {count}")
    return ELEMENTS[count]
