"""Batches as trainables draw them, and pairs held out."""

import numpy as np
import pytest
import torch

from myograph.ensemble.pairs.protocols import PairSet
from myograph.errors import InputError
from myograph.learning.training import TrainingConfig
from myograph.learning.training.drawing import draw_batch, hold_out

CONFIG = TrainingConfig(batch=6, queries=20)


def test_a_batch_has_the_pairs_and_queries_asked_for(sampler, strict):
    batch = draw_batch(sampler, strict.train, CONFIG, np.random.default_rng(0))
    assert batch.truth["position"].shape == (6, 20, 3)
    assert len(np.unique(batch.question.query_nodes)) == 20


def test_more_queries_than_nodes_are_all_of_them(sampler, strict):
    many = CONFIG.model_copy(update={"queries": 10**4})
    batch = draw_batch(sampler, strict.train, many, np.random.default_rng(0))
    np.testing.assert_array_equal(np.sort(batch.question.query_nodes), sampler.queries)


def test_processes_share_the_pairs_of_one_batch(sampler, strict, monkeypatch):
    alone = draw_batch(sampler, strict.train, CONFIG, np.random.default_rng(0)).truth["position"]
    monkeypatch.setattr(torch.distributed, "is_initialized", lambda: True)
    monkeypatch.setattr(torch.distributed, "get_world_size", lambda: 2)
    for rank in (0, 1):
        monkeypatch.setattr(torch.distributed, "get_rank", lambda rank=rank: rank)
        share = draw_batch(sampler, strict.train, CONFIG, np.random.default_rng(0)).truth["position"]
        np.testing.assert_array_equal(share, alone[rank::2])


def test_held_out_targets_teach_in_neither_role(strict):
    taught, validated = hold_out(strict.train, 0.2)
    held = np.unique(validated.target)
    assert len(held) == 5
    assert not np.isin(taught.cases, held).any()
    assert np.isin(validated.initial, taught.initial).all()
    assert np.isin(validated.cases, strict.train.cases).all()


def test_the_seed_says_which_cases_are_held_out(strict):
    first, again, other = (hold_out(strict.train, 0.2, seed)[1].target for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_no_share_holds_out_nothing(strict):
    taught, validated = hold_out(strict.train, 0.0)
    np.testing.assert_array_equal(taught.cases, strict.train.cases)
    assert len(validated) == 0


@pytest.mark.parametrize("share", [0.1, 1.0], ids=["too few for any", "all of them"])
def test_too_few_cases_to_hold_some_out_are_a_mistake(share):
    few = PairSet(np.array([0, 1]), np.array([0, 1]))
    with pytest.raises(InputError, match="expected cases for both training and validation, got 2 cases"):
        hold_out(few, share)
