"""Training with mixed precision: places and targets keep single precision."""

import numpy as np
import pytest
import torch

from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.learner import GenLearner
from myograph.learning.gen.precision import single
from tests.learning.gen.conftest import FEW

MIXED = FEW.model_copy(update={"precision": "bf16-mixed"})


@pytest.fixture
def trained(sampler, strict):
    """Function: the improved network after four steps, some of its settings changed."""

    def make(training=FEW, **settings):
        config = NetworkConfig.improved().model_copy(update=settings)
        return GenLearner(config, training).train(sampler, strict)

    return make


@pytest.mark.parametrize("representer", ["dense", "nearest", "barycentric"])
def test_shares_of_points_are_those_of_single_precision(trained, representer):
    network = trained(representer=representer).module.network
    points = torch.rand(2, 30, 3, generator=torch.Generator().manual_seed(0)) * 0.2
    wanted = network.shares(points).weights
    with torch.autocast("cpu", torch.bfloat16):
        found = network.shares(points).weights
    assert torch.equal(found, wanted)


def test_what_is_learned_is_that_of_single_precision(trained, sampler, strict):
    module, batch = trained().module, sampler.batch(strict.train.all()[:8])
    question, truth = batch.question, torch.tensor(batch.truth["position"])
    parts = {
        "sensor_position_initial": torch.tensor(question.sensor_initial["position"]),
        "sensor_position_target": torch.tensor(question.sensor_target["position"]),
        "query_position_initial": torch.tensor(question.query_initial["position"]),
    }
    wanted = module.wanted(parts, {"position": truth})
    with torch.autocast("cpu", torch.bfloat16):
        found = module.wanted(parts, {"position": truth})
    assert torch.equal(found, wanted)


def test_the_improved_network_learns_the_same_in_mixed_precision(trained):
    exact, mixed = trained(), trained(MIXED)
    np.testing.assert_allclose(mixed.history.rmse, exact.history.rmse, rtol=0.02)
    assert not np.array_equal(mixed.history.rmse, exact.history.rmse)


def test_autocast_is_left_alone_where_it_is_off():
    with single(torch.zeros(1)):
        assert not torch.is_autocast_enabled("cpu")
    with torch.autocast("cpu", torch.bfloat16):
        with single(torch.zeros(1)):
            assert not torch.is_autocast_enabled("cpu")
        assert torch.is_autocast_enabled("cpu")
