"""Samples of pairs: what sensors tell, what is asked, what is right."""

import numpy as np
import pytest
import xarray as xr

from myograph.ensemble.pairs import dataset_checksum, sample_pairs
from myograph.errors import InputError

CASES, NODES = 4, 20
PAIRS = np.array([[0, 3], [2, 2], [3, 1]])


@pytest.fixture
def dataset():
    draw = np.random.default_rng(0)
    return xr.Dataset(
        {
            "activation": (("cases", "muscles"), draw.uniform(size=(CASES, 5))),
            "design": ("cases", np.array(["factorial"] * CASES)),
            "position": (("cases", "nodes", "axes"), draw.normal(size=(CASES, NODES, 3))),
            "von_mises": (("cases", "nodes"), draw.uniform(size=(CASES, NODES))),
        },
        attrs={"muscle": "biceps"},
    )


def test_sensors_tell_where_they_are_in_the_initial_and_in_the_target_case(dataset):
    sampler = sample_pairs(dataset)
    told = sampler.batch(PAIRS).sensors
    assert told.shape == (3, 9, 6)
    for sample, (initial, target) in zip(told, PAIRS, strict=True):
        np.testing.assert_array_equal(sample[:, :3], dataset["position"].values[initial, sampler.sensors])
        np.testing.assert_array_equal(sample[:, 3:], dataset["position"].values[target, sampler.sensors])


def test_queries_are_asked_in_the_initial_case_and_answered_in_the_target_case(dataset):
    sampler = sample_pairs(dataset)
    batch = sampler.batch(PAIRS)
    assert batch.queries.shape == batch.targets.shape == (3, NODES - 9, 3)
    for asked, right, (initial, target) in zip(batch.queries, batch.targets, PAIRS, strict=True):
        np.testing.assert_array_equal(asked, dataset["position"].values[initial, sampler.queries])
        np.testing.assert_array_equal(right, dataset["position"].values[target, sampler.queries])


def test_only_the_named_queries_are_asked(dataset):
    sampler = sample_pairs(dataset)
    batch = sampler.batch(PAIRS, sampler.queries[[4, 1]])
    np.testing.assert_array_equal(batch.queries, sampler.batch(PAIRS).queries[:, [4, 1]])


def test_every_node_is_a_sensor_or_a_query_and_none_is_both(dataset):
    sampler = sample_pairs(dataset, sensors=5)
    assert len(sampler.sensors) == 5
    assert sorted([*sampler.sensors, *sampler.queries]) == list(range(NODES))


def test_the_seed_decides_which_nodes_are_sensors(dataset):
    first, again, other = (sample_pairs(dataset, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.sensors, again.sensors)
    assert set(first.sensors) != set(other.sensors)


def test_positions_are_read_where_they_lie(dataset):
    assert np.shares_memory(sample_pairs(dataset).positions, dataset["position"].values)


@pytest.mark.parametrize("sensors", [0, NODES])
def test_a_number_of_sensors_that_leaves_nothing_to_know_or_to_ask_is_an_input_error(dataset, sensors):
    with pytest.raises(InputError, match=f"between 1 and 19 sensors on 20 nodes, got {sensors}"):
        sample_pairs(dataset, sensors=sensors)


def test_a_position_that_is_no_number_is_an_input_error(dataset):
    dataset["position"][2, 7, 1] = np.nan
    with pytest.raises(InputError, match="NaN"):
        sample_pairs(dataset)


@pytest.mark.parametrize("name", ["activation", "position"])
def test_the_checksum_sees_any_change_of_what_learning_reads(dataset, name):
    before = dataset_checksum(dataset)
    assert sample_pairs(dataset).source.checksum == before
    dataset[name].values.flat[3] += 1e-9
    assert dataset_checksum(dataset) != before


def test_the_checksum_does_not_see_what_learning_does_not_read(dataset):
    before = dataset_checksum(dataset)
    dataset["von_mises"].values[:] = 0
    assert dataset_checksum(dataset) == before
