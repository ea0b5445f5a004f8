"""Edge: the smallest model within 0.5 mm, weighed; and how many simulations a model needs, chosen at random or not.

The smallest is chosen by the errors of the table itself, from one seed, out of those that were tried.
Models that know the activations learn from all cases of the ensemble. Multiply-adds are of one answer at all nodes.
The learning curve takes its cases out of the ensemble's random tenths, and tests on continuous activations.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.experiment import Experiment, corners, taught_twice
from myograph.cli.reproduce.outcome import Outcome, Row, table_rows
from myograph.cli.reproduce.pictures import over
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Choice, Chosen, Drawn, Trial
from myograph.evaluation import Figure
from myograph.view.bands import Axes, Band, draw_bands

WITHIN_MM = 0.5
MODES = (1, 2, 3, 4, 8, 16)
LATENTS = (4, 8, 16, 32)
CHOICES: dict[Choice, str] = {"random": "random", "deviation": "largest deviation", "overall": "least deviation left"}
"""How the next case is chosen -> as it stands in the table."""
LEARNERS: tuple[tuple[str, Choice], ...] = (*(("pod_gp", by) for by in CHOICES), ("neural_modes", "random"))
"""Of the learning curve."""
SMALLEST = f"smallest tried with a mean within {WITHIN_MM} mm"


def trials(data: Data, size: Size) -> Sequence[Trial]:
    """Neural modes of few modes, thin graph networks, and learning curves."""
    few, many, training = corners(data), corners(data, support=True), size.training(2)
    rows = []
    for modes in MODES[: size.thin]:
        options = {"modes": modes, "width": 10, "members": 1}
        rows.append(taught_twice(_modes(modes), "neural_modes", many, size, options=options))
    for latent in LATENTS[: size.thin]:
        options = {"latent": latent, "hidden": (latent,), "skip": "affine"}
        rows.append(taught_twice(_thin(latent), "gen", few, size, options=options, training=training))
    thin = [replace(t, weighed=t.teaching == "off_grid") for row in rows for t in row]
    return [*thin, *_curve(data, size)]


def _curve(data: Data, size: Size) -> list[Trial]:
    """Gaussian processes by all choices, neural modes by random cases, both from several seeds."""
    pool = data.numbers("ensemble", "support")[: size.support]
    cases = Chosen("ensemble", pool, data.numbers("ensemble", "off_grid")[: size.off_grid])
    found = []
    for count in _counts(data, size):
        for method, by in LEARNERS:
            name, drawn = _taught(method, count, by), Drawn(count, by)
            plain = Trial(name, method, cases, "off_grid", pairs=size.pairs, drawn=drawn)
            found += [replace(plain, seed=seed) for seed in range(size.seeds)]
    return found


def figures(outcome: Outcome) -> tuple[Figure, ...]:
    """Error over size, and over the number of simulations."""
    counts = _counts(outcome.data, outcome.size)
    groups = {
        f"{method}, {CHOICES[by]}": {float(count): _taught(method, count, by) for count in counts}
        for method, by in LEARNERS
    }
    caption = (
        "How many simulations are needed: mean error over the number of cases. The next cases of a Gaussian process "
        "are drawn at random, or where its predicted deviation is largest, or where they lower the deviation of all "
        f"cases most; means and deviations over {outcome.size.seeds} seeds."
    )
    return (*_weights(outcome), over(outcome, groups, ("simulated cases", caption), ("off_grid",)))


def rows(outcome: Outcome) -> list[Row]:
    """Those of the trials; the smallest of each kind within the limit, under both protocols, stands first."""
    plain = table_rows(outcome)
    smallest = [name for names in _kinds(outcome.size).values() if (name := _smallest(outcome, names)) is not None]
    again = [{**row, "name": f"{SMALLEST}: {name}"} for name in smallest for row in plain if row["name"] == name]
    return [*again, *plain]


def _smallest(outcome: Outcome, names: Sequence[str]) -> str | None:
    within = [
        name for name in names if all(outcome.mean(name, protocol) <= WITHIN_MM for protocol in ("strict", "off_grid"))
    ]
    return min(within, key=lambda name: outcome.of(name, "off_grid")[0].told["weights_kb"], default=None)


def _weights(outcome: Outcome) -> tuple[Figure, ...]:
    """None where nothing could be weighed."""
    bands = []
    for group, tried in _kinds(outcome.size).items():
        names = [name for name in tried if outcome.of(name, "off_grid")]
        if not names:
            continue
        x = np.array([outcome.of(name, "off_grid")[0].told["weights_kb"] for name in names])
        for protocol in ("off_grid", "strict"):
            errors = outcome.values(names, protocol)[0]
            bands.append(Band(f"{group}, {protocol}", x, errors, dashed=protocol == "strict"))
    if not bands:
        return ()
    limit = np.array([WITHIN_MM, WITHIN_MM])
    bands.append(Band(f"{WITHIN_MM} mm", np.array([1.0, 1000.0]), limit, dashed=True, colour="#22262b"))
    caption = "Mean error over the size of the weights, one seed: what a prosthesis would have to hold."
    return (Figure(caption, draw_bands(bands, Axes("weights [kB]", "mean error [mm]", log_x=True)), caption),)


def _kinds(size: Size) -> dict[str, list[str]]:
    """Kind of thin model -> its rows."""
    modes, latents = map(_modes, MODES[: size.thin]), map(_thin, LATENTS[: size.thin])
    return {"neural modes": list(modes), "thin graphs": list(latents)}


def _counts(data: Data, size: Size) -> list[int]:
    there = len(data.numbers("ensemble", "support")[: size.support])
    return [count for count in size.taught if count <= there]


def _modes(modes: int) -> str:
    return f"neural_modes, {modes} mode{'s' if modes > 1 else ''}"


def _thin(latent: int) -> str:
    return f"gen_8, latent {latent}"


def _taught(method: str, count: int, by: Choice) -> str:
    return f"{method}, {count} cases, {CHOICES[by]}"


EXPERIMENT = Experiment(trials, figures, rows)
