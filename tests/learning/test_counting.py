"""Multiply-adds against a count by hand."""

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.learning.baselines.feed_forward import FeedForward
from myograph.learning.bent_rod import bent_rod
from myograph.learning.counting import multiply_adds
from myograph.learning.training import TrainingConfig


def test_a_feed_forward_network_multiplies_as_often_as_its_layers_have_weights():
    cases = bent_rod(sections=6, across=2)
    sampler, split = PairSampler(cases, random_sensors(cases.nodes, 3)), split_pairs(cases, "strict")
    predictor = FeedForward(training=TrainingConfig(steps=1, batch=2)).fit(sampler, split)
    weights = sum(parameter.numel() for parameter in predictor.module.parameters() if parameter.dim() == 2)
    for pairs in (1, 3):
        assert multiply_adds(predictor, sampler.batch(split.test[:pairs]).question) == weights
