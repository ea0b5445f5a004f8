"""Calls are timed one by one, after one that does not count."""

import pytest

from myograph import timing


def test_the_first_call_does_not_count(monkeypatch):
    now, takes = [0.0], [0.3, 0.02, 0.04]
    monkeypatch.setattr(timing.time, "perf_counter", lambda: now[0])

    def work():
        now[0] += takes.pop(0)

    assert timing.call_times(work, 2).tolist() == pytest.approx([20, 40])
    assert takes == []
