"""Errors of many methods as dots on a logarithmic scale: a line for each method, a colour for each protocol."""

from collections.abc import Mapping

from myograph.errors import InputError
from myograph.evaluation import ErrorSummary
from myograph.view.canvas import legend_below, new_figure, png, tidy
from myograph.view.palette import FAINT, INK, SERIES_COLOURS

ROW = 0.34
"""Height of a method's line [inch]."""
NARROW = 200
"""Ratio of the ends of the axis up to which 2 and 5 are marked, too."""


def draw_error_dots(errors: Mapping[str, Mapping[str, ErrorSummary]]) -> bytes:
    """PNG of method -> protocol -> errors: a dot at the mean, a thin line up to the 95th percentile [mm].

    A method that does not answer positions has an empty line.
    """
    protocols = list(dict.fromkeys(protocol for summaries in errors.values() for protocol in summaries))
    if not protocols:
        raise InputError("dots of errors: expected at least one method under one protocol, got none")
    from matplotlib.lines import Line2D
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    figure = new_figure(8.2, 1.5 + ROW * len(errors))
    axes = figure.add_subplot()
    tidy(axes, "error of a node [mm]: mean, and 95th percentile at the end of the line", "")
    for place, summaries in enumerate(errors.values()):
        for index, protocol in enumerate(protocols):
            found = summaries.get(protocol)
            if found is None or found.mean_mm is None or found.p95_mm is None:
                continue
            height = place + 0.22 * (index - (len(protocols) - 1) / 2)
            colour = SERIES_COLOURS[index % len(SERIES_COLOURS)]
            axes.plot([found.mean_mm, found.p95_mm], [height, height], color=colour, linewidth=1.2, alpha=0.6)
            axes.plot([found.mean_mm], [height], "o", color=colour, markersize=5.5)
    for place in range(len(errors) - 1):
        axes.axhline(place + 0.5, color=FAINT, alpha=0.25, linewidth=0.6)
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < NARROW * low else (1,)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_yticks(range(len(errors)), list(errors), color=INK, fontsize=9)
    axes.set_ylim(len(errors) - 0.4, -0.6)
    axes.grid(visible=False, axis="y")
    handles = [
        Line2D([], [], color=SERIES_COLOURS[index % len(SERIES_COLOURS)], marker="o", label=protocol)
        for index, protocol in enumerate(protocols)
    ]
    legend_below(figure, handles)
    return png(figure)
