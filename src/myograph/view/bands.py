"""Lines with a band around them: means over seeds and how far these scatter, over anything."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Num

from myograph.errors import InputError
from myograph.view.canvas import new_figure, png, tidy
from myograph.view.palette import INK, SERIES_COLOURS

if TYPE_CHECKING:
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

PALE = 0.18
LETTERS = 96
"""Of a legend's line."""
NARROW = 10
"""Largest over least number of an axis: below, more of its numbers are told."""
DASHED = 7
"""From this line on, colours come again, dashed."""


@dataclass(frozen=True)
class Band:
    """One line; `low` and `high` are the edges of its band, None where it has none."""

    name: str
    x: Num[np.ndarray, " points"]
    y: Float[np.ndarray, " points_y"]
    low: Float[np.ndarray, " points_low"] | None = None
    high: Float[np.ndarray, " points_high"] | None = None
    dashed: bool = False
    colour: str | None = None

    def __post_init__(self) -> None:
        if len(self.x) != len(self.y) or len(self.x) == 0:
            raise InputError(f"'{self.name}': expected as many x as y, and some; got {len(self.x)} and {len(self.y)}")


@dataclass(frozen=True)
class Axes:
    """Labels, which axes are logarithmic, and whether points are marked."""

    x: str
    y: str
    log_x: bool = False
    log_y: bool = True
    marked: bool = True


def draw_bands(bands: Sequence[Band], about: Axes) -> bytes:
    """PNG of lines with their bands."""
    if not bands:
        raise InputError(f"plot of {about.y}: expected at least one line, got none")
    figure = new_figure(7.6, 4.6)
    axes = figure.add_subplot()
    tidy(axes, about.x, about.y)
    handles = []
    for place, band in enumerate(bands):
        colour = band.colour or SERIES_COLOURS[place % len(SERIES_COLOURS)]
        style = "--" if band.dashed or place >= DASHED else "-"
        marker = "o" if about.marked else ""
        handles += axes.plot(
            band.x, band.y, color=colour, linestyle=style, marker=marker, markersize=4.5, linewidth=1.7, label=band.name
        )
        if band.low is not None and band.high is not None:
            axes.fill_between(band.x, band.low, band.high, color=colour, alpha=PALE, linewidth=0)
    if about.log_x:
        axes.set_xscale("log")
        _plain_ticks(axes.xaxis)
    if about.log_y:
        axes.set_yscale("log")
        _plain_ticks(axes.yaxis)
    _legend(figure, handles)
    return png(figure)


def _legend(figure: "Figure", handles: Sequence["Line2D"]) -> None:
    """Below all axes, in as many columns as the names leave room for."""
    longest = max(len(str(handle.get_label())) for handle in handles)
    columns = max(1, min(len(handles), 4, LETTERS // (longest + 8)))
    figure.legend(
        handles=handles, loc="outside lower center", ncols=columns, frameon=False, fontsize=9, labelcolor=INK,
        handlelength=3.2,
    )  # fmt: skip


def _plain_ticks(axis: "Axis") -> None:
    """At 1, 2 and 5 times powers of ten, and at some between where those are far apart; as plain numbers."""
    from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 1.5, 2, 3, 5, 7) if high < NARROW * low else (1, 2, 5)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())
