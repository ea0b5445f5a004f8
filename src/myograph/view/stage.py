"""Axes for a scene: one millimetre is as long in every direction, no frame, a bar that says how long it is."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float

from myograph.view.palette import INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes


MARGIN, FOOT = 0.04, 0.09
"""Room around the scene and, for the scale bar, below it, over the longer side of the scene."""


def extent_of(projected: Sequence[Float[np.ndarray, "_ 3"]]) -> Float[np.ndarray, "2 2"]:
    """Lower left and upper right corner of the box around all points, which are (right, up, towards) [mm]."""
    flat = np.concatenate([points[:, :2] for points in projected])
    return np.stack([flat.min(axis=0), flat.max(axis=0)])


def panel_width(extent: Float[np.ndarray, "2 2"], height: float) -> float:
    """Width of a panel of that height [inch] that a scene fills, and at least enough for a title."""
    right, up = extent[1] - extent[0]
    return max(1.5, height * float(right / up))


def set_stage(axes: "Axes", extent: Float[np.ndarray, "2 2"]) -> None:
    """Equal scales, no frame, and room around the scene."""
    longer = float(np.max(extent[1] - extent[0]))
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_xlim(extent[0, 0] - MARGIN * longer, extent[1, 0] + MARGIN * longer)
    axes.set_ylim(extent[0, 1] - FOOT * longer, extent[1, 1] + MARGIN * longer)


def draw_scale_bar(axes: "Axes", extent: Float[np.ndarray, "2 2"]) -> None:
    """Bar below the scene: a round number of millimetres, up to a third of the scene's width."""
    width, longer = float(extent[1, 0] - extent[0, 0]), float(np.max(extent[1] - extent[0]))
    length = max((step for step in (2, 5, 10, 20, 50, 100, 200) if 3 * step <= width), default=1)
    right, bottom = extent[1, 0], extent[0, 1] - 0.8 * FOOT * longer
    axes.plot([right - length, right], [bottom, bottom], color=INK, linewidth=2.0, solid_capstyle="butt")
    axes.annotate(
        f"{length} mm", (right - length / 2, bottom), (0, 3), textcoords="offset points",
        ha="center", va="bottom", color=INK, fontsize=9,
    )  # fmt: skip
