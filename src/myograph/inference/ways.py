"""The ways a model may be told: by activations, by sensors, or by both; each has errors of its own.

A model that answers from both, and where either is missing from the other, is asked in three ways. Whatever else a
model reads, it is told all that it takes: `WHOLE`.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from myograph.ensemble.pairs.question import Question
from myograph.inference.signature import DEVIATION, RESIDUAL, Signature

Way = Literal["activation", "sensors"]
"""Told nothing else, by a model that could be told more."""
WAYS: tuple[Way, ...] = get_args(Way)
WHOLE = "all"
"""The way of being told everything."""
Scales = Mapping[str, float]
"""Field -> half width over deviation, or half width in the field's unit."""
NORMAL_90 = 1.645
"""Half width over deviation that holds 90 % of a normal distribution along a line, and more of one across space."""


def ways(signature: Signature) -> tuple[Way, ...]:
    """How else than by everything that it takes a model may be told."""
    either = signature.takes_sensors and signature.unknown_activation and signature.least_sensors == 0
    return WAYS if either else ()


def told_only(question: Question, way: str) -> Question:
    """The same question, told in that way."""
    if way == "activation":
        return without_sensors(question)
    return without_activation(question) if way == "sensors" else question


def without_sensors(question: Question) -> Question:
    """The same, told nothing by sensors."""
    return replace(
        question,
        sensor_nodes=question.sensor_nodes[:0],
        sensor_places=question.sensor_places[:, :0],
        sensor_initial={name: values[:, :0] for name, values in question.sensor_initial.items()},
        sensor_target={name: values[:, :0] for name, values in question.sensor_target.items()},
    )


def without_activation(question: Question) -> Question:
    """The same, not told the activations."""
    return replace(question, activation=np.full_like(question.activation, np.nan))


def scales_of(
    question: Question, signature: Signature, whole: Scales, alone: Mapping[Way, Scales]
) -> dict[str, np.ndarray]:
    """Field -> the scale of each pair, by the way it is told; those of `whole` where `alone` says nothing else.

    Scales are calibrated with the sensors of the training. For others a field has at least `NORMAL_90` where the model
    says deviations, which know how many sensors there are and where; else it has none.
    """
    found = _by_way(question, signature, whole, alone)
    return found if usual_sensors(question, signature) else _normal_at_least(found, signature)


def with_noise(scales: Mapping[str, np.ndarray], signature: Signature, sensor_noise: float) -> dict[str, np.ndarray]:
    """The scales where coordinates of sensors are measured with this standard deviation [mm], not exactly.

    Deviations are made for the noise of the signature, and grow with it at most in proportion; a model that knows none
    has no intervals.
    """
    if not sensor_noise:
        return dict(scales)
    if signature.sensor_noise is None:
        return {}
    times = max(1.0, sensor_noise / signature.sensor_noise)
    return {name: times * scale for name, scale in _normal_at_least(scales, signature).items()}


def _normal_at_least(scales: Mapping[str, np.ndarray], signature: Signature) -> dict[str, np.ndarray]:
    """Of the fields that have deviations."""
    known = [name for name in scales if name + DEVIATION in signature.outputs]
    return {name: np.maximum(scales[name], NORMAL_90) for name in known}


def usual_sensors(question: Question, signature: Signature) -> bool:
    """Whether it is told by the sensors of the training, or by none."""
    given = set(question.sensor_nodes.tolist())
    return not signature.takes_sensors or not given or given == set(signature.sensors)


def judges_sensors(question: Question, signature: Signature) -> bool:
    """Whether the model knows these sensors, or tells by its residual how well it explains any."""
    return usual_sensors(question, signature) or RESIDUAL in signature.outputs


def _by_way(
    question: Question, signature: Signature, whole: Scales, alone: Mapping[Way, Scales]
) -> dict[str, np.ndarray]:
    if not alone or not ways(signature):
        return {name: np.full(question.size, scale) for name, scale in whole.items()}
    known = np.asarray(~np.isnan(question.activation).all(axis=1))
    sensed = len(question.sensor_nodes) > 0
    none = np.zeros_like(known)
    only: dict[Way, np.ndarray] = {"activation": none if sensed else known, "sensors": ~known if sensed else none}
    found = {}
    for name, scale in whole.items():
        found[name] = np.full(question.size, scale)
        for way, pairs in only.items():
            found[name][pairs] = alone.get(way, {}).get(name, scale)
    return found
