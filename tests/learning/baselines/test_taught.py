"""What activation-driven methods are told: the target cases of the training pairs, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.protocols import PairSet, Split, split_pairs
from myograph.errors import InputError
from myograph.learning.baselines import GappyPod
from myograph.learning.baselines.deeponet import DeepONet
from myograph.learning.baselines.deeponet_module import DeepONetConfig
from myograph.learning.baselines.feed_forward import FeedForward
from myograph.learning.baselines.gp_module import PodGpConfig
from myograph.learning.baselines.pod_gp import PodGp
from myograph.learning.baselines.taught import answered_fields, taught
from myograph.learning.training import TrainingConfig
from tests.learning.baselines.stand_in import bodies_cases, stand_in_sampler

FEW = TrainingConfig(steps=3, batch=8, queries=16, validation=0.1, validate_every=2)
LEARNERS = [
    GappyPod(),
    FeedForward(training=FEW),
    PodGp(PodGpConfig(modes=3, most_cases=20, kernel_cases=10)),
    DeepONet(DeepONetConfig(drive="both"), FEW),
]


def altered(cases, which):
    """The same cases, but for the fields of some."""
    fields = {name: cases.values(name, np.arange(len(cases))).copy() for name in cases.fields}
    for values in fields.values():
        values[which] *= 1.1
    return cases_in_memory(cases.muscle, cases.body, cases.activation, cases.design, fields)


@pytest.mark.parametrize("learner", LEARNERS, ids=lambda learner: learner.name)
@pytest.mark.parametrize("protocol", ["strict", "off_grid"])
def test_altered_test_cases_change_nothing_that_is_learned(learner, protocol, body_cases):
    split = split_pairs(body_cases, protocol)
    unseen = np.setdiff1d(np.arange(len(body_cases)), split.train.target)
    assert np.isin(split.test, unseen).all()
    sampler = stand_in_sampler("material", cases=body_cases)
    question = sampler.batch(split.test[:2]).question
    answers = [
        learner.fit(stand_in_sampler("material", cases=cases), split).predict(question).values["position"]
        for cases in (body_cases, altered(body_cases, unseen))
    ]
    np.testing.assert_array_equal(*answers)


def test_altered_training_cases_do_change_it(body_cases):
    split = split_pairs(body_cases, "strict")
    sampler = stand_in_sampler(cases=body_cases)
    question = sampler.batch(split.test[:2]).question
    changed = stand_in_sampler(cases=altered(body_cases, split.train.target[:9]))
    answers = [LEARNERS[2].fit(one, split).predict(question).values["position"] for one in (sampler, changed)]
    assert np.abs(answers[0] - answers[1]).max() > 1e-3


def test_every_target_case_is_told_once_with_a_component_for_scalars(body_sampler, off_grid):
    told = taught(body_sampler, off_grid)
    chosen = np.unique(off_grid.train.target)
    np.testing.assert_array_equal(told.activation, body_sampler.cases.activation[chosen])
    assert {name: values.shape[1:] for name, values in told.fields.items()} == {
        "position": (60, 3),
        "von_mises": (60, 1),
    }


def test_von_mises_stress_is_not_learned_where_cauchy_stress_is():
    assert answered_fields(("position", "von_mises", "cauchy_stress")) == ("position", "cauchy_stress")
    assert answered_fields(("position", "von_mises")) == ("position", "von_mises")


def test_fewer_than_five_training_cases_are_an_input_error(body_sampler):
    few = np.arange(4)
    with pytest.raises(InputError, match="at least 5 training cases, got 4"):
        taught(body_sampler, Split("strict", PairSet(few, few), np.array([[5, 6]])))


def test_training_cases_of_different_loads_are_an_input_error(off_grid):
    cases = bodies_cases()
    loaded = replace(cases, hand_load=np.linspace(0, 10, len(cases)))
    with pytest.raises(InputError, match=r"the same in all training cases, got 80 from 0\.0 N to"):
        taught(stand_in_sampler(cases=loaded), off_grid)
