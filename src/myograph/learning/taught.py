"""What a saved model says about the cases that taught it."""

from importlib.metadata import PackageNotFoundError, version

import numpy as np

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import Split
from myograph.inference.body_file import ModelBody
from myograph.inference.model_file import TrainedRange

CASES_AT_ONCE = 64
PACKAGES = ("myograph", "numpy", "torch", "onnx", "onnxscript", "onnxruntime")


def model_body(cases: MuscleCases, split: Split, rest_fields: tuple[str, ...]) -> ModelBody:
    """The body, where its nodes were in the training cases, and its state in the one with the least activation."""
    low, high = np.full((cases.nodes, 3), np.inf), np.full((cases.nodes, 3), -np.inf)
    taught = split.train.cases
    for first in range(0, len(taught), CASES_AT_ONCE):
        positions = cases.values("position", taught[first : first + CASES_AT_ONCE])
        low, high = np.minimum(low, positions.min(axis=0)), np.maximum(high, positions.max(axis=0))
    effort = np.linalg.norm(cases.activation[taught], axis=1) + np.abs(cases.hand_load[taught])
    at_rest = taught[[int(effort.argmin())]]
    return ModelBody(cases.body, low, high, {name: cases.values(name, at_rest)[0] for name in rest_fields})


def trained_range(cases: MuscleCases, split: Split, residual_mm: float | None) -> TrainedRange:
    """What the training cases cover."""
    activation, load = cases.activation[split.train.cases], cases.hand_load[split.train.cases]
    return TrainedRange(
        activation_low=tuple(activation.min(axis=0).tolist()),
        activation_high=tuple(activation.max(axis=0).tolist()),
        hand_load=(float(load.min()), float(load.max())),
        residual_mm=residual_mm,
    )


def installed() -> dict[str, str]:
    """The versions of what made the model."""
    found = {}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return found
