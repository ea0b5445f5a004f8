"""A trained network as a predictor; what every predictor refuses."""

import pickle

import numpy as np
import pytest

from myograph.ensemble.pairs import Batch
from myograph.errors import InputError
from myograph.learning.baselines import BASELINES
from myograph.learning.config import NetworkConfig, TrainingConfig
from myograph.learning.training import train_gen


@pytest.fixture
def batch(sampler, strict):
    fresh = sampler.batch(strict.test)
    return Batch(fresh.sensors.copy(), fresh.queries.copy(), fresh.targets.copy())


@pytest.fixture(params=["gen_8", *BASELINES])
def predictor(request):
    return BASELINES[request.param] if request.param in BASELINES else request.getfixturevalue(request.param)


def test_it_beats_doing_nothing_threefold_on_activations_that_training_never_saw(gen_8, batch, mean_error):
    assert 3 * mean_error(gen_8, batch) < mean_error(BASELINES["do_nothing"], batch)


def test_it_answers_in_millimetres_one_position_per_query(gen_8, batch):
    answers = gen_8.predict(batch.sensors, batch.queries)
    assert answers.shape == batch.queries.shape
    assert np.linalg.norm(answers - batch.targets, axis=-1).max() < 50


def test_many_samples_are_answered_as_each_alone(gen_8, batch):
    together = gen_8.predict(batch.sensors, batch.queries)
    alone = gen_8.predict(batch.sensors[40:41], batch.queries[40:41])
    np.testing.assert_allclose(together[40:41], alone, atol=1e-3)


def test_renumbering_the_sensors_changes_no_answer(gen_8, batch):
    order = np.random.default_rng(0).permutation(9)
    renumbered = gen_8.predict(batch.sensors[:, order], batch.queries)
    np.testing.assert_allclose(renumbered, gen_8.predict(batch.sensors, batch.queries), atol=1e-3)


def test_the_mean_takes_any_number_of_sensors_and_the_sum_only_that_of_training(gen_8, sampler, strict, batch):
    assert gen_8.predict(batch.sensors[:, :7], batch.queries).shape == batch.queries.shape
    total = train_gen(sampler, strict, NetworkConfig(aggregation="sum"), TrainingConfig(steps=1))
    with pytest.raises(InputError, match="expected 9 sensors, as in training, got 7"):
        total.predict(batch.sensors[:, :7], batch.queries)


def test_it_survives_the_way_from_one_process_to_another(gen_8, batch):
    arrived = pickle.loads(pickle.dumps(gen_8))
    answers = (gen.predict(batch.sensors, batch.queries) for gen in (arrived, gen_8))
    np.testing.assert_array_equal(*answers)


def test_it_is_named_after_its_graph(gen_8):
    assert gen_8.name == "gen_8"


def test_a_sensor_or_a_query_that_is_no_number_is_an_input_error(predictor, batch):
    for spoilt in (batch.sensors, batch.queries):
        spoilt[3, 2, 1] = np.nan
        with pytest.raises(InputError, match="NaN"):
            predictor.predict(batch.sensors, batch.queries)
        spoilt[3, 2, 1] = 0.0


def test_two_sensors_at_one_place_are_an_input_error(predictor, batch):
    batch.sensors[5, 3] = batch.sensors[5, 4]
    with pytest.raises(InputError, match="sample 5: expected 9 sensors at different places, got 8"):
        predictor.predict(batch.sensors, batch.queries)


def test_no_sensor_at_all_is_an_input_error(predictor, batch):
    with pytest.raises(InputError, match=r"at least \d sensors, got 0"):
        predictor.predict(batch.sensors[:, :0], batch.queries)
