"""`myograph ensemble run` refuses what it can before it builds tables, and finds tables again that have moved."""

import json
import shutil
import sys

import pytest

pytest.importorskip("distributed", reason="the verbs need Dask")

from myograph.cli.ensemble import app
from myograph.errors import InputError
from tests.ensemble.filled import filled_store
from tests.ensemble.tabulated import save_tables

MISTAKES = [
    (("--muscle", "bicep"), "muscles: expected some of brachioradialis.* got bicep"),
    (("--workers", "-1"), "workers: expected at least 1, got -1"),
    (("--workers", "0"), "workers: expected at least 1, got 0"),
    (("--time-limit", "0"), "time limit: expected a positive number of seconds, got 0"),
    (("--time-limit", "inf"), "time limit: expected a positive number of seconds, got inf"),
    (("--scheduler", "tcp://1.2.3.4:5", "--slurm", "none.toml"), "either a scheduler's address or a SLURM"),
    (("--slurm", "none.toml"), "none.toml: expected a TOML file, found none there"),
    (("--out", "mine"), "mine: expected the store of an ensemble, found none"),
    (("--out", "synthetic"), "synthetic: holds answers of 'tests.ensemble.synthetic:make', asked for 'table'"),
    (("--out", "."), r"\.: expected another folder than the one you are in"),
]


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A working folder in which no table may be built."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(
        sys.modules["myograph.cli.ensemble.run"], "tables_ready", lambda *_: pytest.fail("tables were built")
    )
    return tmp_path


@pytest.mark.parametrize(("options", "words"), MISTAKES, ids=[" ".join(options) for options, _ in MISTAKES])
def test_a_mistake_is_refused_before_any_table_is_built(place, options, words):
    if "mine" in options:
        (place / "mine").mkdir()
        (place / "mine" / "file").write_text("mine")
    if "synthetic" in options:
        filled_store(place / "synthetic", count=2)
    out = () if "--out" in options else ("--out", "store")
    before = sorted(place.iterdir())
    with pytest.raises(InputError, match=words):
        app(["run", "--preset", "tiny", *out, *options], standalone_mode=False)
    assert sorted(place.iterdir()) == before


def test_no_workers_are_refused_also_where_a_file_asks_for_some(place):
    (place / "arm.toml").write_text("[run]\nworkers = 2\n")
    with pytest.raises(InputError, match="workers: expected at least 1, got 0"):
        app(["run", "arm.toml", "--out", "store", "--workers", "0"], standalone_mode=False)


def test_a_file_cannot_ask_for_endless_time(place):
    (place / "arm.toml").write_text("[run]\ntime_limit_s = inf\n")
    with pytest.raises(InputError, match=r"run\.time_limit_s: "):
        app(["run", "arm.toml", "--out", "store"], standalone_mode=False)


@pytest.mark.exhaustive
def test_a_run_and_its_resumption_take_tables_that_have_moved(place, capsys):
    ask = ["run", "--preset", "tiny", "--muscle", "biceps", "--out", "here/store", "--workers", "1", "--json"]
    verbs = sys.modules["myograph.cli.ensemble.run"]
    verbs.tables_ready = lambda *_: save_tables(place / "here" / "tables-tiny")
    app(ask, standalone_mode=False)
    assert json.loads(capsys.readouterr().out)["done"] == 32
    verbs.tables_ready = lambda *_: pytest.fail("tables were built")
    shutil.move(place / "here" / "tables-tiny", place / "moved")
    for row in sorted((place / "here" / "store" / "rows").iterdir())[:2]:
        row.unlink()
    with pytest.raises(InputError, match=r"found none at .*tables-tiny; say where with --tables"):
        app(["resume", "here/store", "--workers", "1"], standalone_mode=False)
    with pytest.raises(InputError, match=r"found none at .*tables-tiny; say where with --tables"):
        app(ask, standalone_mode=False)
    app([*ask, "--tables", "moved"], standalone_mode=False)
    assert json.loads(capsys.readouterr().out)["done"] == 32
    sorted((place / "here" / "store" / "rows").iterdir())[0].unlink()
    app(["check", "here/store", "--repair", "--workers", "1", "--json"], standalone_mode=False)
    assert json.loads(capsys.readouterr().out)["ok"]
    shutil.move(place / "moved", place / "again")
    sorted((place / "here" / "store" / "rows").iterdir())[0].unlink()
    app(["resume", "here/store", "--workers", "1", "--tables", "again", "--json"], standalone_mode=False)
    assert json.loads(capsys.readouterr().out)["done"] == 32
