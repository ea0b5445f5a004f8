"""All muscles over the whole box of elbow angle and activation: how many states are solved, how fast, how soundly.

    python benchmarks/box.py [--preset tiny quick thesis] [--muscle NAME ...] [--out DIR] [--json]

Tables are kept in DIR and used again; their seconds are those of the run that made them.
"""

import argparse
import json
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.table import Table

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.limb.table import MuscleTable, load_table, regular_grid, save_table, table_key
from myograph.limb.tabulate import tabulate_muscle

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
    """Tabulate, print."""
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
    grid = regular_grid(arm, *size)
    path, key = out / preset / f"{name}.npz", table_key(arm, name, preset, grid)
    seconds = path.with_suffix(".seconds")
    try:
        table = load_table(path, key)
    except InputError:
        started = time.perf_counter()
        table = tabulate_muscle(arm, name, preset, grid, lambda _: None)
        path.parent.mkdir(parents=True, exist_ok=True)
        seconds.write_text(str(time.perf_counter() - started))
        save_table(table, path)
    return {"preset": preset, "muscle": name, **_summary(table), "minutes": round(float(seconds.read_text()) / 60, 2)}


def _summary(table: MuscleTable) -> dict:
    record, solved = table.record, table.record.failures == ""
    return {
        "solved": int(solved.sum()),
        "states": table.grid.size,
        "newton_mean": round(float(record.newton_steps[solved].mean()), 2),
        "newton_most": int(record.newton_steps[solved].max()),
        "volume": f"{abs(record.volume_change[solved]).max():.1e}",
        "smallest_J": round(float(record.smallest_jacobian[solved].min()), 2),
        "depth_mm": round(float(record.penetration[solved].max()), 2),
    }


if __name__ == "__main__":
    main()
