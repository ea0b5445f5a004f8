"""Ten kills -9 of the runner and of simulators at random moments: the store comes out byte for byte the same."""

import pytest

pytest.importorskip("distributed", reason="runs need Dask")

from benchmarks.kill_ensemble import disturb, new_store

from myograph.ensemble.running.run import RunOptions, run_store
from myograph.ensemble.store.checking import check_store, store_checksum
from myograph.ensemble.store.plan import read_plan
from tests.ensemble import synthetic
from tests.ensemble.running.test_run import ROOT


@pytest.mark.slow
def test_after_ten_kills_the_store_equals_the_undisturbed_one(tmp_path, monkeypatch):
    """With answers that depend on the cases before: the hardest to get the same again."""
    monkeypatch.chdir(ROOT)
    disturbed = new_store(tmp_path / "disturbed", 160, synthetic.REMEMBERING)
    peaceful = new_store(tmp_path / "peaceful", 160, synthetic.REMEMBERING)
    killed = disturb(disturbed, kills=10, seed=3)
    assert killed == {"runners": 3, "simulators": 7}
    run_store(peaceful, RunOptions(workers=2))
    assert not list(check_store(disturbed, read_plan(disturbed)))
    assert store_checksum(disturbed) == store_checksum(peaceful)
