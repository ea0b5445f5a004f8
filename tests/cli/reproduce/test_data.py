"""Cases that experiments need: fractions of the corners in which no muscle hides behind another."""

from itertools import product

import numpy as np
import pytest

from myograph.cli.reproduce.data import WORDS, fraction
from myograph.cli.reproduce.sizes import PRESETS, reproduction_size

CORNERS = np.array(list(product((0.0, 1.0), repeat=5)))


@pytest.mark.parametrize("count", list(WORDS))
def test_in_a_fraction_no_muscle_follows_another(count):
    chosen = CORNERS[fraction(CORNERS, count)]
    assert len(np.unique(chosen, axis=0)) == count
    assert np.allclose(chosen.mean(axis=0), 0.5)
    assert np.allclose(np.corrcoef(chosen.T), np.eye(5))


def test_every_preset_asks_for_a_fraction_that_is_known():
    assert {reproduction_size(preset).direct_factorial for preset in PRESETS} <= set(WORDS)
