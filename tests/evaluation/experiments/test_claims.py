"""What the thesis concludes, judged by rows."""

import json
from pathlib import Path

import pytest

from myograph.evaluation.experiments.claims import CLAIMS, FAILS, HOLDS, OPEN, judged

DOCS = Path(__file__).parents[3] / "docs"


def rows(large, small, spread=None):
    """Errors of the two meshes of section 6.2.1."""
    told = {} if spread is None else {"mean_mm_std": spread}
    return [
        {"name": "gen_thesis_343", "protocol": "strict", "mean_mm": 99.0},
        {"name": "gen_thesis_343", "protocol": "thesis", "mean_mm": large, **told},
        {"name": "gen_thesis_8", "protocol": "thesis", "mean_mm": small, **told},
    ]


@pytest.mark.parametrize(
    ("large", "no_need", "alike"),
    [(1.0, HOLDS, HOLDS), (1.09, HOLDS, HOLDS), (1.2, HOLDS, FAILS), (0.8, FAILS, FAILS)],
)
def test_a_ratio_within_its_bounds_holds(large, no_need, alike):
    first, second = judged({"6.2.1": rows(large, 1.0)})
    assert (first.verdict, second.verdict) == (no_need, alike)
    assert first.claim.said == "'There is no need for a huge mesh'"
    assert f"{large:.3g} mm (gen_thesis_343), 1 mm (gen_thesis_8): {large:.3g} times" in second.evidence
    assert second.evidence.endswith("holds for 0.909 to 1.1 times")


def test_a_spread_over_a_bound_decides_nothing():
    assert [v.verdict for v in judged({"6.2.1": rows(1.2, 1.0, 0.01)})] == [HOLDS, FAILS]
    found = judged({"6.2.1": rows(1.2, 1.0, 0.1)})
    assert [v.verdict for v in found] == [HOLDS, OPEN]
    assert "1.2 ± 0.156 times" in found[1].evidence


def test_an_interval_that_swallows_both_bounds_decides_nothing():
    assert [v.verdict for v in judged({"6.2.1": rows(1.0, 1.0, 0.5)})] == [OPEN, OPEN]


def test_rows_that_were_not_made_or_not_measured_judge_nothing():
    assert judged({}) == []
    assert judged({"6.2.1": rows(1.0, 1.0)[:2]}) == []
    reason = [{"name": "gen_thesis_343", "left_out": "no torch"}, *rows(1.0, 1.0)[2:]]
    assert judged({"6.2.1": reason}) == []
    assert judged({"6.2.1": rows(1.0, 0.0)}) == []


def test_the_documented_results_judge_every_claim():
    found = json.loads((DOCS / "results.json").read_text())["sections"]
    assert len(judged({name: one["rows"] for name, one in found.items()})) == len(CLAIMS)
