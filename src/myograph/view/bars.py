"""Errors of methods as bars, a group per protocol."""

from collections.abc import Mapping

import numpy as np

from myograph.errors import InputError
from myograph.evaluation import ErrorSummary
from myograph.view.canvas import legend_below, new_figure, png, tidy
from myograph.view.palette import INK, SERIES_COLOURS

PALE = 0.28


def draw_error_bars(errors: Mapping[str, Mapping[str, ErrorSummary]]) -> bytes:
    """PNG of method -> protocol -> errors: full bars for the mean, pale ones for the 95th percentile [mm].

    A method that does not answer positions has no bar.
    """
    protocols = list(dict.fromkeys(protocol for summaries in errors.values() for protocol in summaries))
    if not protocols:
        raise InputError("bars of errors: expected at least one method under one protocol, got none")
    figure = new_figure(max(7.6, 0.6 * len(errors) * len(protocols)), 4.4)
    from matplotlib.patches import Patch

    axes = figure.add_subplot()
    tidy(axes, "", "error of a node [mm]")
    handles = []
    width = 0.84 / len(errors)
    for place, (method, summaries) in enumerate(errors.items()):
        found = [(index, summaries[p]) for index, p in enumerate(protocols) if p in summaries]
        bars = [(index, s.mean_mm, s.p95_mm) for index, s in found if s.mean_mm is not None and s.p95_mm is not None]
        places, means, percentiles = np.array(bars).reshape(-1, 3).T
        centre = places + (place - (len(errors) - 1) / 2) * width
        colour = SERIES_COLOURS[place % len(SERIES_COLOURS)]
        axes.bar(centre, percentiles, 0.9 * width, color=colour, alpha=PALE)
        axes.bar(centre, means, 0.9 * width, color=colour)
        handles.append(Patch(color=colour, label=method))
    axes.set_xticks(range(len(protocols)), protocols)
    axes.grid(visible=False, axis="x")
    legend_below(figure, [*handles, Patch(color=INK, alpha=PALE, label="pale: 95th percentile")])
    return png(figure)
