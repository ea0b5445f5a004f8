"""A question that every model can be asked, whatever it reads: its sensors where they are at rest, all nodes asked."""

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from myograph.ensemble.pairs.question import Question
from myograph.inference.asking import Asked, question_of
from myograph.inference.loaded import LoadedModel


def question_at_rest(model: LoadedModel, activation: Float[np.ndarray, "cases muscles"]) -> Question:
    """Of these activations, under the least load of the training; every field that the sensors tell is that at rest."""
    signature, body = model.told.signature, model.body
    sensors, size = np.array(signature.sensors, dtype=np.int64), len(activation)
    asked = Asked(
        activation,
        np.full(size, model.told.trained_range.hand_load[0]),
        sensors,
        np.repeat(body.rest["position"][sensors][None].astype(np.float64), size, axis=0),
        np.arange(body.nodes),
    )
    question = question_of(asked, signature, body)
    return replace(question, sensor_target=question.sensor_initial)
