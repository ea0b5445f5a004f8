"""Where a Graph Element Network's nodes lie, before and after training (figures 6.2 a, b, d, e of the thesis)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.view.canvas import new_figure, png
from myograph.view.palette import FAINT, INK, SERIES_COLOURS, SKY
from myograph.view.scene import Camera, side_camera
from myograph.view.stage import draw_scale_bar, extent_of, panel_width, set_stage

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_EDGES = 200
"""A mesh with more edges is drawn as nodes only: its edges would hide them."""


@dataclass(frozen=True)
class NetworkNodes:
    """The mesh of a network in one state of its training.

    Parameters
    ----------
    title
        Such as '8 nodes, after training'.
    positions
        Of the nodes [mm].
    edges
        Pairs of nodes.
    """

    title: str
    positions: Float[np.ndarray, "nodes 3"]
    edges: Int[np.ndarray, "edges 2"]


def draw_network_nodes(
    before: Sequence[NetworkNodes],
    after: Sequence[NetworkNodes],
    cloud: Float[np.ndarray, "points 3"],
    camera: Camera | None = None,
) -> bytes:
    """PNG with two panels per network: its nodes before and after training, the muscle's points faint behind.

    Nearer nodes are larger and darker.
    """
    if not before or len(before) != len(after):
        raise InputError(f"networks: expected as many before as after training, got {len(before)} and {len(after)}")
    viewer = camera or side_camera()
    meshes = [mesh for pair in zip(before, after, strict=True) for mesh in pair]
    extent = extent_of([viewer.project(points) for points in (cloud, *(mesh.positions for mesh in meshes))])
    figure = new_figure(1.25 * len(meshes) * panel_width(extent, 5.0), 5.8, SKY)
    behind = viewer.project(cloud)
    panels = figure.subplots(1, len(meshes))
    for axes, mesh in zip(panels, meshes, strict=True):
        set_stage(axes, extent)
        axes.set_title(mesh.title, color=INK, fontsize=10)
        axes.scatter(behind[:, 0], behind[:, 1], s=3, color=FAINT, linewidths=0, alpha=0.35)
        _draw_mesh(axes, viewer.project(mesh.positions), mesh.edges)
    draw_scale_bar(panels[-1], extent)
    return png(figure)


def _draw_mesh(axes: "Axes", nodes: Float[np.ndarray, "nodes 3"], edges: Int[np.ndarray, "edges 2"]) -> None:
    from matplotlib.collections import LineCollection

    if len(edges) <= MOST_EDGES:
        axes.add_collection(LineCollection(list(nodes[edges][:, :, :2]), colors=INK, linewidths=0.6, alpha=0.5))
    depth = nodes[:, 2] - nodes[:, 2].min()
    nearness = depth / max(float(depth.max()), 1e-12)
    size = (40 if len(nodes) < 50 else 12) * (0.4 + 0.6 * nearness)
    order = np.argsort(nearness)
    axes.scatter(
        nodes[order, 0], nodes[order, 1], s=size[order], color=SERIES_COLOURS[1], edgecolors="white", linewidths=0.4,
        alpha=0.45 + 0.55 * nearness[order], zorder=3,
    )  # fmt: skip
