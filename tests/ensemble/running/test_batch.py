"""One batch: what becomes of a case whose process is ended, and of a batch whose solver is."""

import threading
import time

import numpy as np
import pytest

from myograph.ensemble.running import batch
from myograph.ensemble.running.batch import BatchSolver, SolverEndedError, Task
from myograph.ensemble.running.process import SimulatorProcess, TimeLimitError
from myograph.ensemble.simulators import make_simulator
from myograph.ensemble.store.checking import check_store
from myograph.ensemble.store.chunks import chunk_path
from myograph.ensemble.store.opening import open_muscle
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.rows import read_row, row_path
from myograph.ensemble.store.writing import write_solution


@pytest.fixture
def late(make, monkeypatch):
    """Function: the store of one case whose process wrote its answer before its time was up, and then lost some."""

    def solved(*lost):
        store = make(count=1)
        plan = read_plan(store)

        class Late(SimulatorProcess):
            def __init__(self, *_):
                pass

            def solve(self, step, seconds):
                answer = make_simulator(plan.simulator)(plan.design.cases[step.case])
                write_solution(store, plan, step.case, answer)
                for path in lost:
                    path(store).unlink()
                raise TimeLimitError

        monkeypatch.setattr(batch, "SimulatorProcess", Late)
        assert BatchSolver(Task(str(store), plan.simulator, 1.0, 0)).solve((0,)) == ""
        return store

    return solved


def test_an_answer_that_was_whole_when_time_was_up_stays(late):
    store = late()
    assert read_row(store, 0).state == "done"
    assert np.isfinite(open_muscle(store, "biceps")["position"].values).all()


def test_a_case_that_ran_out_of_time_while_it_was_written_has_no_fields(late):
    store = late(lambda store: row_path(store, 0), lambda store: chunk_path(store, "biceps", "pressure", 0))
    assert read_row(store, 0).reason == "took longer than 1 s"
    assert np.isnan(open_muscle(store, "biceps")["position"].values).all()
    assert "has arrays" not in " ".join(one.what for one in check_store(store, read_plan(store)))


def test_a_solver_that_is_ended_computes_nothing_more(make):
    store = make(count=20, preset="sleep=0.1")
    solver, raised = BatchSolver(Task(str(store), read_plan(store).simulator, None, 3)), []

    def work():
        with pytest.raises(SolverEndedError) as ended:
            solver.solve(range(20))
        raised.append(ended)

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    while not row_path(store, 0).exists():
        time.sleep(0.01)
    solver.end()
    ready = len(list((store / "rows").iterdir()))
    thread.join(20)
    assert raised
    time.sleep(0.5)
    assert len(list((store / "rows").iterdir())) == ready < 20
    with pytest.raises(SolverEndedError):
        solver.solve(range(20))


def test_a_solver_that_is_ended_while_its_simulator_is_made_computes_nothing(make, monkeypatch):
    store, ended = make(count=1), []

    class Slow(SimulatorProcess):
        def __init__(self, *_):
            solver.end()

        def end(self):
            ended.append(self)

    monkeypatch.setattr(batch, "SimulatorProcess", Slow)
    solver = BatchSolver(Task(str(store), read_plan(store).simulator, None, 3))
    with pytest.raises(SolverEndedError):
        solver.solve((0,))
    assert ended
    assert not row_path(store, 0).exists()
