"""The check of what a model is asked: numbers that are numbers, and the sensors that it knows."""

import numpy as np

from myograph.case import MUSCLES, check_activation
from myograph.ensemble.pairs.question import Question
from myograph.errors import InputError
from myograph.inference.feeds import feeds
from myograph.inference.signature import Signature


def check_question(question: Question, signature: Signature) -> None:
    """Raise InputError unless the question is finite, in the model's convention, and from sensors that it knows."""
    if question.convention != signature.convention:
        raise InputError(
            f"expected points named by the convention '{signature.convention}', got '{question.convention}'; "
            "make the sampler with the model's convention"
        )
    for name, array in feeds(question, signature.inputs).items():
        if name != "activation" and not np.isfinite(array).all():
            raise InputError(f"{name}: expected finite numbers, got NaN or infinity")
    if "activation" in signature.inputs:
        _check_activation(question, signature)
    if signature.takes_sensors:
        _check_sensors(question, signature)


def _check_activation(question: Question, signature: Signature) -> None:
    rows = question.activation
    if rows.shape[1] != len(MUSCLES):
        raise InputError(f"activation: expected {len(MUSCLES)} ({', '.join(MUSCLES)}), got {rows.shape[1]}")
    if signature.unknown_activation:
        rows = rows[~np.isnan(rows).all(axis=1)]
    for values, muscle in zip(rows.T, MUSCLES, strict=True):
        if len(values):
            check_activation(float(values.min()), muscle)
            check_activation(float(values.max()), muscle)


def _check_sensors(question: Question, signature: Signature) -> None:
    given = tuple(question.sensor_nodes.tolist())
    if not signature.any_sensors and given != signature.sensors:
        raise InputError(
            f"expected the {len(signature.sensors)} sensors of the training, at the nodes {list(signature.sensors)}, "
            f"got {len(given)} at {list(given)}; give these in that order, or train with others"
        )
    if len(given) < signature.least_sensors:
        raise InputError(f"expected at least {signature.least_sensors} sensors, got {len(given)}; measure more nodes")
    for pair, places in enumerate(question.sensor_places):
        different = len(np.unique(places, axis=0))
        if different < len(places):
            raise InputError(
                f"pair {pair}: expected {len(places)} sensors at different places, got {different}; "
                "leave out the copies"
            )
