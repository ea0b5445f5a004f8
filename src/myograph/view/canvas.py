"""A matplotlib figure without global state, and its PNG bytes.

Figures are made by the object interface with the software renderer (Agg), so that neither pyplot's current figure nor a
display is touched. This is the one place that finds out whether matplotlib is installed.
"""

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING

from myograph.errors import MissingPackageError
from myograph.view.palette import FAINT, INK, PAPER

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

RESOLUTION = 160
"""Pixels per inch."""


def new_figure(width: float, height: float, background: str = PAPER) -> "Figure":
    """Empty figure of that size [inch]; raises MissingPackageError without matplotlib."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        from matplotlib.layout_engine import ConstrainedLayoutEngine
    except ImportError:
        raise MissingPackageError("matplotlib", "view", "drawing a picture") from None
    layout = ConstrainedLayoutEngine(w_pad=0.1, h_pad=0.1)
    figure = Figure(figsize=(width, height), dpi=RESOLUTION, facecolor=background, layout=layout)
    FigureCanvasAgg(figure)
    return figure


def png(figure: "Figure") -> bytes:
    """The figure as a PNG image."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()


def tidy(axes: "Axes", x_label: str, y_label: str) -> None:
    """Give a plot of curves the looks of all others: two spines, a faint grid, labels in ink."""
    axes.set_xlabel(x_label, color=INK)
    axes.set_ylabel(y_label, color=INK)
    axes.grid(color=FAINT, alpha=0.25, linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(FAINT)
    axes.tick_params(colors=INK, labelsize=9)


def legend_below(figure: "Figure", handles: Sequence["Artist"]) -> None:
    """One legend below all axes, in rows of at most four."""
    if handles:
        columns = len(handles) if len(handles) <= 4 else min(4, (len(handles) + 1) // 2)
        figure.legend(
            handles=handles, loc="outside lower center", ncols=columns, frameon=False, fontsize=9, labelcolor=INK
        )
