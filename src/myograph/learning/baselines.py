"""What sensors alone can tell, without learning: the methods that a network must beat.

do nothing          T = S
affine              T = A S + b, least squares on the sensors
thin-plate spline   T = A S + b + sum_i w_i |S - S_i|² log |S - S_i|, through the sensors
"""

from typing import Literal

import numpy as np
from jaxtyping import Float
from scipy.interpolate import RBFInterpolator

from myograph.ensemble.predictor import Predictor
from myograph.errors import InputError
from myograph.learning.samples import check_samples

AFFINE_SENSORS = 4
"""Points that an affine map of space needs."""


class DoNothing:
    """Every point stays where it was: the scale of every other error."""

    name = "do_nothing"

    def predict(
        self, sensors: Float[np.ndarray, "batch sensors 6"], queries: Float[np.ndarray, "batch queries 3"]
    ) -> Float[np.ndarray, "batch queries 3"]:
        """Return the queries as they are [mm]."""
        check_samples(sensors, queries)
        return queries.copy()


class Affine:
    """The affine map that suits the sensors best."""

    name = "affine"

    def predict(
        self, sensors: Float[np.ndarray, "batch sensors 6"], queries: Float[np.ndarray, "batch queries 3"]
    ) -> Float[np.ndarray, "batch queries 3"]:
        """Map the queries [mm]; raises InputError where the sensors lie in one plane."""
        check_samples(sensors, queries, at_least=AFFINE_SENSORS)
        _check_spatial(sensors)
        inverse = np.linalg.pinv(_with_one(sensors[..., :3]))
        return _with_one(queries) @ (inverse @ sensors[..., 3:])


class ThinPlateSpline:
    """The smoothest map that takes every sensor to its place."""

    name = "thin_plate_spline"

    def predict(
        self, sensors: Float[np.ndarray, "batch sensors 6"], queries: Float[np.ndarray, "batch queries 3"]
    ) -> Float[np.ndarray, "batch queries 3"]:
        """Map the queries [mm]; raises InputError where the sensors lie in one plane."""
        check_samples(sensors, queries, at_least=AFFINE_SENSORS)
        _check_spatial(sensors)
        answers = [
            RBFInterpolator(sample[:, :3], sample[:, 3:], kernel="thin_plate_spline")(asked)
            for sample, asked in zip(sensors, queries, strict=True)
        ]
        return np.array(answers).reshape(queries.shape)


BASELINES: dict[Literal["do_nothing", "affine", "thin_plate_spline"], Predictor] = {
    "do_nothing": DoNothing(),
    "affine": Affine(),
    "thin_plate_spline": ThinPlateSpline(),
}


def _with_one(points: Float[np.ndarray, "batch points 3"]) -> Float[np.ndarray, "batch points 4"]:
    return np.concatenate([points, np.ones_like(points[..., :1])], axis=-1)


def _check_spatial(sensors: Float[np.ndarray, "batch sensors 6"]) -> None:
    """Raise InputError where the sensors of a sample span no volume: an affine map needs four that do."""
    centred = sensors[..., :3] - sensors[..., :3].mean(axis=1, keepdims=True)
    flat = np.flatnonzero(np.linalg.matrix_rank(centred) < AFFINE_SENSORS - 1)
    if len(flat):
        raise InputError(f"sample {flat[0]}: expected sensors that span a volume, got all in one plane; choose others")
