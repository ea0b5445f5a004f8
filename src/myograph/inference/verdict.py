"""Whether what is asked lies within what a model was trained on.

from activations   each within the least and the largest of training, the load too; neither where they are not known
from sensors       each target position within its node's box of training, widened by a tenth of its diagonal, and by a
                   thousandth of the body's length: the box of a node that is clamped is a point
                   other sensors than those of the training only by a model that gives a residual
both               the sensors' residual at most the one of calibration, where the model gives one

Where the sensors are measured with noise, boxes are wider by three of its standard deviations, and the residual may be
what calibration and noise together stay below in 99 of 100 cases.
"""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Bool
from scipy.special import chdtri

from myograph.ensemble.pairs.question import Question
from myograph.inference.body_file import ModelBody
from myograph.inference.model_file import TrainedRange
from myograph.inference.signature import RESIDUAL, Signature
from myograph.inference.ways import judges_sensors

WIDENED = 0.1
"""Share of a box's diagonal by which it is widened: the next case of the same kind may lie a little beyond."""
MEASURED = 1e-3
"""Share of the resting body's length that a measured position may be off."""
NOISY = 3.0
"""Standard deviations of the sensors' noise that a coordinate may be off."""
ROUNDING = 1e-6
"""What single precision makes of 1, twenty times over."""


def inside(
    question: Question,
    outputs: Mapping[str, np.ndarray],
    model: tuple[Signature, TrainedRange, ModelBody],
    sensor_noise: float = 0.0,
) -> Bool[np.ndarray, " batch"]:
    """The verdict on each pair, whose sensors' coordinates are measured with this standard deviation [mm]."""
    signature, trained, body = model
    verdict = np.ones(question.size, dtype=bool)
    if "activation" in signature.inputs:
        told = ~np.isnan(question.activation).all(axis=1)
        within = _within(question.activation, trained.activation_low, trained.activation_high, ROUNDING).all(axis=1)
        verdict &= within | ~told
        load = np.array(trained.hand_load)
        slack = ROUNDING * max(1.0, float(abs(load).max()))
        verdict &= _within(question.hand_load, load[0], load[1], slack) | ~told
    if signature.takes_sensors and len(question.sensor_nodes):
        low, high = body.low[question.sensor_nodes], body.high[question.sensor_nodes]
        length = float(np.linalg.norm(np.ptp(body.rest["position"], axis=0)))
        slack = WIDENED * np.linalg.norm(high - low, axis=-1, keepdims=True) + MEASURED * length + NOISY * sensor_noise
        verdict &= _within(question.sensor_target["position"], low, high, slack).all(axis=(1, 2))
    if RESIDUAL in outputs and trained.residual_mm is not None:
        verdict &= outputs[RESIDUAL] <= np.hypot(trained.residual_mm, _residual_99(question, sensor_noise))
    return verdict & judges_sensors(question, signature)


def _residual_99(question: Question, sensor_noise: float) -> float:
    """Residual [mm] that noise alone stays below in 99 of 100 cases, however little of it the answer follows."""
    sensors = len(question.sensor_nodes)
    if not sensors or not sensor_noise:
        return 0.0
    return sensor_noise * float(np.sqrt(chdtri(3 * sensors, 0.01) / sensors))


def _within(values: np.ndarray, low: object, high: object, slack: object) -> np.ndarray:
    return (values >= np.asarray(low) - np.asarray(slack)) & (values <= np.asarray(high) + np.asarray(slack))
