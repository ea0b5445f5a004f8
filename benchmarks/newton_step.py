"""What one Newton step costs: assembly of the tangent, its factorisation, and all the rest; medians over many steps.

python benchmarks/newton_step.py [--preset quick] [--muscle biceps] [--steps 15]
"""

import argparse
import json
import statistics
import time

import ngsolve as ngs
import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.mechanics.continuation import Controls, at_rest, set_controls
from myograph.mechanics.newton import newton
from myograph.mechanics.problem import MuscleProblem
from myograph.mesh.presets import RESOLUTIONS, muscle_mesh


def main() -> None:
    """Time the parts and the whole in one run; print their medians and the ratio."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", default="quick")
    parser.add_argument("--muscle", default="biceps")
    parser.add_argument("--steps", type=int, default=15)
    options = parser.parse_args()
    ngs.SetNumThreads(1)
    ngs.ngsglobals.msg_level = 0
    arm = built_in_arm()
    mesh = muscle_mesh(arm, options.muscle, RESOLUTIONS[options.preset])
    problem = MuscleProblem(arm, options.muscle, mesh)
    rest = at_rest(problem)
    tangent = problem.tangent(rest.vector)
    times: dict[str, list[float]] = {"assembly": [], "factorisation": [], "step": []}
    for round_ in range(options.steps):
        started = time.perf_counter()
        problem.assemble(rest.vector)
        assembled = time.perf_counter()
        tangent.refactor()
        times["assembly"].append(assembled - started)
        times["factorisation"].append(time.perf_counter() - assembled)
        set_controls(problem, Controls(1.0, 0.05 * (1 + round_ % 2), 0.0))
        started = time.perf_counter()
        result = newton(problem, rest.vector, np.zeros(problem.vector_size), contraction=0)
        times["step"].append((time.perf_counter() - started) / result.tangents)
    medians = {name: statistics.median(values) for name, values in times.items()}
    ratio = medians["step"] / (medians["assembly"] + medians["factorisation"])
    print(json.dumps({"preset": options.preset, "unknowns": problem.vector_size, **medians, "ratio": ratio}))


if __name__ == "__main__":
    main()
