"""What a run leaves besides its cases, and what it tries again; without any worker."""

import pytest

pytest.importorskip("distributed", reason="runs need Dask")

from myograph.ensemble.card.writing import CARD
from myograph.ensemble.running import run
from myograph.ensemble.store.chunks import chunk_path
from myograph.ensemble.store.rows import Row, row_path, write_row
from myograph.errors import InputError
from tests.ensemble.filled import filled_store


@pytest.fixture
def own(tmp_path):
    return filled_store(tmp_path / "own", count=3, muscles=("biceps",))


def test_a_run_writes_the_card_and_what_it_cost(own, monkeypatch):
    monkeypatch.setattr(run, "_run", lambda *_: write_row(own, Row(1, "failed", reason="no")))
    row_path(own, 1).unlink()
    (own / CARD).write_text("old")
    run.run_store(own, run.RunOptions(workers=1))
    text = (own / CARD).read_text()
    assert "2 of 3 cases are done, 1 failed" in text
    assert "s in 1 runs" in text
    run.run_store(own, run.RunOptions(workers=1))
    assert (own / CARD).read_text() == text


@pytest.mark.parametrize("step", ["sweep", "write_summary", "write_card"])
def test_a_disk_that_is_full_at_the_start_or_at_the_end_is_one_line(own, monkeypatch, step):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(run, step, full)
    with pytest.raises(InputError, match=r"own: cannot be written \(No space left on device\); free some room"):
        run.run_store(own, run.RunOptions(workers=1))


@pytest.mark.parametrize("again", [True, False])
def test_cases_that_failed_are_tried_again_only_if_asked_for(own, monkeypatch, again):
    write_row(own, Row(1, "failed", reason="no"))
    found = []
    monkeypatch.setattr(run, "_run", lambda store, plan, how, todo: found.extend(todo))
    run.run_store(own, run.RunOptions(again=again))
    assert bool(found) == again
    assert chunk_path(own, "biceps", "position", 1).exists() != again
