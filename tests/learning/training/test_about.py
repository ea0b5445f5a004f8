"""A training goes on with the same questions about the same cases, and with no others."""

from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.baselines.deeponet import DeepONet
from myograph.learning.baselines.deeponet_module import DeepONetConfig
from myograph.learning.baselines.feed_forward import FeedForward
from myograph.learning.gen.learner import GenLearner
from tests.learning.training.conftest import FEW

SMALL = {"terms": 4, "branch": (8,), "trunk": (8,)}


def learner(kind, folder):
    if kind == "gen":
        return GenLearner(training=FEW, folder=folder)
    if kind == "feed_forward":
        return FeedForward(training=FEW, folder=folder)
    return DeepONet(DeepONetConfig(drive="sensors", **SMALL), FEW, folder)


def other_pairs(sampler, split):
    """The same protocol with other cases held out."""
    return sampler, replace(split, train=PairSet(split.train.initial, split.train.target[1:]))


def other_initial(sampler, split):
    return sampler, replace(split, train=PairSet(split.train.initial[1:], split.train.target))


def other_convention(sampler, split):
    return PairSampler(sampler.cases, sampler.sensors, "material"), split


def other_sensors(sampler, split):
    return PairSampler(sampler.cases, np.sort(np.append(sampler.sensors[1:], sampler.queries[0]))), split


@pytest.mark.parametrize("kind", ["gen", "feed_forward", "deeponet"])
@pytest.mark.parametrize("change", [other_pairs, other_initial, other_convention, other_sensors])
def test_other_questions_are_another_training(sampler, strict, tmp_path, kind, change):
    learner(kind, tmp_path / "run").fit(sampler, strict)
    with pytest.raises(InputError, match="holds another training"):
        learner(kind, tmp_path / "run").fit(*change(sampler, strict))
    learner(kind, tmp_path / "run").fit(sampler, strict)
