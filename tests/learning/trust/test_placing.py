"""Good sensors are those that tell what others do not."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.trust.placing import pivots, qr_sensors


def test_the_only_nodes_that_move_are_the_first_sensors():
    rows = np.zeros((6, 3, 4))
    rows[4, 0] = [3, 0, 0, 0]
    rows[1, 2] = [0, 1, 0, 0]
    assert pivots(rows, 2) == [4, 1]


def test_a_node_that_tells_the_same_again_is_not_taken():
    rows = np.zeros((3, 3, 2))
    rows[0, 0], rows[1, 0], rows[2, 1] = [5, 0], [4, 0], [0, 1]
    assert pivots(rows, 2) == [0, 2]


def test_a_node_is_taken_once_even_where_nothing_is_left_to_tell():
    assert sorted(pivots(np.zeros((4, 3, 2)), 3)) == [0, 1, 2]


def test_sensors_are_different_nodes_in_order(block_cases):
    found = qr_sensors(block_cases, block_cases.named("support"), 5)
    assert len(found) == 5
    assert (np.diff(found) > 0).all()


@pytest.mark.parametrize("count", [0, 27])
def test_as_many_sensors_as_nodes_or_none_are_refused(block_cases, count):
    with pytest.raises(InputError, match="between 1 and 26 sensors"):
        qr_sensors(block_cases, np.arange(5), count)
