"""A small store of cases from formulas, with all designs that experiments ask for."""

import pytest
from threadpoolctl import threadpool_limits

from myograph.anatomy.load import built_in_arm
from myograph.cli.progress import Steps
from myograph.cli.reproduce import runner as running
from myograph.cli.reproduce.data import Data, Places
from myograph.cli.reproduce.sizes import reproduction_size
from myograph.ensemble.design import DesignSpec, make_design
from myograph.ensemble.simulators import make_simulator
from myograph.ensemble.store.making import make_store, plan_store
from myograph.ensemble.store.writing import write_solution
from tests.ensemble import synthetic


@pytest.fixture(scope="session")
def store(tmp_path_factory):
    specs = [
        DesignSpec(),
        DesignSpec(method="tenths", count=24, label="support"),
        DesignSpec(method="latin_hypercube", count=8),
    ]
    return stored(tmp_path_factory.mktemp("reproduce") / "store", specs)


def stored(path, specs):
    """A store of these designs."""
    design = make_design(specs)
    plan, bodies = plan_store(design, synthetic.spec(), ["biceps"])
    make_store(path, plan, bodies, {"command": "a test"})
    answer = make_simulator(plan.simulator)
    for number, case in enumerate(design.cases):
        write_solution(path, plan, number, answer(case))
    return path


@pytest.fixture
def data(store, tmp_path):
    return Data(built_in_arm(), "tiny", reproduction_size("tiny"), Places(tmp_path / "out", store), Steps())


@pytest.fixture
def here(monkeypatch):
    """Trials in this process, one after the other, on one thread as in their own; the list of what was made."""
    made = []

    def one_by_one(work, tasks, on_news):
        results = []
        for task in tasks:
            results.append(work(*task, on_news))
            made.append(task[0].name)
        return results

    monkeypatch.setattr(running, "side_by_side", one_by_one)
    with threadpool_limits(1):
        yield made
