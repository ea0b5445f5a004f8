"""The check of what a method that answers from sensors is told."""

import numpy as np
from jaxtyping import Float

from myograph.ensemble.pairs.question import Question
from myograph.errors import InputError

AFFINE_SENSORS = 4
"""Points that an affine map of space needs."""


def sensed_movement(
    question: Question,
) -> tuple[Float[np.ndarray, "batch sensors 3"], Float[np.ndarray, "batch sensors 3"]]:
    """Places of the sensors and where they are in the target cases [mm].

    Raises InputError unless these are finite, enough, and at different places.
    """
    places, targets = question.sensor_places, question.sensor_target["position"]
    for points in (places, targets, question.query_places):
        if not np.isfinite(points).all():
            raise InputError("sensors and queries: expected finite positions in mm, got NaN or infinity")
    if places.shape[1] < AFFINE_SENSORS:
        raise InputError(f"expected at least {AFFINE_SENSORS} sensors, got {places.shape[1]}; measure more nodes")
    for pair, own in enumerate(places):
        different = len(np.unique(own, axis=0))
        if different < len(own):
            raise InputError(
                f"pair {pair}: expected {len(own)} sensors at different places, got {different}; leave out the copies"
            )
    return places, targets


def check_spatial(places: Float[np.ndarray, "batch sensors 3"]) -> None:
    """Raise InputError where the sensors of a pair span no volume: an affine map needs four that do."""
    centred = places - places.mean(axis=1, keepdims=True)
    flat = np.flatnonzero(np.linalg.matrix_rank(centred) < AFFINE_SENSORS - 1)
    if len(flat):
        raise InputError(f"pair {flat[0]}: expected sensors that span a volume, got all in one plane; choose others")
