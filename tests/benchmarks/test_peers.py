"""The comparison with peers: what adapters are given, how they are judged, what becomes of one that fails."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from tests.ensemble.pairs.made_up import made_up

PEERS = Path(__file__).parents[2] / "benchmarks" / "peers"


@pytest.fixture
def peers(monkeypatch):
    """The folder's modules, importable as they are when it is run as a script."""
    monkeypatch.syspath_prepend(str(PEERS))
    import compare
    import export_cases
    import run_peer

    yield {"compare": compare, "export": export_cases, "run": run_peer}
    for name in [name for name in sys.modules if name in ("compare", "export_cases", "run_peer", "adapters")]:
        sys.modules.pop(name)
    for name in [name for name in sys.modules if name.startswith("adapters.")]:
        sys.modules.pop(name)


@pytest.fixture
def arrays(peers):
    return peers["export"].arrays_of(made_up(factorial=10, off_grid=4, support=6), seed=0)


def test_what_tests_does_not_teach_but_under_thesis(arrays):
    for protocol in ("strict", "off_grid"):
        assert not set(arrays[f"train_{protocol}"]) & set(arrays[f"test_{protocol}"])
        assert len(arrays[f"test_{protocol}"]) > 0
    assert set(arrays["test_thesis"]) <= set(arrays["train_thesis"])


def test_a_right_answer_has_no_error_and_sensors_do_not_count(peers, arrays):
    tested = arrays["test_strict"]
    right = {name: arrays[name][tested].copy() for name in ("position", "von_mises")}
    right["position"][:, arrays["sensors"]] += 100.0
    found = peers["run"].errors(right, arrays, tested)
    assert found == {"mean_mm": 0.0, "p95_mm": 0.0, "max_mm": 0.0, "von_mises_mean_mpa": 0.0}
    right["position"] += np.array([3.0, 4.0, 0.0])
    assert peers["run"].errors(right, arrays, tested)["mean_mm"] == pytest.approx(5.0)


@pytest.mark.filterwarnings("ignore::sklearn.exceptions.ConvergenceWarning")
def test_an_adapter_answers_in_the_common_shape(peers, arrays, tmp_path):
    np.savez(tmp_path / "cases.npz", **arrays)
    told = peers["run"].run("sklearn_pod", tmp_path / "cases.npz", "off_grid", 1.0, 0)
    assert "reason" not in told, told
    assert 0 < told["mean_mm"] <= told["p95_mm"] <= told["max_mm"]
    assert told["numbers"] > 0


@pytest.mark.parametrize(
    ("adapter", "reason"), [("not_there", "cannot be imported"), ("broken_here", "ValueError: no")]
)
def test_an_adapter_that_cannot_do_it_says_why(peers, arrays, tmp_path, monkeypatch, adapter, reason):
    from types import SimpleNamespace

    def fit(task):
        raise ValueError("no\nway")

    monkeypatch.setitem(sys.modules, "adapters.broken_here", SimpleNamespace(fit=fit, DOES={}))
    np.savez(tmp_path / "cases.npz", **arrays)
    assert peers["run"].run(adapter, tmp_path / "cases.npz", "strict", 1.0, 0)["reason"].startswith(reason)


def test_peers_without_their_environment_keep_their_rows(peers, tmp_path):
    from types import SimpleNamespace

    asked = SimpleNamespace(python=tmp_path / "nowhere" / "python", seconds=1.0)
    told = peers["compare"].peer("ezyrb_pod_rbf", tmp_path / "cases.npz", "strict", asked, 0)
    assert "no environment of the peers" in told["reason"]
    lines = peers["compare"].table([{"name": "ezyrb_pod_rbf", "protocol": "strict", **told}]).splitlines()
    assert "not measured: no environment" in lines[-1]


def test_every_adapter_is_short():
    for path in (PEERS / "adapters").glob("*.py"):
        assert len(path.read_text().splitlines()) < 100, path


def test_the_kept_table_has_every_method(peers):
    told = json.loads((PEERS / "peers.json").read_text())
    names = {row["name"] for row in told["rows"]}
    assert names == {*peers["compare"].OURS, *peers["compare"].PEERS}
    assert (PEERS / "peers.md").read_text() == peers["compare"].page(told)


def test_seeds_become_a_mean_and_a_deviation_and_one_that_failed_does_not_count(peers):
    measured = [{"mean_mm": 1.0, "reads": "sensors"}, {"reason": "no way"}, {"mean_mm": 3.0, "reads": "sensors"}]
    found = peers["compare"].mean_of(measured)
    assert found == {"mean_mm": 2.0, "mean_mm_std": 1.0, "reads": "sensors", "answered": 2}
    assert "| 2 ± 1 |" in peers["compare"].table([{"name": "a", "protocol": "strict", **found}])
    assert peers["compare"].mean_of([{"reason": "no way"}] * 2) == {"reason": "no way"}


def test_rows_of_another_run_are_kept_where_cases_and_limits_are_the_same(peers, tmp_path):
    about = {"seconds": 1.0, "seeds": 1, "data": "x"}
    row = {"name": "pod_gp", "protocol": "strict", "mean_mm": 1.0}
    peers["compare"].write(tmp_path / "peers.json", {**about, "load": 1.0, "rows": [row]})
    assert peers["compare"].kept(tmp_path / "peers.json", about) == {("pod_gp", "strict"): row}
    assert peers["compare"].kept(tmp_path / "peers.json", {**about, "data": "y"}) == {}
    assert "| pod_gp | strict | 1 |" in (tmp_path / "peers.md").read_text()
    assert peers["compare"].kept(tmp_path / "nothing.json", about) == {}
