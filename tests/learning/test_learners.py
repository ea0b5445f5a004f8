"""Methods by name."""

import numpy as np
import pytest

from myograph.ensemble.pairs.predictor import Learner
from myograph.errors import InputError
from myograph.learning.baselines.deeponet import DeepONet
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.learners import LEARNERS, Asked, Untaught, make_learner
from myograph.learning.trust.calibrated import CalibratedLearner


@pytest.mark.parametrize("method", LEARNERS)
def test_every_name_makes_a_learner(method):
    assert isinstance(make_learner(Asked(method)), Learner)


def test_a_method_that_learns_nothing_answers_as_it_is(sampler, strict):
    batch = sampler.batch(strict.test[:2])
    answered = make_learner(Asked("do_nothing")).fit(sampler, strict).predict(batch.question).values["position"]
    np.testing.assert_array_equal(answered, batch.question.query_initial["position"])


def test_only_methods_that_learn_are_calibrated():
    assert isinstance(make_learner(Asked("gappy_pod", calibration=0.2)), CalibratedLearner)
    assert isinstance(make_learner(Asked("affine", calibration=0.2)), Untaught)


def test_settings_go_over_the_method_s_own():
    asked = Asked("deeponet", {"terms": 7}, {"steps": 3})
    learner, usual = make_learner(asked), DeepONet()
    assert (learner.network.terms, learner.training.steps) == (7, 3)
    assert learner.training.batch == usual.training.batch
    assert learner.network.trunk == usual.network.trunk


def test_the_thesis_s_network_is_its_own_method():
    learner = make_learner(Asked("gen_thesis", {"nodes_per_axis": 7}))
    assert learner.name == "gen_thesis_343"
    assert learner.network.outputs == (("coordinates",),)


def test_the_best_graph_network_has_a_name():
    learner = make_learner(Asked("gen_improved"))
    assert learner.name == "gen_improved_8"
    assert learner.network == NetworkConfig.improved()


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (Asked("deeponet", {"branch": [-1]}), "options of deeponet: branch.0: .*greater than or equal to 1, got -1"),
        (Asked("gap_pod"), "unknown method 'gap_pod': expected one of .*did you mean 'gappy_pod'"),
        (Asked("xyz"), "unknown method 'xyz': expected one of [^;]*$"),
        (Asked("gen", {"latnt": 3}), "options of gen: unknown key 'latnt'; did you mean 'latent'"),
        (Asked("gen", {}, {"batch": 0}), "training: batch: .*got 0"),
        (Asked("gappy_pod", {"modes": 3}), "'gappy_pod' has no options, got modes"),
        (Asked("neural_modes", {}, {"steps": 3}), r"'neural_modes' is not trained in steps: leave \[training\] out"),
    ],
)
def test_a_wrong_setting_is_named(asked, words):
    with pytest.raises(InputError, match=words):
        make_learner(asked)
