"""A movement over time: the elbow's angle, the muscles' activations, and the moments about the elbow."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.view.canvas import legend_below, new_figure, png, tidy
from myograph.view.palette import INK, muscle_colours


def draw_movement(
    times: Float[np.ndarray, " times"],
    angle_deg: Float[np.ndarray, " times"],
    activations: Mapping[str, Float[np.ndarray, " times"]],
    moments_nm: Mapping[str, Float[np.ndarray, " times"]],
    outside_nm: Float[np.ndarray, " times"],
    excitations: Mapping[str, Float[np.ndarray, " times"]] | None = None,
) -> bytes:
    """PNG of three plots on one axis of time [s].

    Parameters
    ----------
    moments_nm, outside_nm
        Of each muscle, and of all that is none [N·m]; positive flexes.
    excitations
        Drawn faintly beside the activations, where these lag behind.
    """
    if len(times) < 2 or not activations or set(activations) != set(moments_nm):
        raise InputError(
            "picture of a movement: expected at least two times, and activations and moments of the same muscles; got"
            f" {len(times)} times, {', '.join(activations) or 'none'} and {', '.join(moments_nm) or 'none'}"
        )
    figure = new_figure(7.6, 8.4)
    from matplotlib.lines import Line2D

    top, middle, bottom = figure.subplots(3, 1, sharex=True)
    colours = muscle_colours(activations)
    tidy(top, "", "elbow flexion [°]")
    top.plot(times, angle_deg, color=INK, linewidth=1.8)
    tidy(middle, "", "activation")
    tidy(bottom, "time [s]", "moment [N·m]; positive flexes")
    bottom.axhline(0, color=INK, linewidth=0.8)
    for name, colour in colours.items():
        if excitations is not None:
            middle.plot(times, excitations[name], color=colour, linewidth=0.9, linestyle=":")
        middle.plot(times, activations[name], color=colour, linewidth=1.8)
        bottom.plot(times, moments_nm[name], color=colour, linewidth=1.8)
    middle.set_ylim(-0.04, 1.04)
    bottom.plot(times, outside_nm, color=INK, linewidth=1.5, linestyle="--")
    handles = [Line2D([], [], color=colour, linewidth=1.8, label=name) for name, colour in colours.items()]
    if excitations is not None:
        handles.append(Line2D([], [], color=INK, linewidth=0.9, linestyle=":", label="excitation"))
    handles.append(Line2D([], [], color=INK, linewidth=1.5, linestyle="--", label="weights, stops"))
    legend_below(figure, handles)
    return png(figure)
