"""Tables against finite elements at the equilibria of a whole ensemble: degrees and mm, muscle by muscle.

    python benchmarks/tables_truth.py --direct STORE --tables FOLDER [--design off_grid] [--json]

STORE is an ensemble of the simulator `direct`; cases that are not done yet, or failed, are left out. Both sides answer
at their own equilibrium, so that the error of a node holds that of the angle too.
"""

import argparse
import json
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES, Case
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.folder import load_tables
from myograph.units import degrees


def main() -> None:
    """Answer every case of the store from the tables; print what they differ by."""
    asked = _arguments()
    arm = TableArm(built_in_arm(), load_tables(asked.tables, built_in_arm()))
    result = {name: _muscle(asked.direct, name, arm, asked.design) for name in MUSCLES}
    print(json.dumps(result)) if asked.json else Console().print(_table(result))


def _muscle(store: Path, name: str, arm: TableArm, design: str) -> dict[str, float]:
    """Errors of one muscle's nodes and of the angle over the cases of a design."""
    cases = read_muscle(store, name)
    chosen = cases.named(design)
    if not len(chosen):
        raise InputError(f"{store}: expected cases of '{design}', found none that are done")
    angles, means, largest = [], [], []
    for number in chosen.tolist():
        case = Case(tuple(cases.activation[number].tolist()), float(cases.hand_load[number]))
        ours = arm(case)
        true = cases.values("position", np.array([number]))[0]
        apart = np.linalg.norm(ours.fields[name]["position"] - true, axis=1)
        angles.append(abs(degrees(ours.elbow_angle - float(cases.elbow_angle[number]))))
        means.append(apart.mean())
        largest.append(apart.max())
    return {
        "cases": len(chosen),
        "angle_mean_deg": float(np.mean(angles)),
        "angle_max_deg": float(np.max(angles)),
        "node_mean_mm": float(np.mean(means)),
        "worst_case_mean_mm": float(np.max(means)),
        "node_max_mm": float(np.max(largest)),
    }


def _table(result: dict[str, dict[str, float]]) -> Table:
    columns = list(next(iter(result.values())))
    table = Table("muscle", *columns)
    for name, row in result.items():
        table.add_row(name, *(f"{row[column]:.4g}" for column in columns))
    return table


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--direct", type=Path, required=True)
    parser.add_argument("--tables", type=Path, required=True)
    parser.add_argument("--design", default="off_grid")
    parser.add_argument("--json", action="store_true")
    return parser.parse_args()


if __name__ == "__main__":
    main()
