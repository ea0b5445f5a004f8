"""The plan says what every section takes, before anything is made."""

import re
from pathlib import Path

from myograph.cli.reproduce import planning
from myograph.cli.reproduce.planning import PLANNED, TABLES, plan
from myograph.cli.reproduce.registry import EXPERIMENTS
from myograph.cli.reproduce.sizes import PRESETS

PAGE = Path(__file__).parents[3] / "docs" / "reproduce.md"


def test_every_preset_says_the_time_of_every_section():
    assert set(PLANNED) == set(PRESETS)
    for known in PLANNED.values():
        assert list(known) == [TABLES, *EXPERIMENTS]
        assert all(seconds > 0 for seconds in known.values())


def test_a_plan_is_shared_by_the_processors_and_leaves_tables_out_where_they_are_given(monkeypatch):
    monkeypatch.setattr(planning, "PLANNED", {"quick": {TABLES: 200.0, "6.2.1": 60.0, "edge": 20.0}})
    monkeypatch.setattr(planning.os, "cpu_count", lambda: 4)
    assert plan("quick", ["6.2.1"], simulated=True) == (
        "plan, on 4 processors from nothing: tables 50 s, 6.2.1 15 s; together 65 s"
    )
    assert plan("quick", ["6.2.1", "edge"], simulated=False).endswith(": 6.2.1 15 s, edge 5 s; together 20 s")


def test_the_quick_preset_is_planned_within_the_minutes_that_are_promised_on_two_processors():
    promised = re.search(r"`quick`.* under (\d+) minutes on two cores, from nothing", PAGE.read_text(encoding="utf-8"))
    assert promised
    assert sum(PLANNED["quick"].values()) / 2 < 60 * int(promised[1])
