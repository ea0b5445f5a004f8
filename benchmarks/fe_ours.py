"""Our side of benchmarks/fe.py: writes the problem that FElupe gets, or walks through its load steps and times itself.

    python fe_ours.py PROBLEM --write [--preset quick] [--muscle biceps]
    python fe_ours.py PROBLEM --solve RESULT

The muscle has neither bones nor bands. Loads: the pre-stretch in eight equal increments in the reference pose, one
jump of the activation, one turn of the elbow; each solved from the one before by `newton`, without any prediction.
PROBLEM and RESULT are .npz files of plain arrays.
"""

import argparse
import json
import resource
import sys
import time

import ngsolve as ngs
import numpy as np

import myograph.mechanics.problem as problem_module
from myograph.anatomy.load import built_in_arm
from myograph.anatomy.model import Arm, Contact
from myograph.errors import InputError, MyographError, NotConvergedError
from myograph.mechanics.algebra import Tangent
from myograph.mechanics.continuation import Controls, set_controls
from myograph.mechanics.newton import newton
from myograph.mechanics.problem import MuscleProblem
from myograph.mesh.presets import preset_mesh
from myograph.units import radians

INCREMENTS, ACTIVATION, TURN = 8, 0.5, radians(5.0)
LAWS = ("gauss", "toe_tendon")
SECONDS = {"matrix": np.zeros(2), "linear": np.zeros(2)}
"""Wall and processor, of the tangent's assembly, and of its factorisation and use, since the last reset."""


def now() -> np.ndarray:
    """Seconds of the wall's clock and of this process on its processor."""
    return np.array([time.perf_counter(), time.process_time()])


class TimedTangent(Tangent):
    """A tangent that counts its own seconds."""

    def __init__(self, matrix: ngs.BaseMatrix, free: ngs.BitArray) -> None:
        started = now()
        super().__init__(matrix, free)
        SECONDS["linear"] += now() - started

    def refactor(self) -> None:
        """Factor the matrix as it is now."""
        started = now()
        super().refactor()
        SECONDS["linear"] += now() - started

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Solution on the free unknowns."""
        started = now()
        result = super().solve(right)
        SECONDS["linear"] += now() - started
        return result


class TimedProblem(MuscleProblem):
    """A muscle that counts the seconds of its tangents."""

    def tangent(self, vector: np.ndarray) -> Tangent:
        """Second derivative of the energy, factored."""
        started, factored = now(), SECONDS["linear"].copy()
        result = super().tangent(vector)
        SECONDS["matrix"] += now() - started - (SECONDS["linear"] - factored)
        return result


def free_arm(name: str) -> Arm:
    """The built-in arm whose named muscle touches nothing."""
    arm = built_in_arm()
    if name not in arm.muscles:
        raise InputError(f"unknown muscle '{name}': expected one of {', '.join(arm.muscles)}")
    muscle = arm.muscles[name].model_copy(update={"contact": Contact()})
    laws = (muscle.belly.law, muscle.tendon.law)
    if laws != LAWS or not (muscle.tissue.bundles and muscle.tissue.prestretch_matrix):
        raise InputError(f"{name}: fe_felupe_law.py knows bundles of {' and '.join(LAWS)}, got {' and '.join(laws)}")
    return arm.model_copy(update={"muscles": {**arm.muscles, name: muscle}})


def loads() -> list[Controls]:
    """The load steps."""
    ramp = [Controls(k / INCREMENTS, 0.0, 0.0) for k in range(1, INCREMENTS + 1)]
    return [*ramp, Controls(1.0, ACTIVATION, 0.0), Controls(1.0, ACTIVATION, TURN)]


def build(name: str, preset: str) -> TimedProblem:
    """The muscle, ready to be solved."""
    ngs.SetNumThreads(1)
    ngs.ngsglobals.msg_level = 0
    problem_module.Tangent = TimedTangent
    arm = free_arm(name)
    return TimedProblem(arm, name, preset_mesh(arm, name, preset))


def description(name: str, preset: str) -> dict[str, np.ndarray]:
    """All that another finite-element program needs to know, with the fields at the 27 integration points of a cell."""
    problem = build(name, preset)
    mesh, muscle = problem.mesh, problem.muscle
    rule = ngs.IntegrationRule((0.5 * (mesh.element.places + 1)).tolist(), mesh.element.weights.tolist())
    points = problem.space.mesh.MapToAllElements(rule, ngs.VOL)
    shape = (len(mesh.cells), len(mesh.element.places))
    insertion = mesh.end_nodes("insertion")
    law = {part: getattr(muscle, part).model_dump() for part in ("tissue", "belly", "tendon")}
    return {
        "names": np.array([name, preset]),
        "law": np.array(json.dumps(law)),
        "points": mesh.points,
        "cells": mesh.cells,
        "places": mesh.element.places,
        "fibre": np.asarray(problem.site.fibre(points)).reshape(*shape, 3),
        "fraction": np.asarray(problem.site.fraction(points)).reshape(shape),
        "area": np.asarray(problem.site.area(points)).reshape(shape),
        "origin": mesh.end_nodes("origin"),
        "insertion": insertion,
        "loads": np.array([load.values() for load in loads()]),
        "moved": np.stack([problem.insertion.displacement(load.flexion)[insertion] for load in loads()]),
        "rate": problem.insertion.rate(TURN)[insertion],
    }


def walk(name: str, preset: str) -> tuple[dict, dict]:
    """Go through all loads: where it ended, and what it took."""
    started = now()
    problem = build(name, preset)
    vector, steps = np.zeros(problem.vector_size), 0
    SECONDS.update(matrix=np.zeros(2), linear=np.zeros(2))
    prepared = now()
    for load in loads():
        set_controls(problem, load)
        held = np.where(problem.free, 0.0, vector)
        result = newton(problem, vector, problem.boundary_values(load.flexion) - held)
        if result.failure:
            raise NotConvergedError(f"{name} at {load}: {result.failure}", residuals=result.residuals)
        vector, steps = result.vector, steps + result.tangents
    walked = now() - prepared
    seconds = {"setup": prepared - started, "walk": walked, **SECONDS, "rest": walked - sum(SECONDS.values())}
    answer = {"positions": problem.positions(vector), "moment": problem.moment(vector, TURN)}
    return answer, {**seconds, "newton_steps": steps, "unknowns": problem.vector_size}


def main() -> None:
    """Write the problem, or solve it, write the answer and say what it took as JSON."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem")
    task = parser.add_mutually_exclusive_group(required=True)
    task.add_argument("--write", action="store_true")
    task.add_argument("--solve", metavar="RESULT")
    parser.add_argument("--preset", default="quick")
    parser.add_argument("--muscle", default="biceps")
    options = parser.parse_args()
    try:
        if options.write:
            np.savez(options.problem, **description(options.muscle, options.preset))
            return
        with np.load(options.problem, allow_pickle=False) as file:
            name, preset = map(str, file["names"])
        answer, cost = walk(name, preset)
    except MyographError as problem:
        sys.exit(_told(problem))
    np.savez(options.solve, **answer)
    cost["memory_mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    sys.stdout.write(json.dumps(cost, default=list) + "\n")


def _told(problem: MyographError) -> int:
    sys.stderr.write(f"{problem}\n")
    return problem.exit_code


if __name__ == "__main__":
    main()
