"""One model for all muscles: each has its own modes, all share the networks from activations to the elbow's angle.

The angle is that of the arm, whichever muscle is looked at: it is learned once, and answers of all muscles belong to
the same arm.
"""

from collections.abc import Mapping

import numpy as np

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.modes.fitting import fit_angle
from myograph.learning.modes.learner import ModesLearner, predictor
from myograph.learning.torch_predictor import TorchPredictor


def fit_arm(
    learner: ModesLearner, samplers: Mapping[str, PairSampler], split: Split, progress: Progress | None = None
) -> dict[str, TorchPredictor]:
    """A predictor for each muscle, by the samplers' names.

    Raises InputError for muscles of different cases, for another coordinate than the angle, and as the learner does.
    """
    if learner.config.coordinate != "angle":
        raise InputError(
            f"one model for all muscles: expected the coordinate 'angle', got '{learner.config.coordinate}'"
        )
    found = {name: learner.modes(sampler, split) for name, sampler in samplers.items()}
    if not found:
        raise InputError("one model for all muscles: expected at least one muscle, got none")
    first, told = next(iter(found.values()))
    for name, (_, other) in found.items():
        if not all(np.array_equal(a, b) for a, b in zip(told, other, strict=True)):
            raise InputError(f"one model for all muscles: expected the same cases of all, got others of '{name}'")
    fit_angle(first, *told, progress)
    for module, _ in found.values():
        module.angle, module.angle_misfit = first.angle, first.angle_misfit
    return {name: predictor(learner.name, module, samplers[name]) for name, (module, _) in found.items()}
