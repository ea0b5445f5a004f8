"""How long one answer takes: one forward pass for all nodes, on as many threads as the model was loaded with."""

import time
from dataclasses import replace

import numpy as np

from myograph.inference.asking import Asked, question_of
from myograph.inference.feeds import feeds
from myograph.inference.loaded import LoadedModel
from myograph.inference.session import run_session


def forward_milliseconds(model: LoadedModel, repeats: int = 30) -> float:
    """Median over the repeats of the time of one pass of the network for all nodes of one case, at rest [ms]."""
    signature, body = model.told.signature, model.body
    sensors = np.array(signature.sensors, dtype=np.int64)
    asked = Asked(
        np.array([model.told.trained_range.activation_low]),
        np.array([model.told.trained_range.hand_load[0]]),
        sensors,
        body.rest["position"][sensors][None].astype(np.float64),
        np.arange(body.nodes),
    )
    question = question_of(asked, signature, body)
    given = feeds(replace(question, sensor_target=question.sensor_initial), signature.inputs)
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        run_session(model.session, given, signature.outputs)
        times.append(time.perf_counter() - started)
    return 1000 * float(np.median(times))
