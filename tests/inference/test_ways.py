"""Each way of telling a model has half widths of its own."""

import numpy as np
import pytest

from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.signature import Signature
from myograph.inference.ways import WAYS, WHOLE, scales_of, told_only, ways
from tests.inference.stand_in import SENSORS, stand_in_cases

BOTH = Signature(
    inputs=("activation", "sensor_position_target", "sensor_nodes", "query_nodes"),
    outputs=("position",),
    convention="material",
    sensors=SENSORS,
    any_sensors=True,
    least_sensors=0,
    unknown_activation=True,
)
WHOLLY = {"position": 3.0, "von_mises": 2.0}
ALONE = {"activation": {"position": 5.0}, "sensors": {"position": 7.0, "von_mises": 1.0}}


@pytest.fixture(scope="module")
def question():
    sampler = PairSampler(stand_in_cases(), np.array(SENSORS), "material")
    return sampler.batch(np.array([[0, 5], [9, 35], [17, 1]])).question


@pytest.mark.parametrize(
    ("way", "position", "von_mises"), [(WHOLE, 3.0, 2.0), ("activation", 5.0, 2.0), ("sensors", 7.0, 1.0)]
)
def test_a_question_has_the_scales_of_the_way_it_is_told(question, way, position, von_mises):
    found = scales_of(told_only(question, way), BOTH, WHOLLY, ALONE)
    assert found["position"].tolist() == [position] * 3
    assert found["von_mises"].tolist() == [von_mises] * 3


def test_pairs_of_one_question_may_be_told_differently(question):
    question.activation.setflags(write=True)
    question.activation[1] = np.nan
    assert scales_of(question, BOTH, WHOLLY, ALONE)["position"].tolist() == [3.0, 7.0, 3.0]


def test_without_scales_of_single_ways_one_serves_all(question):
    for way in (WHOLE, *WAYS):
        assert scales_of(told_only(question, way), BOTH, WHOLLY, {})["position"].tolist() == [3.0] * 3


def test_only_a_model_that_reads_either_has_more_than_one_way():
    assert ways(BOTH) == WAYS
    for lacking in ({"unknown_activation": False}, {"least_sensors": 1}, {"inputs": ("activation", "query_nodes")}):
        assert ways(BOTH.model_copy(update=lacking)) == ()


def test_what_is_not_told_is_hidden(question):
    assert len(told_only(question, "activation").sensor_nodes) == 0
    assert np.isnan(told_only(question, "sensors").activation).all()
    assert told_only(question, WHOLE) is question
