"""Where the elbow rests over the activations of flexors and extensors: an angle per pair, lines of equal angle."""

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.view.canvas import legend_below, new_figure, png
from myograph.view.palette import INK, UNKNOWN

LINES_APART = 10.0
"""Degrees from one line of equal angle to the next."""


def draw_equilibria(
    flexors: Float[np.ndarray, " flexors"],
    extensors: Float[np.ndarray, " extensors"],
    angle_deg: Float[np.ndarray, "flexors extensors"],
    labels: tuple[str, str] = ("activation of all flexors", "activation of all extensors"),
) -> bytes:
    """PNG of the angle [degrees] over two activations; grey where nothing holds the elbow (NaN).

    Raises InputError where the elbow rests nowhere.
    """
    known = np.isfinite(angle_deg)
    if not known.any():
        raise InputError("picture of equilibria: expected at least one angle at rest, got none")
    figure = new_figure(6.4, 5.6)
    from matplotlib.patches import Patch

    axes = figure.add_subplot()
    axes.set_facecolor(UNKNOWN)
    grid = np.ma.masked_invalid(angle_deg.T)
    image = axes.pcolormesh(flexors, extensors, grid, cmap="viridis", shading="nearest")
    low, high = np.floor(np.nanmin(angle_deg) / LINES_APART), np.ceil(np.nanmax(angle_deg) / LINES_APART)
    levels = LINES_APART * np.arange(low, high + 1)
    lines = axes.contour(flexors, extensors, grid, levels=levels, colors="white", linewidths=1.0)
    axes.clabel(lines, fmt="%g°", fontsize=8)
    axes.set_xlabel(labels[0], color=INK)
    axes.set_ylabel(labels[1], color=INK)
    axes.tick_params(colors=INK, labelsize=9)
    axes.set_aspect("equal")
    figure.colorbar(image, ax=axes, shrink=0.9).set_label("elbow flexion at rest [°]", color=INK)
    if not known.all():
        legend_below(figure, [Patch(facecolor=UNKNOWN, label="no rest inside the range")])
    return png(figure)
