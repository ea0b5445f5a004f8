"""What the thesis concludes, judged by rows."""

import json
from pathlib import Path

import pytest

from myograph.evaluation.experiments.claims import ALONE, CLAIMS, FAILS, HOLDS, OPEN, judged

DOCS = Path(__file__).parents[3] / "docs"


def row(name, *errors, protocol="thesis"):
    """Means over seeds; `errors` are those of each seed."""
    each = {"mean_mm_seeds": list(errors)} if len(errors) > 1 else {}
    return {"name": name, "protocol": protocol, "mean_mm": sum(errors) / len(errors), **each}


def row_on_skin(error):
    return {"skin_mean_mm": error, "skin_mean_mm_seeds": [error, error]}


def meshes(large, small):
    """Errors of the two meshes, the same in another protocol that is not asked."""
    return [row("343 nodes, right", 99.0, protocol="strict"), row("343 nodes, right", *large), row(*small)]


def judge(large, small=(1.0, 1.0, 1.0)):
    return judged({"meshes": meshes(large, ("8 nodes, right", *small))})


@pytest.mark.parametrize(
    ("large", "no_need", "alike"),
    [(1.0, HOLDS, HOLDS), (1.09, HOLDS, HOLDS), (1.2, HOLDS, FAILS), (0.8, FAILS, FAILS)],
)
def test_a_ratio_within_its_bounds_for_every_seed_holds(large, no_need, alike):
    first, second = judge((large, large, large))
    assert (first.verdict, second.verdict) == (no_need, alike)
    assert first.claim.said == "'There is no need for a huge mesh', both trained for as many steps"
    assert f"{large:.3g} mm (343 nodes, right), 1 mm (8 nodes, right), thesis: {large:.3g} times" in second.evidence
    assert second.evidence.endswith("holds for 0.909 to 1.1 times")


def test_seeds_on_both_sides_of_a_bound_decide_nothing():
    assert [v.verdict for v in judge((1.2, 1.15, 1.3))] == [HOLDS, FAILS]
    found = judge((1.2, 1.05, 1.3))
    assert [v.verdict for v in found] == [HOLDS, OPEN]
    assert "(1.05 to 1.3 over 3 seeds)" in found[1].evidence


def test_seeds_are_compared_with_their_like():
    """Errors scatter, but every seed finds the large mesh a fifth worse."""
    assert [v.verdict for v in judge((1.2, 2.4, 0.6), (1.0, 2.0, 0.5))] == [HOLDS, FAILS]


def test_one_seed_decides_nothing():
    assert [v.verdict for v in judge((3.0,), (1.0,))] == [ALONE, ALONE]
    assert [v.verdict for v in judge((3.0, 3.0), (1.0,))] == [ALONE, ALONE]


def test_the_benchmark_is_judged_where_neither_was_taught():
    rows = [
        {**row(name, 1.0, 1.0, protocol=p), **row_on_skin(skin)}
        for name, skin in (("gen_thesis_343", 3.0), ("feed_forward", 1.0))
        for p in ("thesis", "strict")
    ]
    assert judged({"6.2.1": rows[::2]}) == []
    (found,) = judged({"6.2.1": rows})
    assert (found.verdict, found.claim.protocol) == (FAILS, "strict")
    assert found.evidence.startswith("3 mm (gen_thesis_343), 1 mm (feed_forward), strict: 3 times")


def test_the_small_mesh_is_judged_by_its_own_training_too():
    rows = [row("gen_thesis_343", 1.2, 1.3), row("gen_thesis_8", 1.0, 1.0)]
    (found,) = judged({"6.2.1": rows})
    assert found.verdict == HOLDS
    assert found.claim.said.startswith("The same, the small one trained for more steps")


def test_rows_that_were_not_made_or_not_measured_judge_nothing():
    assert judged({}) == []
    rows = meshes((1.0, 1.0), ("8 nodes, right", 1.0, 1.0))
    assert judged({"meshes": rows[:2]}) == []
    assert judged({"meshes": [{"name": "343 nodes, right", "left_out": "no torch"}, *rows[2:]]}) == []
    assert judge((1.0, 1.0), (0.0, 0.0)) == []


def test_the_documented_results_judge_every_claim():
    found = json.loads((DOCS / "results.json").read_text())["sections"]
    assert len(judged({name: one["rows"] for name, one in found.items()})) == len(CLAIMS)
