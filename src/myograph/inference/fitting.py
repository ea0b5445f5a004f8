"""Whether some cases are of the body that a model knows."""

import numpy as np

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError
from myograph.inference.loaded import LoadedModel

SAME_PLACE = 1e-3
"""Distance over the body's length below which two nodes are the same: bodies are stored in single precision."""


def check_same_body(model: LoadedModel, cases: MuscleCases) -> None:
    """Raise InputError for another muscle, another arm, or another mesh than the model's."""
    told = model.told
    if cases.muscle != told.muscle:
        raise InputError(f"{told.name}: expected cases of {told.muscle}, got those of {cases.muscle}")
    arms = told.origin.arm_checksum, cases.attributes.get("arm_checksum", "")
    if all(arms) and arms[0] != arms[1]:
        raise InputError(
            f"{told.name}: expected cases of the arm {arms[0]}, got those of {arms[1]}: train for this arm"
        )
    if cases.nodes != model.body.nodes:
        raise InputError(f"{told.name}: expected a body of {model.body.nodes} nodes, got {cases.nodes}: another mesh")
    reference = model.body.body.reference
    distance = np.linalg.norm(cases.body.reference - reference, axis=1).max()
    length = np.linalg.norm(np.ptp(reference, axis=0))
    if distance > SAME_PLACE * length:
        raise InputError(
            f"{told.name}: expected the body that it was trained on, got one whose nodes are up to {distance:.3g} mm "
            "elsewhere: train for this body"
        )
