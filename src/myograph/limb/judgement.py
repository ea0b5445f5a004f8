"""The arm from its tables beside the arm by finite elements: equilibria and fields of the same cases, and the seconds.

Both answer at their own equilibrium, so that the error of a node holds that of the angle too.
"""

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from myograph.case import MUSCLES, Case, Simulator
from myograph.errors import InputError, MyographError
from myograph.limb.table_arm import TableArm


@dataclass(frozen=True)
class Judgement:
    """One case answered by both.

    Parameters
    ----------
    angle_error
        Angle of the tables minus that of the finite elements [rad].
    node_errors
        Muscle -> mean and largest distance of its nodes [mm].
    seconds
        That the finite elements took.
    failure
        Why one of them has no answer; then the numbers are NaN.
    """

    case: Case
    angle_error: float
    node_errors: Mapping[str, tuple[float, float]]
    seconds: float
    failure: str = ""


def random_cases(count: int, seed: int = 0) -> tuple[Case, ...]:
    """Cases without load and with activations uniform in (0, 1)^5; the same for the same seed."""
    if count < 1:
        raise InputError(f"number of cases: expected at least 1, got {count}")
    values = np.random.default_rng(seed).uniform(size=(count, len(MUSCLES)))
    return tuple(Case(tuple(row)) for row in values.tolist())


def judge(tables: Simulator, direct: Simulator, cases: Sequence[Case]) -> Iterator[Judgement]:
    """Each case by both, as soon as it is there."""
    for case in cases:
        started = time.perf_counter()
        try:
            true = direct(case)
            seconds = time.perf_counter() - started
            ours = tables(case)
        except MyographError as problem:
            nothing: dict[str, tuple[float, float]] = dict.fromkeys(MUSCLES, (np.nan, np.nan))
            yield Judgement(case, np.nan, nothing, time.perf_counter() - started, str(problem))
            continue
        errors: dict[str, tuple[float, float]] = {}
        for name in MUSCLES:
            apart = np.linalg.norm(ours.fields[name]["position"] - true.fields[name]["position"], axis=1)
            errors[name] = (float(apart.mean()), float(apart.max()))
        yield Judgement(case, ours.elbow_angle - true.elbow_angle, errors, seconds)


def seconds_per_case(arm: TableArm, cases: Sequence[Case], muscle: str = "biceps") -> float:
    """Median seconds from activations to the equilibrium and all positions of one muscle's nodes."""
    taken = []
    for case in (cases[0], *cases):
        started = time.perf_counter()
        angle = arm.limb.rest(case.activations, case.hand_load, arm.arm.reference_angle).angle
        arm.tables[muscle].field("position", angle, case.activations[MUSCLES.index(muscle)])
        taken.append(time.perf_counter() - started)
    return median(taken[1:])
