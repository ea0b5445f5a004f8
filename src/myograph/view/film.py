"""A film strip: states of the arm side by side, from one place and on one scale."""

from collections.abc import Sequence

import numpy as np

from myograph.errors import InputError
from myograph.view.arm import painted
from myograph.view.canvas import legend_below, new_figure, png
from myograph.view.palette import INK, SKY, TENDON
from myograph.view.scene import Camera, draw_surfaces, side_camera
from myograph.view.stage import draw_scale_bar, extent_of, panel_width, set_stage
from myograph.view.surface import Surface

HEIGHT = 6.0
"""Of a panel [inch]."""


def draw_film(states: Sequence[Sequence[Surface]], titles: Sequence[str], camera: Camera | None = None) -> bytes:
    """PNG of the states of an arm, each a list of surfaces [mm], from left to right.

    Raises InputError unless there is a title for every state, and a surface in each.
    """
    if not states or len(states) != len(titles) or not all(states):
        raise InputError(
            f"film strip: expected states with surfaces and a title for each, got {len(states)} states"
            f" and {len(titles)} titles"
        )
    viewer = camera or side_camera()
    flat = [viewer.project(surface.points[np.unique(surface.quads)]) for state in states for surface in state]
    extent = extent_of(flat)
    figure = new_figure(max(4.0, len(states) * (panel_width(extent, HEIGHT) + 0.2)), HEIGHT + 0.9, SKY)
    from matplotlib.patches import Patch

    panels = figure.subplots(1, len(states), squeeze=False)[0]
    for axes, state, title in zip(panels, states, titles, strict=True):
        set_stage(axes, extent)
        axes.set_title(title, color=INK, fontsize=10)
        draw_surfaces(axes, viewer, [painted(surface) for surface in state])
    draw_scale_bar(panels[-1], extent)
    named = {surface.name: surface.colour for state in states for surface in state if surface.name}
    if any(surface.tendon is not None for state in states for surface in state):
        named["tendon"] = TENDON
    legend_below(figure, [Patch(facecolor=c, edgecolor=INK, linewidth=0.5, label=n) for n, c in named.items()])
    return png(figure)
