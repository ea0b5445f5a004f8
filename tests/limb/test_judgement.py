"""Two arms beside each other."""

import numpy as np
import pytest

from myograph.case import MUSCLES, Case, Solution
from myograph.errors import InputError
from myograph.limb.judgement import judge, random_cases


class _Shifted:
    """An arm whose nodes and angle are off by a number."""

    def __init__(self, shift: float) -> None:
        self.shift = shift

    def __call__(self, case: Case) -> Solution:
        if case.activations[0] == 1.0:
            raise InputError("no rest")
        nodes = np.zeros((4, 3))
        nodes[0, 0] = self.shift
        fields = {name: {"position": nodes + k * self.shift} for k, name in enumerate(MUSCLES)}
        return Solution(case, 1.0 + self.shift, dict.fromkeys(MUSCLES, 0.0), fields, "direct")


def test_errors_are_distances_of_nodes_and_the_difference_of_angles():
    (row,) = judge(_Shifted(0.5), _Shifted(0.0), random_cases(1))
    assert row.angle_error == pytest.approx(0.5)
    assert row.node_errors["brachioradialis"] == pytest.approx((0.5 / 4, 0.5))
    assert row.node_errors["brachialis"][1] == pytest.approx(np.sqrt(1.0 + 2 * 0.25))
    assert row.failure == ""


def test_a_case_without_answer_is_a_row_with_its_reason():
    rows = list(judge(_Shifted(0.5), _Shifted(0.0), (Case((1.0, 0, 0, 0, 0)), Case((0.5,) * 5))))
    assert [row.failure for row in rows] == ["no rest", ""]
    assert np.isnan(rows[0].angle_error)


def test_random_cases_follow_their_seed():
    assert random_cases(3, 1) == random_cases(3, 1) != random_cases(3, 2)
    assert random_cases(5, 1)[:3] == random_cases(3, 1)
    with pytest.raises(InputError, match="expected at least 1, got 0"):
        random_cases(0)
