"""Stores of synthetic cases, and their runs."""

import pytest

from myograph.ensemble.design import DesignSpec, make_design
from myograph.ensemble.store.making import make_store, plan_store
from tests.ensemble import synthetic


@pytest.fixture
def make(tmp_path):
    """Make a store of some random cases, by name; the same name again opens it."""

    def make(name="store", count=30, muscles=("biceps",), seed=0, **simulator):
        design = make_design([DesignSpec(method="tenths", count=count, seed=seed)])
        plan, bodies = plan_store(design, synthetic.spec(**simulator), muscles)
        make_store(tmp_path / name, plan, bodies, {"command": "test"})
        return tmp_path / name

    return make
