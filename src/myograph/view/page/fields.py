"""The fields that a page can colour by, and the values at the ends of their colours.

The ends hold for all states, so that colours of two states can be compared: they are found on a sample of activations.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from myograph.case import MUSCLES
from myograph.fields import FIELDS
from myograph.inference.low_rank import LowRankMuscle
from myograph.view.page.network import PageNetwork
from myograph.view.page.truth import TruthCase

SAMPLED, SEED, PERCENTILE = 24, 0, 95.0
TWO_SIDED = {"fibre_stretch": 1.0}
"""Fields whose colours end as far below as above a value that means: nothing has changed."""
DRAWN_ANYHOW = ("position", "cauchy_stress", "von_mises")


@dataclass(frozen=True)
class FieldChoice:
    """A field by its key in the page; `low` and `high` are the ends of its colours."""

    key: str
    label: str
    unit: str
    low: float
    high: float
    meaning: str


def field_choices(
    muscles: Sequence[LowRankMuscle], belly: Sequence[Int[np.ndarray, " _"]], truth: Sequence[TruthCase]
) -> list[FieldChoice]:
    """What all muscles have; errors only where there is a truth.

    `belly` are the nodes of each muscle whose values decide the ends of the colours: thin tendons carry stresses that
    are far above those of all flesh.
    """
    found = _sampled(muscles, belly)
    if truth:
        found |= _errors(muscles, belly, truth)
    calibrated = all("position" in muscle.half_width_90 for muscle in muscles)
    told = all("von_mises" in muscle.half_width_90 for muscle in muscles)
    words = {
        "von_mises": ("von Mises stress", "MPa", FIELDS["von_mises"].meaning),
        "displacement": ("displacement", "mm", "distance from the relaxed arm"),
        "deviation": _unsure("position", "mm", calibrated),
        "stress_deviation": _unsure("von Mises stress", "MPa", told),
        "error": ("model minus truth, position", "mm", "distance between the model's and the finite elements' nodes"),
        "stress_error": ("model minus truth, von Mises", "MPa", "absolute difference"),
    }
    choices = [FieldChoice("muscle", "muscles", "", 0.0, 1.0, "belly in the muscle's hue, tendon white")]
    for key in [*words, *(name for name in found if name not in words)]:
        if key in found:
            label, unit, meaning = words.get(key) or (key.replace("_", " "), FIELDS[key].unit, FIELDS[key].meaning)
            low, high = _ends(found[key], key in words)
            if key in TWO_SIDED:
                middle = TWO_SIDED[key]
                far = max(middle - low, high - middle)
                low, high = middle - far, middle + far
            choices.append(FieldChoice(key, label, unit, low, high, meaning))
    return choices


def network_choice(network: PageNetwork, belly: Int[np.ndarray, " _"]) -> FieldChoice:
    """How far the network's muscle is from that of the modes."""
    muscle = network.muscle
    load = muscle.trained_range.hand_load[0]
    apart = [
        np.linalg.norm(network.positions(row, load, belly) - muscle.at(row, load)["position"][belly], axis=1)
        for row in samples([muscle])
    ]
    ends = _ends(np.concatenate(apart), from_zero=True)
    return FieldChoice("difference", "network minus modes", "mm", *ends, "distance between the nodes of both")


def samples(muscles: Sequence[LowRankMuscle]) -> Float[np.ndarray, "samples muscles"]:
    """Activations within the trained range: at random, at rest, and each muscle alone."""
    trained = muscles[0].trained_range
    low, high = np.array(trained.activation_low), np.array(trained.activation_high)
    random = np.random.default_rng(SEED).random((SAMPLED, len(MUSCLES)))
    return np.concatenate([low + (high - low) * random, low[None], np.where(np.eye(len(MUSCLES)) > 0, high, low)])


def _unsure(of: str, unit: str, calibrated: bool) -> tuple[str, str, str]:
    if calibrated:
        return f"90 % within, {of}", unit, f"nine of ten true values of the {of} lie within this of the model's"
    return f"predicted deviation, {of}", unit, f"standard deviation of the {of}, not calibrated"


def _sampled(muscles: Sequence[LowRankMuscle], belly: Sequence[Int[np.ndarray, " _"]]) -> dict[str, np.ndarray]:
    """Values of these nodes in all samples, by key; fields that not all muscles have are left out."""
    found: dict[str, list[np.ndarray]] = {}
    load = muscles[0].trained_range.hand_load[0]
    for muscle, nodes in zip(muscles, belly, strict=True):
        rest = muscle.at(samples(muscles)[SAMPLED], load)["position"]
        each: dict[str, list[np.ndarray]] = {}
        for activation in samples(muscles):
            for key, values in _values(muscle, activation, load, rest).items():
                each.setdefault(key, []).append(values[nodes])
        for key, rows in each.items():
            found.setdefault(key, []).append(np.concatenate(rows))
    return {key: np.concatenate(rows) for key, rows in found.items() if len(rows) == len(muscles)}


def _values(
    muscle: LowRankMuscle, activation: np.ndarray, load: float, rest: np.ndarray
) -> dict[str, Float[np.ndarray, " nodes"]]:
    place = muscle.place(activation, load)
    fields, deviations = muscle.at_place(place), muscle.deviations(place)
    factor = muscle.half_width_90
    found = {"displacement": np.linalg.norm(fields["position"] - rest, axis=1)}
    found["deviation"] = factor.get("position", 1.0) * deviations["position"]
    if "von_mises" in fields:
        found["von_mises"] = fields["von_mises"]
    if "von_mises" in deviations:
        found["stress_deviation"] = factor.get("von_mises", 1.0) * deviations["von_mises"]
    return found | {name: values for name, values in fields.items() if name not in DRAWN_ANYHOW and values.ndim == 1}


def _errors(
    muscles: Sequence[LowRankMuscle], belly: Sequence[Int[np.ndarray, " _"]], truth: Sequence[TruthCase]
) -> dict[str, np.ndarray]:
    missed: dict[str, list[np.ndarray]] = {"error": [], "stress_error": []}
    for muscle, nodes in zip(muscles, belly, strict=True):
        for case in truth:
            if muscle.muscle not in case.positions:
                continue
            fields = muscle.at(case.activation, case.hand_load)
            apart = np.linalg.norm(fields["position"] - case.positions[muscle.muscle], axis=1)
            missed["error"].append(apart[nodes])
            if "von_mises" in fields and muscle.muscle in case.stresses:
                stress = fields["von_mises"]
                missed["stress_error"].append(np.abs(stress - case.stresses[muscle.muscle])[nodes])
    return {key: np.concatenate(rows) for key, rows in missed.items() if rows}


def _ends(values: Float[np.ndarray, " values"], from_zero: bool) -> tuple[float, float]:
    """Zero or a round number that nearly all values lie above, and one that nearly all lie below."""
    low, high = (float(np.percentile(values, part)) for part in (100 - PERCENTILE, PERCENTILE))
    low = 0.0 if from_zero else low
    step = 10.0 ** np.floor(np.log10(max(high - low, 1e-9))) / 2
    return float(np.floor(low / step) * step), float(np.ceil(high / step) * step)
