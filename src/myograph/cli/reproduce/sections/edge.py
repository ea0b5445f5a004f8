"""Edge: the smallest model within 0.5 mm, weighed; and how many simulations a model needs.

Models that know the activations learn from all cases of the ensemble. Multiply-adds are of one answer at all nodes.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from myograph.cli.reproduce.data import SEED, Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.pictures import over
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Chosen, Trial
from myograph.evaluation import Figure
from myograph.view.bands import Axes, Band, draw_bands

WITHIN_MM = 0.5
MODES = (2, 3, 4, 6, 8, 16)
LATENTS = (4, 8, 16, 32)
CHOICES = ("random", "spread")


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Neural modes of few modes, thin graph networks, and a learning curve."""
    few, many, training = corners(data), corners(data, support=True), {"steps": size.share(2)}
    rows = []
    for modes in MODES[: size.thin]:
        options = {"modes": modes, "width": 10, "members": 1}
        rows.append(taught_twice(_modes(modes), "neural_modes", many, size, options=options))
    for latent in LATENTS[: size.thin]:
        options = {"latent": latent, "hidden": (latent,), "skip": "affine"}
        rows.append(taught_twice(_thin(latent), "gen", few, size, options=options, training=training))
    for choice in CHOICES:
        for count in _counts(data, size):
            rows.append(taught_twice(_taught(choice, count), "pod_gp", _some(data, choice, count), size))
    trials = [trial for row in rows for trial in row]
    return [replace(t, weighed=t.method != "pod_gp" and t.teaching == "off_grid") for t in trials]


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Error over size, and over the number of simulations."""
    counts = _counts(outcome.data, outcome.size)
    groups = {f"pod_gp, {choice}": {float(n): _taught(choice, n) for n in counts} for choice in CHOICES}
    caption = (
        "How many simulations are needed: mean error of a Gaussian process over the number of cases, drawn at random "
        "or one after the other as far from all others as possible."
    )
    return _weights(outcome), over(outcome, groups, ("simulated cases", caption), ("off_grid", "strict"))


def _weights(outcome: Outcome) -> Figure:
    bands = []
    thin = outcome.size.thin
    for group, names in {"neural modes": map(_modes, MODES[:thin]), "thin graphs": map(_thin, LATENTS[:thin])}.items():
        named = list(names)
        for protocol in ("off_grid", "strict"):
            x = np.array([outcome.of(name, "off_grid")[0].told["weights_kb"] for name in named])
            errors = outcome.values(named, protocol)[0]
            bands.append(Band(f"{group}, {protocol}", x, errors, dashed=protocol == "strict"))
    bands.append(
        Band("0.5 mm", np.array([1.0, 1000.0]), np.array([WITHIN_MM, WITHIN_MM]), dashed=True, colour="#22262b")
    )
    caption = "Mean error over the size of the weights: what a prosthesis would have to hold."
    return Figure(caption, draw_bands(bands, Axes("weights [kB]", "mean error [mm]", log_x=True)), caption)


def _counts(data: Data, size: Size) -> list[int]:
    there = len(data.numbers("ensemble", "support"))
    return [count for count in size.taught if count <= there]


def _some(data: Data, choice: str, count: int) -> Chosen:
    """Cases with random tenths, as many; they stand for the factorial ones."""
    cases = data.cases("ensemble")
    there = cases.named("support")
    if choice == "random":
        drawn = np.random.default_rng(SEED).permutation(there)[:count]
    else:
        drawn = there[farthest(cases.activation[there], count)]
    return Chosen(
        "ensemble", tuple(np.sort(drawn).tolist()), data.numbers("ensemble", "off_grid")[: data.size.off_grid]
    )


def farthest(points: Float[np.ndarray, "points axes"], count: int) -> list[int]:
    """Points one after the other, each as far as possible from those before; the first is the nearest to the middle."""
    chosen = [int(np.linalg.norm(points - points.mean(axis=0), axis=1).argmin())]
    distance = np.linalg.norm(points - points[chosen[0]], axis=1)
    while len(chosen) < count:
        chosen.append(int(distance.argmax()))
        distance = np.minimum(distance, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return chosen


def _modes(modes: int) -> str:
    return f"neural_modes, {modes} modes"


def _thin(latent: int) -> str:
    return f"gen_8, latent {latent}"


def _taught(choice: str, count: int) -> str:
    return f"pod_gp, {count} {choice} cases"


EXPERIMENT = Experiment(trials, figures)
