"""A question that no arm can be asked is refused when it is made."""

import math

import pytest

from myograph.case import Case
from myograph.errors import InputError


@pytest.mark.parametrize("angle", [math.nan, math.inf, -math.inf])
def test_an_elbow_angle_that_is_no_number_is_refused(angle):
    with pytest.raises(InputError, match="elbow angle: expected a finite number or none, got"):
        Case((0.0,) * 5, elbow_angle=angle)


@pytest.mark.parametrize("load", [math.nan, math.inf])
def test_a_load_that_is_no_number_is_refused(load):
    with pytest.raises(InputError, match="load at the hand: expected a number of newtons"):
        Case((0.0,) * 5, load)
