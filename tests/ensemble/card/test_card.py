"""A card: its numbers are those of the store, and it is no part of what is computed."""

import json
from dataclasses import replace

import numpy as np
import pytest

from myograph.ensemble.card.facts import gather_facts
from myograph.ensemble.card.ranges import distribution, muscle_scalars
from myograph.ensemble.card.text import card_text
from myograph.ensemble.card.writing import CARD, add_cost, write_card
from myograph.ensemble.store.checking import store_checksum
from myograph.ensemble.store.chunks import case_shape, chunk_path, encode
from myograph.ensemble.store.opening import open_muscle
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import Row, row_path, write_row
from myograph.errors import InputError
from myograph.export.csv import write_csv
from tests.ensemble.filled import filled_store


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    return filled_store(tmp_path_factory.mktemp("card") / "store", preset="fail=500")


@pytest.fixture
def own(tmp_path):
    return filled_store(tmp_path / "own", count=3, muscles=("biceps",))


def test_ranges_are_those_of_the_arrays(store):
    facts = gather_facts(store, None)
    data = open_muscle(store, "triceps")
    for name in ("von_mises", "fibre_stretch", "pressure"):
        values = data[name].values
        found = facts.fields["triceps"][name]
        assert (found.least, found.largest) == (np.nanmin(values), np.nanmax(values))
        assert found.mean == pytest.approx(np.nanmean(values, dtype=float), rel=1e-6)
    way = np.linalg.norm(data["position"].values - data["reference_position"].values, axis=2)
    assert facts.fields["triceps"]["displacement"].largest == pytest.approx(np.nanmax(way))
    assert facts.angle.largest == np.nanmax(data["elbow_angle"])
    assert facts.done + facts.failed == 12
    assert facts.reasons == {"no way further": facts.failed}
    assert 0 < facts.stored < 1.5 * facts.raw


def test_a_card_says_muscles_units_ranges_reasons_versions_and_command(store):
    text = card_text(gather_facts(store), "mine")
    assert text.startswith("# mine\n")
    for words in (
        "| biceps | 60 |",
        "| cauchy_stress | MPa | xx yy zz yz xz xy |",
        "of 12 cases are done",
        "x no way further",
        "| off_grid | 12 |",
        "triceps: von mises of its nodes | MPa |",
        "- command: `a test`",
        "- numpy version: `1.2.3`",
        "- time: not known",
        read_plan(store).described["arm_checksum"],
        "(card.png)",
    ):
        assert words in text, words


@pytest.mark.parametrize(
    ("kind", "words"),
    [("table", "cubic splines"), ("direct", "solved by finite elements"), ("import", "another program")],
)
def test_cards_know_where_data_come_from(store, kind, words):
    facts = gather_facts(store)
    plan = replace(facts.plan, simulator=replace(facts.plan.simulator, kind=kind))
    assert words in card_text(replace(facts, plan=plan), "x")


def test_only_ten_reasons_are_told(own):
    facts = gather_facts(own)
    text = card_text(replace(facts, reasons={f"reason {k}": 1 for k in range(13)}), "x")
    assert "- 1 x reason 9\n- and 3 other reasons" in text


def test_neither_card_nor_cost_changes_the_checksum_of_a_store(own):
    before = store_checksum(own)
    assert write_card(own) == (own / CARD).read_text()
    add_cost(own, 1.5)
    add_cost(own, 2.0)
    assert "- time: 3.5 s in 2 runs that came to their end" in write_card(own)
    assert json.loads((own / "provenance.json").read_text())["command"] == "a test"
    (own / "card.png").write_bytes(b"x")
    assert store_checksum(own) == before


def test_a_card_of_damaged_and_missing_cases_is_written_and_says_so(own):
    chunk_path(own, "biceps", "von_mises", 1).write_bytes(b"rubbish")
    chunk_path(own, "biceps", "position", 2).unlink()
    (own / "provenance.json").write_text("{")
    facts = gather_facts(own)
    assert facts.unreadable == 2
    assert facts.provenance == {}
    assert "2 cases of a muscle could not be read" in card_text(facts, "x")
    row_path(own, 0).write_text("rubbish")
    assert gather_facts(own).missing == 1


def test_a_card_without_any_answer(own):
    for case in range(3):
        write_row(own, Row(case, "failed", reason="no"))
    text = write_card(own)
    assert "0 of 3 cases are done, 3 failed" in text
    assert "elbow flexion, all cases" not in text


def test_a_distribution_counts_every_node_of_every_case_once(own):
    scalars = muscle_scalars(own, read_plan(own), "biceps")
    edges, counts = distribution(scalars, {"a": [0, 2], "b": [1]}, "pressure", 7)
    assert {word: count.sum() for word, count in counts.items()} == {"a": 120, "b": 60}
    values = open_muscle(own, "biceps")["pressure"].values
    assert (edges[0], edges[-1]) == pytest.approx((values.min(), values.max()))


def test_a_store_without_its_reference_body_is_refused(own):
    plan = read_plan(own)
    (own / "biceps" / "zarr.json").write_text("rubbish")
    with pytest.raises(InputError, match=r"biceps/zarr\.json: not the bytes that were written"):
        muscle_scalars(own, plan, "biceps")


def put_another_chunk(store, field, case):
    """Finite numbers of the right shape that are not those of the case."""
    chunk_path(store, "biceps", field, case).write_bytes(encode(field, np.ones(case_shape(field, 60)), 60))


def test_a_chunk_that_is_sound_and_not_the_one_that_was_written_is_left_out_and_counted(own):
    put_another_chunk(own, "von_mises", 1)
    facts = gather_facts(own)
    assert facts.unreadable == 1
    assert facts.fields["biceps"]["von_mises"].least == open_muscle(own, "biceps")["von_mises"].values[[0, 2]].min()


def test_distributions_and_csv_refuse_a_chunk_that_is_not_the_one_that_was_written(own, tmp_path):
    put_another_chunk(own, "pressure", 2)
    with pytest.raises(InputError, match=r"case 2, biceps/pressure: not the bytes that were written; .*--repair"):
        distribution(muscle_scalars(own, read_plan(own), "biceps"), {"a": [0, 2]}, "pressure", 7)
    with pytest.raises(InputError, match="case 2, biceps/pressure: not the bytes"):
        write_csv(tmp_path / "cases.csv", own)
