"""What the shipped models promise from other sensors than those that calibrated them, and from noisy ones."""

import json
import sys
from pathlib import Path

import pytest

from myograph.inference.shipped import shipped_models

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def rows(monkeypatch, capsys):
    """Function: what the benchmark says of a shipped model."""
    monkeypatch.syspath_prepend(str(BENCHMARKS))
    monkeypatch.delitem(sys.modules, "intervals", raising=False)
    import intervals

    def measured(model):
        if model not in shipped_models():
            pytest.skip("this installation has no models of its own")
        intervals.main([model, "--json"])
        return json.loads(capsys.readouterr().out)

    return measured


def test_the_intervals_of_the_biceps_hold_for_any_sensors_and_any_noise_that_it_is_told(rows):
    """90 % over all rows; a row has 32 cases, whose nodes err together: three standard errors are 16 %."""
    found = rows("biceps")
    assert {row["noise_mm"] for row in found} == {0.0, 0.02, 0.1, 0.3, 0.5, 1.0}
    for both in (False, True):
        own = [row for row in found if row["with_activations"] == both]
        assert sum(row["held"] for row in own) / len(own) > 0.9
    for row in found:
        assert 0.74 < row["held"] <= 1
        assert row["inside"] > 0.9


def test_a_network_without_residual_promises_nothing_of_other_sensors(rows):
    for row in rows("gen-biceps"):
        known = row["sensors"] == "of the training"
        assert row["inside"] == (1.0 if known else 0.0)
        assert (row["held"] is not None) == (known and row["noise_mm"] == 0)
