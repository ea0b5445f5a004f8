"""Stores of synthetic cases with all their answers, computed in this process."""

from myograph.ensemble.design import DesignSpec, make_design
from myograph.ensemble.simulators import make_simulator
from myograph.ensemble.store.making import make_store, plan_store
from myograph.ensemble.store.writing import write_failure, write_solution
from myograph.errors import MyographError
from tests.ensemble import synthetic


def filled_store(path, count=12, muscles=("biceps", "triceps"), **simulator):
    """A store of random cases; what the simulator raises becomes a failed row."""
    design = make_design([DesignSpec(method="tenths", count=count)])
    plan, bodies = plan_store(design, synthetic.spec(**simulator), muscles)
    make_store(path, plan, bodies, {"command": "a test", "numpy_version": "1.2.3"})
    answer = make_simulator(plan.simulator)
    for number, case in enumerate(design.cases):
        try:
            write_solution(path, plan, number, answer(case))
        except MyographError as problem:
            write_failure(path, plan, number, problem)
    return path
