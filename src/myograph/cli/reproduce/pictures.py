"""Figures of what was found, in the thesis's forms."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from myograph.cli.dataset.pictures import card_picture
from myograph.cli.reproduce.outcome import Outcome
from myograph.ensemble.pairs.protocols import Protocol
from myograph.evaluation import Figure
from myograph.learning.gen.mesh import delaunay_edges
from myograph.view.bands import Axes, Band, draw_bands
from myograph.view.dots import draw_error_dots
from myograph.view.heat import draw_heat_maps
from myograph.view.network import NetworkNodes, draw_network_nodes
from myograph.view.palette import SERIES_COLOURS

BINS = 8
"""Of distances from the training set."""


def dataset(outcome: Outcome, as_in: str) -> Figure:
    """The cases at a glance: elbow angles, activations, the muscle where it is least and most active."""
    caption = (
        f"The cases (figures {as_in} of the thesis): elbow angles at equilibrium, how many cases have an activation of "
        "each class, and the biceps in the cases of its least and its largest activation."
    )
    cases = outcome.data.cases("ensemble")
    field = "von_mises" if "von_mises" in cases.fields else "displacement"
    return Figure(caption, card_picture(cases, field), caption)


def meshes(outcome: Outcome, names: Sequence[str], as_in: str) -> Figure:
    """Nodes of the graphs before and after training."""
    before, after = [], []
    for name in names:
        first, last = (outcome.array(name, "thesis", which) for which in ("nodes_before", "nodes_after"))
        assert first is not None
        assert last is not None
        before.append(NetworkNodes(f"{name}, before", first, delaunay_edges(first)))
        after.append(NetworkNodes(f"{name}, after", last, delaunay_edges(last)))
    cloud = outcome.data.cases(outcome.trials[0].cases.store).values("position", np.array([0]))[0].astype(np.float64)
    caption = (
        f"Nodes of the graphs before and after training (figure {as_in} of the thesis), the relaxed muscle behind."
    )
    return Figure(caption, draw_network_nodes(before, after, cloud), "Nodes of the graphs before and after training")


def heat(
    outcome: Outcome, names: Sequence[str], protocol: Protocol, unit: str, as_in: str | None = None
) -> tuple[Figure, ...]:
    """Mean error of each node on the skin, as in that figure of the thesis; no figure for a body without a skin."""
    body = outcome.data.cases(outcome.trials[0].cases.store).body
    found = {name: outcome.array(name, protocol, f"node_{unit}_{protocol}") for name in names}
    errors = {name.replace(", ", ",\n"): values for name, values in found.items() if values is not None}
    if not errors or not len(body.skin):
        return ()
    picture = draw_heat_maps(body.reference, body.skin, errors, "MPa" if unit == "mpa" else unit)
    thesis = f" (figure {as_in} of the thesis)" if as_in else ""
    caption = f"Where the errors sit, protocol {protocol}{thesis}, first seed; sensors are grey."
    return (Figure(caption, picture, f"Heat maps of the error on the biceps: {'; '.join(found)}"),)


def dots(outcome: Outcome, caption: str) -> Figure:
    """Mean and 95th percentile of all methods."""
    alt = f"Mean and 95th percentile of the error under each protocol: {'; '.join(outcome.names)}"
    return Figure(caption, draw_error_dots(outcome.summaries()), alt)


def far(outcome: Outcome, names: Sequence[str], protocol: Protocol, unit: str = "mm") -> Figure:
    """Error over the distance of the asked activations from those that taught."""
    bands = []
    for name in names:
        found = outcome.array(name, protocol, f"far_{unit.lower()}_{protocol}")
        if found is not None:
            bands.append(_binned(name, found))
    axes = Axes("distance of the activations from the nearest that taught [-]", f"mean error of a pair [{unit}]")
    caption = (
        f"Error over the distance from the training set, protocol {protocol}, first seed; bands: half of the pairs."
    )
    alt = f"Mean error over the distance from the training set: {'; '.join(band.name for band in bands)}"
    return Figure(caption, draw_bands(bands, axes), alt)


def curves(outcome: Outcome, caption: str) -> Figure:
    """Training curves, bands from the least to the largest of the seeds."""
    bands = []
    for name in outcome.names:
        each = [found.arrays["curve"] for found in outcome.of(name, "thesis")]
        rmse = np.stack([curve[1] for curve in each])
        bands.append(Band(name, each[0][0], rmse.mean(axis=0), rmse.min(axis=0), rmse.max(axis=0)))
    axes = Axes("training step", "RMSE of the batches [mm]", marked=False)
    return Figure(caption, draw_bands(bands, axes), f"Training curves with bands: {'; '.join(outcome.names)}")


def over(
    outcome: Outcome, groups: dict[str, dict[float, str]], about: tuple[str, str], protocols: Sequence[Protocol]
) -> Figure:
    """Mean error of rows over a number: group -> number -> row; a line for each group and protocol.

    `about` is the label of the number and the caption.
    """
    bands = []
    for protocol in protocols:
        for group, rows in groups.items():
            there = {number: name for number, name in rows.items() if outcome.of(name, protocol)}
            if not there:
                continue
            mean, deviation = outcome.values(list(there.values()), protocol)
            x = np.array(list(there), dtype=float)
            several = deviation.any()
            low, high = (mean - deviation, mean + deviation) if several else (None, None)
            bands.append(Band(f"{group}, {protocol}", x, mean, low, high, dashed=protocol == "strict"))
    label, caption = about
    return Figure(caption, draw_bands(_coloured(bands), Axes(label, "mean error [mm]", log_x=True)), caption)


def _coloured(bands: Sequence[Band]) -> list[Band]:
    """One colour for the lines of a group, whatever their protocol."""
    groups = list(dict.fromkeys(band.name.rsplit(", ", 1)[0] for band in bands))
    colour = {group: SERIES_COLOURS[place % len(SERIES_COLOURS)] for place, group in enumerate(groups)}
    return [replace(band, colour=colour[band.name.rsplit(", ", 1)[0]]) for band in bands]


def _binned(name: str, found: Float[np.ndarray, "2 pairs"]) -> Band:
    """Mean error over the distance, as many pairs in each bin, with quartiles."""
    distance, error = found[:, np.argsort(found[0])]
    parts = [part for part in np.array_split(np.arange(len(distance)), BINS) if len(part)]
    x = np.array([distance[part].mean() for part in parts])
    low, high = (np.array([np.percentile(error[part], q) for part in parts], dtype=float) for q in (25, 75))
    return Band(name, x, np.array([error[part].mean() for part in parts], dtype=float), low, high)
