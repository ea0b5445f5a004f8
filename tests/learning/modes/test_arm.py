"""All muscles of an arm as one model."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.modes.arm import fit_arm
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from tests.learning.modes.conftest import QUICK

LEARNER = ModesLearner(ModesConfig(**QUICK))


@pytest.fixture(scope="module")
def other(sampler, block_cases):
    """The same body, told to be the triceps."""
    return replace(sampler, cases=replace(block_cases, muscle="triceps"))


def test_muscles_share_one_angle_and_answer_from_their_own_activation(sampler, other, split):
    models = fit_arm(LEARNER, {"biceps": sampler, "triceps": other}, split)
    assert models["biceps"].module.angle is models["triceps"].module.angle
    assert [models[name].module.built.own for name in ("biceps", "triceps")] == [2, 4]
    batch = sampler.batch(split.test[:60])
    missed = models["biceps"].predict(batch.question).values["position"] - batch.truth["position"]
    assert np.linalg.norm(missed, axis=-1).mean() < 0.05


def test_muscles_of_different_cases_are_refused(sampler, other, split):
    shifted = replace(other, cases=replace(other.cases, hand_load=other.cases.hand_load + 1))
    with pytest.raises(InputError, match="got others of 'triceps'"):
        fit_arm(LEARNER, {"biceps": sampler, "triceps": shifted}, split)


def test_a_coordinate_of_one_muscle_cannot_be_shared(sampler, split):
    with pytest.raises(InputError, match="the coordinate 'angle', got 'mode'"):
        fit_arm(ModesLearner(ModesConfig(coordinate="mode")), {"biceps": sampler}, split)


def test_an_arm_without_muscles_is_refused(split):
    with pytest.raises(InputError, match="at least one muscle"):
        fit_arm(LEARNER, {}, split)
