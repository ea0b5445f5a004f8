"""The check of what a method that answers from sensors is given."""

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError


def check_samples(
    sensors: Float[np.ndarray, "batch sensors 6"], queries: Float[np.ndarray, "batch queries 3"], at_least: int = 1
) -> None:
    """Raise InputError unless the samples are finite and each has enough sensors, at different places."""
    if not np.isfinite(sensors).all() or not np.isfinite(queries).all():
        raise InputError("sensors and queries: expected finite positions in mm, got NaN or infinity")
    if sensors.shape[1] < at_least:
        raise InputError(f"expected at least {at_least} sensors, got {sensors.shape[1]}; measure more nodes")
    for sample, places in enumerate(sensors[..., :3]):
        different = len(np.unique(places, axis=0))
        if different < len(places):
            raise InputError(
                f"sample {sample}: expected {len(places)} sensors at different places, got {different}; "
                "leave out the copies"
            )
