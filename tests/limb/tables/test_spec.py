"""What can be asked of a table."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.limb.tables.spec import TableSpec, box, spec_from


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"level": 0}, "level: expected at least 1, got 0"),
        ({"held_out": -1}, "held_out: expected at least 0"),
        ({"seed": -1}, "seed: expected at least 0"),
        ({"most_states": 20}, "most_states: expected at least the 21 of the first grid"),
        ({"tolerance_mm": 0.0}, "tolerance_mm: expected a positive number, got 0"),
        ({"tolerance_nm": float("nan")}, "tolerance_nm: expected a positive number, got nan"),
    ],
)
def test_numbers_that_make_no_table_are_refused(changes, words):
    with pytest.raises(InputError, match=words):
        TableSpec(**changes)


def test_a_spec_comes_back_from_its_numbers():
    spec = TableSpec(level=3, tolerance_mm=0.2, most_states=90)
    assert spec_from(spec.as_dict()) == spec
    with pytest.raises(InputError, match="expected the names"):
        spec_from({"level": 3})


def test_a_regular_table_has_as_many_states_as_its_grid():
    spec = TableSpec.regular(3)
    assert spec.most == spec.most_states == len(spec.start()) == 49


def test_held_out_points_are_in_the_box_and_follow_their_seed():
    domain = box(built_in_arm())
    points = TableSpec(held_out=50).held_out_points(domain)
    other = TableSpec(held_out=50, seed=1).held_out_points(domain)
    assert np.array_equal(points, TableSpec(held_out=50).held_out_points(domain))
    assert not np.array_equal(points, other)
    assert np.degrees(domain.lower[0]) == pytest.approx(10.0)
    assert ((points > domain.lower) & (points < domain.upper)).all()
