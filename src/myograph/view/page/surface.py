"""What the page draws of a body: nodes of its skin, sensors below it, triangles, and vertices between the nodes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.view.page.smoothing import Refined, refine, triangles_of
from myograph.view.page.thinning import thin

MOST_NODES = 6000
"""Of a muscle's skin; beyond it, the skin is thinned."""
REFINED_NODES = 1000
"""Up to so many nodes of skin, a surface of quadrilaterals is refined."""


@dataclass(frozen=True)
class PageSurface:
    """A surface.

    Parameters
    ----------
    nodes
        Nodes of the body: those of the skin, then sensors that are not among these.
    on_skin
        Number of nodes of the skin.
    triangles
        Of places in `nodes`, and of vertices after those on the skin.
    between
        The vertices between nodes; None where there are none.
    sensors
        Places of the sensors in `nodes`.
    left_out
        Number of nodes of the skin that thinning left out.
    """

    nodes: Int[np.ndarray, " nodes"]
    on_skin: int
    triangles: Int[np.ndarray, "triangles 3"]
    between: Refined | None
    sensors: tuple[int, ...]
    left_out: int


def page_surface(
    reference: Float[np.ndarray, "nodes 3"],
    skin: Int[np.ndarray, "facets 4"],
    sensors: tuple[int, ...] = (),
    most: int = MOST_NODES,
) -> PageSurface:
    """The surface of a body; raises InputError where its nodes are not connected to a skin."""
    if len(skin) == 0:
        raise InputError("expected a body with a skin (quadrilaterals of its surface), got none: nothing can be drawn")
    nodes = np.unique(skin)
    quads = np.searchsorted(nodes, skin)
    triangles, between = triangles_of(quads), None
    kept = np.arange(len(nodes))
    if len(nodes) > most:
        kept, triangles = thin(reference[nodes], triangles, most)
    elif len(nodes) <= REFINED_NODES and all(len(set(quad)) == 4 for quad in quads.tolist()):
        between = refine(reference[nodes], quads)
        triangles = between.triangles
    drawn = nodes[kept]
    below = [sensor for sensor in sensors if sensor not in set(drawn.tolist())]
    everything = np.concatenate([drawn, np.array(below, dtype=np.int64)])
    places = {node: place for place, node in enumerate(everything.tolist())}
    return PageSurface(
        everything, len(drawn), triangles, between, tuple(places[s] for s in sensors), len(nodes) - len(drawn)
    )
