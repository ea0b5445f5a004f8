"""All muscles over the whole box of elbow angle and activation: how many states are solved, how fast, how soundly.

    python benchmarks/box.py [--preset tiny quick thesis] [--muscle NAME ...] [--out DIR] [--json]

States are kept in DIR and used again; their minutes of processor time are those of the run that solved them.
"""

import argparse
import json
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.limb.tables.solve import FiniteElementStates
from myograph.limb.tables.spec import box
from myograph.limb.tables.state import State

COLUMNS = (
    "preset",
    "muscle",
    "solved",
    "states",
    "newton_mean",
    "newton_most",
    "volume",
    "smallest_J",
    "depth_mm",
    "minutes",
)


def main() -> None:
    """Solve, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preset", nargs="+", default=["tiny", "quick", "thesis"])
    parser.add_argument("--muscle", nargs="+", default=list(reversed(MUSCLES)))
    parser.add_argument("--out", type=Path, default=Path("box"))
    parser.add_argument("--angles", type=int, default=7)
    parser.add_argument("--activations", type=int, default=7)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    jobs = [(preset, name) for preset in options.preset for name in options.muscle]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        rows = []
        for row in pool.map(partial(_row, options.out, (options.angles, options.activations)), jobs):
            Console(stderr=True).print(row)
            rows.append(row)
    if options.json:
        print(json.dumps({"box": rows}))
        return
    table = Table(*COLUMNS)
    for row in rows:
        table.add_row(*(str(row[column]) for column in COLUMNS))
    Console(width=140).print(table)


def _row(out: Path, size: tuple[int, int], job: tuple[str, str]) -> dict:
    preset, name = job
    arm = built_in_arm()
    domain = box(arm)
    axes = [np.linspace(low, high, number) for low, high, number in zip(domain.lower, domain.upper, size, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    states = FiniteElementStates(arm, name, preset, lambda _: None, out / preset)(points)
    return {"preset": preset, "muscle": name, **_summary(states)}


def _summary(states: list[State]) -> dict:
    solved = [state for state in states if not state.failure]
    steps = [state.newton_steps for state in solved]
    return {
        "solved": len(solved),
        "states": len(states),
        "newton_mean": round(float(np.mean(steps)), 2),
        "newton_most": max(steps),
        "volume": f"{max(abs(state.volume_change) for state in solved):.1e}",
        "smallest_J": round(min(state.smallest_jacobian for state in solved), 2),
        "depth_mm": round(max(state.penetration for state in solved), 2),
        "minutes": round(sum(state.seconds for state in states) / 60, 2),
    }


if __name__ == "__main__":
    main()
