"""Lines: training of networks, moments of muscles over the elbow angle, and anything else over anything."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from jaxtyping import Float, Num

from myograph.errors import InputError
from myograph.view.canvas import legend_below, new_figure, png, tidy
from myograph.view.palette import INK, SERIES_COLOURS, muscle_colours

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

Style = Literal["-", "--", ":", "-.", "none"]
STYLES: tuple[Style, ...] = ("-", "--", ":", "-.")


@dataclass(frozen=True)
class Line:
    """One line of a plot.

    Parameters
    ----------
    name
        For the legend; lines of one name share an entry, an empty name has none.
    colour, style, marker
        As matplotlib calls them: '#rrggbb'; '-', '--', ':', '-.' or 'none'; 'o', 's' or ''.
    """

    name: str
    x: Num[np.ndarray, " points"]
    y: Num[np.ndarray, " points_y"]
    colour: str = SERIES_COLOURS[0]
    style: Style = "-"
    marker: str = ""

    def __post_init__(self) -> None:
        if len(self.x) != len(self.y) or len(self.x) == 0:
            raise InputError(
                f"line '{self.name}': expected as many x as y, and some; got {len(self.x)} and {len(self.y)}"
            )


def draw_lines(lines: Sequence[Line], x_label: str, y_label: str, logarithmic: bool = False) -> bytes:
    """PNG of lines in one pair of axes; `logarithmic` is about y."""
    figure = _plot(lines, x_label, y_label, logarithmic)
    named = {line.name: line for line in lines if line.name}
    legend_below(figure, [_artist(line) for line in named.values()])
    return png(figure)


def draw_training(runs: Mapping[str, tuple[Num[np.ndarray, " points"], Float[np.ndarray, " points_y"]]]) -> bytes:
    """PNG of training curves: name of a run -> (steps, RMSE [mm] at these steps)."""
    colours = itertools.cycle(SERIES_COLOURS)
    lines = [Line(name, steps, rmse, next(colours)) for name, (steps, rmse) in runs.items()]
    return draw_lines(lines, "training step", "RMSE of node positions [mm]", logarithmic=True)


def draw_moments(
    angle_deg: Float[np.ndarray, " angles"], moments_nm: Mapping[str, Mapping[float, Float[np.ndarray, " angles"]]]
) -> bytes:
    """PNG of the muscles' moments over the elbow angle: a colour per muscle, a line style per activation.

    Parameters
    ----------
    moments_nm
        Muscle -> activation -> moment [N·m] at each angle; positive flexes.
    """
    levels = sorted({level for curves in moments_nm.values() for level in curves}, reverse=True)
    if len(levels) > len(STYLES):
        raise InputError(f"plot of moments: expected at most {len(STYLES)} activations, got {len(levels)}: {levels}")
    style = dict(zip(levels, STYLES, strict=False))
    colours = muscle_colours(moments_nm)
    lines = [
        Line("", angle_deg, moment, colours[muscle], style[level])
        for muscle, curves in moments_nm.items()
        for level, moment in curves.items()
    ]
    figure = _plot(lines, "elbow flexion [°]", "moment [N·m]; positive flexes", logarithmic=False)
    figure.axes[0].axhline(0, color=INK, linewidth=0.8)
    hues = [Line(muscle, angle_deg, angle_deg, colours[muscle]) for muscle in moments_nm]
    dashes = [Line(f"activation {level:g}", angle_deg, angle_deg, INK, style[level]) for level in levels]
    legend_below(figure, [_artist(line) for line in hues + dashes])
    return png(figure)


def _plot(lines: Sequence[Line], x_label: str, y_label: str, logarithmic: bool) -> "Figure":
    if not lines:
        raise InputError(f"plot of {y_label}: expected at least one line, got none")
    figure = new_figure(7.6, 4.4)
    axes = figure.add_subplot()
    tidy(axes, x_label, y_label)
    for line in lines:
        axes.add_line(_artist(line))
    axes.autoscale_view()
    if logarithmic:
        from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.yaxis.set_minor_formatter(NullFormatter())
    return figure


def _artist(line: Line) -> "Line2D":
    from matplotlib.lines import Line2D

    return Line2D(
        line.x, line.y, color=line.colour, linestyle=line.style, marker=line.marker, markersize=5, linewidth=1.8,
        label=line.name,
    )  # fmt: skip
