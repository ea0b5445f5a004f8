"""The arm in the plane of its flexion: muscles in five hues that fade into white tendon, bones beige."""

from collections.abc import Sequence

import numpy as np

from myograph.errors import InputError
from myograph.view.canvas import new_figure, png
from myograph.view.palette import INK, SKY, TENDON
from myograph.view.scene import Camera, PaintedSurface, draw_surfaces, side_camera
from myograph.view.stage import draw_scale_bar, extent_of, panel_width, set_stage
from myograph.view.surface import Surface


def draw_arm(surfaces: Sequence[Surface], title: str = "", camera: Camera | None = None) -> bytes:
    """PNG of muscles and bones [mm], with a legend of their names and a scale bar.

    Parameters
    ----------
    camera
        Where to look from; None looks from the lateral side, a little from the front.
    """
    if not surfaces:
        raise InputError("picture of the arm: expected at least one surface, got none")
    viewer = camera or side_camera()
    extent = extent_of([viewer.project(surface.points[surface.quads.ravel()]) for surface in surfaces])
    figure = new_figure(panel_width(extent, 8.0) + 1.8, 8.4, SKY)
    from matplotlib.patches import Patch

    axes = figure.add_subplot()
    set_stage(axes, extent)
    axes.set_title(title, color=INK, fontsize=10)
    draw_surfaces(axes, viewer, [painted(surface) for surface in surfaces])
    draw_scale_bar(axes, extent)
    named = {surface.name: surface.colour for surface in surfaces if surface.name}
    if any(surface.tendon is not None for surface in surfaces):
        named["tendon"] = TENDON
    handles = [Patch(facecolor=colour, edgecolor=INK, linewidth=0.5, label=name) for name, colour in named.items()]
    figure.legend(handles=handles, loc="outside right upper", frameon=False, fontsize=9, labelcolor=INK)
    return png(figure)


def painted(surface: Surface) -> PaintedSurface:
    """The surface in the colour of its belly, faded into tendon where there is some."""
    from matplotlib.colors import to_rgb

    fraction = np.zeros(len(surface.points)) if surface.tendon is None else np.clip(surface.tendon, 0, 1)
    colours = np.outer(1 - fraction, to_rgb(surface.colour)) + np.outer(fraction, to_rgb(TENDON))
    return PaintedSurface(surface.points, surface.quads, colours)
