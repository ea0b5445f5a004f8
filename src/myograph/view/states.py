"""A muscle in two states, with the nodes that are known and those that are asked (figure 5.2 of the thesis)."""

from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Int

from myograph.view.canvas import legend_below, new_figure, png
from myograph.view.palette import ARROW, INK, MUSCLE_COLOURS, QUERY, SENSOR, SKY
from myograph.view.scene import Camera, PaintedSurface, draw_surfaces, side_camera
from myograph.view.stage import draw_scale_bar, extent_of, panel_width, set_stage

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ARROWS, LEAST_ARROW = 12, 0.25
"""How many displacements are drawn; none shorter than this fraction of the longest."""
PALENESS = 0.65


def draw_states(
    rest: Float[np.ndarray, "nodes 3"],
    active: Float[np.ndarray, "nodes 3"],
    quads: Int[np.ndarray, "facets 4"],
    sensors: Int[np.ndarray, " sensors"],
    titles: tuple[str, str] = ("at rest", "fully active"),
    camera: Camera | None = None,
) -> bytes:
    """PNG of a muscle in two states side by side, on one scale: sensors black, queries blue.

    The first panel also shows where some of its nodes go, as arrows to their places in the second.

    Parameters
    ----------
    rest, active
        Positions of all nodes [mm]; those inside the muscle shine through its skin.
    """
    viewer = camera or side_camera()
    before, after = viewer.project(rest), viewer.project(active)
    extent = extent_of([before, after])
    figure = new_figure(max(5.6, 2.4 * panel_width(extent, 6.6)), 7.2, SKY)
    left, right = figure.subplots(1, 2)
    for axes, points, flat, title in ((left, rest, before, titles[0]), (right, active, after, titles[1])):
        set_stage(axes, extent)
        axes.set_title(title, color=INK, fontsize=10)
        draw_surfaces(axes, viewer, [PaintedSurface(points, quads, _pale(len(points)))])
        queries = np.delete(flat, sensors, axis=0)
        axes.scatter(queries[:, 0], queries[:, 1], s=5, color=QUERY, linewidths=0, alpha=0.7)
        axes.scatter(
            flat[sensors, 0], flat[sensors, 1], s=44, color=SENSOR, edgecolors="white", linewidths=0.9, zorder=4
        )
    _draw_arrows(left, before, after, sensors)
    draw_scale_bar(right, extent)
    _legend(figure, len(sensors))
    return png(figure)


def _pale(count: int) -> Float[np.ndarray, "nodes 3"]:
    """Colour of the biceps, thinned so that nodes show on it."""
    from matplotlib.colors import to_rgb

    return np.tile((1 - PALENESS) * np.array(to_rgb(MUSCLE_COLOURS["biceps"])) + PALENESS, (count, 1))


def _draw_arrows(axes: "Axes", before: np.ndarray, after: np.ndarray, sensors: np.ndarray) -> None:
    """Displacements of some queries that move, at equal steps from the lowest to the highest."""
    moved = np.linalg.norm((after - before)[:, :2], axis=1)
    moved[sensors] = 0
    moving = np.flatnonzero(moved > LEAST_ARROW * moved.max())
    order = moving[np.argsort(before[moving, 1])]
    chosen = order[np.linspace(0, len(order) - 1, ARROWS).astype(int)] if len(order) else order
    look = {"arrowstyle": "-|>", "mutation_scale": 9, "color": ARROW, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0}
    for tail, tip in zip(before[chosen, :2], after[chosen, :2], strict=True):
        axes.annotate("", tip, tail, zorder=3, arrowprops=look)


def _legend(figure: "Figure", sensors: int) -> None:
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], linestyle="", marker="o", color=SENSOR, markersize=6, label=f"{sensors} sensors"),
        Line2D([], [], linestyle="", marker="o", color=QUERY, markersize=3, label="queries"),
        Line2D([], [], marker=">", color=ARROW, linewidth=1.2, markersize=4, label="displacement"),
    ]
    legend_below(figure, handles)
