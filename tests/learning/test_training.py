"""Training: it learns, it repeats itself, it stops when told, it says what it does."""

import sys

import numpy as np
import pytest

from myograph.ensemble.pairs import PairSampler
from myograph.ensemble.protocols import Split
from myograph.errors import MissingPackageError
from myograph.learning.baselines import BASELINES
from myograph.learning.config import NetworkConfig, TrainingConfig
from myograph.learning.training import RISE, one_cycle, train_gen

FEW = TrainingConfig(steps=5, batch=4, queries=16, triangulate_every=2)


def test_one_pair_is_learned_by_heart(sampler, mean_error):
    pair = np.array([[0, 31]])
    config = TrainingConfig(steps=300, batch=1, learning_rate=1e-2)
    learned = train_gen(sampler, Split("strict", pair, pair), NetworkConfig(), config)
    batch = sampler.batch(pair)
    assert 15 * mean_error(learned, batch) < mean_error(BASELINES["do_nothing"], batch)


def test_343_nodes_beat_doing_nothing_threefold_on_activations_that_training_never_saw(sampler, strict, mean_error):
    config = TrainingConfig(steps=150, batch=4, queries=64)
    batch = sampler.batch(strict.test)
    gen_343 = train_gen(sampler, strict, NetworkConfig(nodes_per_axis=7), config)
    assert 3 * mean_error(gen_343, batch) < mean_error(BASELINES["do_nothing"], batch)


def test_the_same_seed_gives_the_same_losses_and_another_seed_others(sampler, strict):
    first, again, other = (
        train_gen(sampler, strict, NetworkConfig(nodes_per_axis=3), FEW.model_copy(update={"seed": seed})).record
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first.rmse, again.rmse)
    np.testing.assert_array_equal(first.nodes_after, again.nodes_after)
    assert not np.array_equal(first.rmse, other.rmse)


def test_held_out_cases_leave_no_trace_in_what_is_learned(sampler, strict):
    altered = sampler.positions.copy()
    altered[np.unique(strict.test)] += 1000.0
    other = PairSampler(altered, sampler.sensors, sampler.queries, sampler.source)
    records = [train_gen(s, strict, NetworkConfig(), FEW).record for s in (sampler, other)]
    np.testing.assert_array_equal(records[0].rmse, records[1].rmse)


def test_graph_nodes_move_and_are_joined_anew_where_they_end(sampler, strict):
    far = FEW.model_copy(update={"node_learning_rate": 0.1, "triangulate_every": 100})
    gen = train_gen(sampler, strict, NetworkConfig(nodes_per_axis=3), far)
    assert gen.record.nodes_before.shape == gen.record.nodes_after.shape == (27, 3)
    assert (np.abs(gen.record.nodes_after - gen.record.nodes_before).max(axis=1) > 0).all()
    joined = gen.network.adjacency.to_dense()
    gen.network.triangulate()
    assert (gen.network.adjacency.to_dense() == joined).all()


def test_graph_nodes_are_recorded_in_millimetres_inside_the_box_of_the_muscle(sampler, strict):
    nodes = train_gen(sampler, strict, NetworkConfig(), FEW).record.nodes_before
    trained = sampler.positions[np.unique(strict.train)].reshape(-1, 3)
    assert (nodes >= trained.min(axis=0) - 1e-3).all()
    assert (nodes <= trained.max(axis=0) + 1e-3).all()
    assert np.ptp(nodes[:, 2]) > 200


def test_the_rate_rises_in_a_line_and_falls_to_nothing():
    assert one_cycle(RISE / 2) == pytest.approx(0.5)
    assert one_cycle(RISE) == pytest.approx(1)
    assert one_cycle((1 + RISE) / 2) == pytest.approx(0.5)
    assert one_cycle(1.0) == one_cycle(1.5) == pytest.approx(0)


def test_progress_is_told_after_every_step(sampler, strict):
    told = []
    gen = train_gen(sampler, strict, NetworkConfig(), FEW, progress=lambda *news: told.append(news))
    assert [news[:2] for news in told] == [(step, 5) for step in range(1, 6)]
    np.testing.assert_array_equal([news[2] for news in told], gen.record.rmse)


def test_the_recorded_error_is_that_of_the_answers_in_millimetres(sampler, strict):
    """One step at rate zero, on all queries of the only pair: what was recorded can be computed from outside."""
    pair = strict.train[1:2]
    config = TrainingConfig(steps=1, batch=1, queries=1000)
    gen = train_gen(sampler, Split("strict", pair, pair), NetworkConfig(), config)
    batch = sampler.batch(pair)
    squares = np.square(gen.predict(batch.sensors, batch.queries) - batch.targets).sum(axis=-1)
    assert gen.record.rmse[0] == pytest.approx(np.sqrt(squares.mean()), rel=1e-4)


def test_time_may_end_the_training_before_the_steps_do(sampler, strict):
    config = FEW.model_copy(update={"steps": 10**6, "seconds": 0.3})
    record = train_gen(sampler, strict, NetworkConfig(), config).record
    assert 1 <= len(record.rmse) < 10**4
    assert record.seconds < 10


def test_scalars_are_written_for_tensorboard(sampler, strict, tmp_path):
    accumulator = pytest.importorskip("tensorboard.backend.event_processing.event_accumulator")
    gen = train_gen(sampler, strict, NetworkConfig(), FEW, log_to=tmp_path / "log")
    events = accumulator.EventAccumulator(str(tmp_path / "log")).Reload()
    assert sorted(events.Tags()["scalars"]) == ["loss", "rmse_mm"]
    np.testing.assert_allclose([event.value for event in events.Scalars("rmse_mm")], gen.record.rmse, rtol=1e-5)


def test_scalars_without_tensorboard_are_a_missing_package(sampler, strict, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "torch.utils.tensorboard", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[train\]"):
        train_gen(sampler, strict, NetworkConfig(), FEW, log_to=tmp_path)
