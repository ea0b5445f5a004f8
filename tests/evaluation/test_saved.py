"""Which test pairs a saved model is judged on."""

import numpy as np

from myograph.ensemble.pairs.protocols import PairSet
from myograph.evaluation.saved import _some


def test_of_many_pairs_some_are_drawn_with_every_target_as_often():
    pairs = PairSet(np.arange(8), np.arange(20, 32)).all()
    drawn = _some(pairs, 36)
    assert np.unique(drawn[:, 1], return_counts=True)[1].tolist() == [3] * 12
    assert len(np.unique(drawn, axis=0)) == 36
    assert {tuple(pair) for pair in drawn.tolist()} <= {tuple(pair) for pair in pairs.tolist()}
    np.testing.assert_array_equal(drawn, _some(pairs, 36))


def test_few_pairs_are_all_taken():
    pairs = PairSet(np.arange(3), np.arange(3)).all()
    np.testing.assert_array_equal(_some(pairs, 9), pairs)
