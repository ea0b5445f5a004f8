"""What is in a dataset: elbow angles, activations, a muscle in some of its states, the values of a field."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.view.canvas import new_figure, png, tidy
from myograph.view.palette import FAINT, INK, MUSCLE_COLOURS, SERIES_COLOURS
from myograph.view.scene import PaintedSurface, draw_surfaces, side_camera
from myograph.view.stage import draw_scale_bar, extent_of, set_stage

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

BINS, LEVELS = 24, 10
"""Bars of a histogram of angles; activations are counted in classes about 0, 1/10, ..., 1."""


@dataclass(frozen=True)
class PaintedState:
    """A muscle in one case: its nodes [mm] and a value at each of them."""

    title: str
    points: Float[np.ndarray, "nodes 3"]
    values: Float[np.ndarray, " nodes"]


@dataclass(frozen=True)
class PaintedStates:
    """A muscle in some cases, on one colour scale.

    Parameters
    ----------
    quads
        Its skin; bodies without one are drawn as points.
    label
        What the colours mean, with the unit.
    """

    states: Sequence[PaintedState]
    quads: Int[np.ndarray, "facets 4"]
    label: str

    def __post_init__(self) -> None:
        if not self.states:
            raise InputError("states of a muscle: expected at least one, got none")


def draw_card(
    angles: Float[np.ndarray, " cases"], activations: Mapping[str, Float[np.ndarray, " cases"]], states: PaintedStates
) -> bytes:
    """PNG of a dataset at a glance.

    Parameters
    ----------
    angles
        Elbow flexion [degrees]; NaN where it is not known.
    activations
        Muscle -> its activation in every case.
    """
    figure = new_figure(11.0, 6.4)
    grid = figure.add_gridspec(2, 1 + len(states.states), width_ratios=[1.6] + [1] * len(states.states))
    _draw_angles(figure.add_subplot(grid[0, 0]), angles)
    _draw_coverage(figure, figure.add_subplot(grid[1, 0]), activations)
    _draw_states(figure, [figure.add_subplot(grid[:, 1 + k]) for k in range(len(states.states))], states)
    return png(figure)


def draw_field(
    states: PaintedStates, edges: Float[np.ndarray, " edges"], counts: Mapping[str, Int[np.ndarray, " bins"]]
) -> bytes:
    """PNG of a field: on a muscle in some states, and how often each value occurs.

    Parameters
    ----------
    edges
        Ends of the classes of values.
    counts
        Word, such as that of a design -> number of nodes in each class, over all its cases.
    """
    figure = new_figure(11.0, 5.6)
    grid = figure.add_gridspec(1, 1 + len(states.states), width_ratios=[2.0] + [1] * len(states.states))
    axes = figure.add_subplot(grid[0, 0])
    for (word, values), colour in zip(counts.items(), SERIES_COLOURS * len(counts), strict=False):
        share = values / max(values.sum(), 1)
        axes.stairs(share, edges, color=colour, linewidth=1.6, label=f"{word}: {values.sum():,} values")
    axes.set_yscale("log")
    axes.legend(frameon=False, fontsize=9, labelcolor=INK)
    tidy(axes, states.label, "share of all nodes in all cases")
    _draw_states(figure, [figure.add_subplot(grid[0, 1 + k]) for k in range(len(states.states))], states)
    return png(figure)


def _draw_angles(axes: "Axes", angles: Float[np.ndarray, " cases"]) -> None:
    known = angles[np.isfinite(angles)]
    if len(known):
        axes.hist(known, bins=BINS, color=SERIES_COLOURS[0], edgecolor="white", linewidth=0.5)
    else:
        axes.text(0.5, 0.5, "elbow angles are not known", ha="center", color=INK, transform=axes.transAxes)
    tidy(axes, "elbow flexion [degrees]", "cases")


def _draw_coverage(figure: "Figure", axes: "Axes", activations: Mapping[str, Float[np.ndarray, " cases"]]) -> None:
    """How many cases have an activation of each class, muscle by muscle."""
    half = 0.5 / LEVELS
    edges = np.linspace(-half, 1 + half, LEVELS + 2)
    counts = np.array([np.histogram(values, edges)[0] for values in activations.values()])
    image = axes.imshow(
        counts,
        aspect="auto",
        cmap="Blues",
        vmin=0,
        extent=(-half, 1 + half, len(counts) - 0.5, -0.5),
        interpolation="nearest",
    )
    axes.set_yticks(range(len(counts)), list(activations))
    for label, name in zip(axes.get_yticklabels(), activations, strict=True):
        label.set_color(MUSCLE_COLOURS.get(name, INK))
    axes.set_xlabel("activation", color=INK)
    axes.tick_params(axis="x", colors=INK, labelsize=9)
    axes.tick_params(axis="y", labelsize=9, length=0)
    axes.spines[:].set_color(FAINT)
    bar = figure.colorbar(image, ax=axes, pad=0.02, aspect=14)
    bar.set_label("cases", color=INK)


def _draw_states(figure: "Figure", panels: Sequence["Axes"], asked: PaintedStates) -> None:
    camera = side_camera()
    extent = extent_of([camera.project(state.points) for state in asked.states])
    scale = _scale([state.values for state in asked.states])
    for axes, state in zip(panels, asked.states, strict=True):
        set_stage(axes, extent)
        axes.set_title(state.title, color=INK, fontsize=10)
        paint = scale.to_rgba(state.values)[:, :3]
        if len(asked.quads):
            draw_surfaces(axes, camera, [PaintedSurface(state.points, asked.quads, paint)], relief=0.4)
        else:
            flat = camera.project(state.points)
            axes.scatter(flat[:, 0], flat[:, 1], s=6, c=paint, linewidths=0)
    draw_scale_bar(panels[-1], extent)
    bar = figure.colorbar(scale, ax=list(panels), shrink=0.6, aspect=28, pad=0.03)
    bar.set_label(asked.label, color=INK)


def _scale(values: Sequence[Float[np.ndarray, " nodes"]]) -> "ScalarMappable":
    """From the least to the largest value but the top hundredth, low values spread by a square root.

    So a few hot nodes, or tendons many times stiffer than the belly, do not hide the others.
    """
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import PowerNorm

    together: Any = np.concatenate(list(values))
    low, high = float(together.min()), float(np.quantile(together, 0.99))
    return ScalarMappable(PowerNorm(0.5, low, high if high > low else low + 1), colormaps["viridis"])
