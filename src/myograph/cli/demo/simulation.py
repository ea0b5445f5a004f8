"""First half of the demo: finite elements, tables, the dataset of the biceps."""

from dataclasses import dataclass
from pathlib import Path

import xarray as xr

import myograph
from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.case import Solution
from myograph.cli.demo.sizes import MUSCLE, SEED, DemoSize
from myograph.cli.progress import Steps
from myograph.ensemble.dataset import dataset_from_solutions, save_dataset
from myograph.ensemble.design import factorial_cases, off_grid_cases
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.tabulate import tabulate


@dataclass(frozen=True)
class Simulation:
    """What was simulated: the tables of all muscles, the answers to all cases, the dataset of the biceps."""

    arm: Arm
    tables: dict[str, MuscleTable]
    solutions: tuple[Solution, ...]
    dataset: xr.Dataset


def simulate(arm: Arm, preset: str, size: DemoSize, out: Path, steps: Steps) -> Simulation:
    """Tabulate all muscles, solve all cases, gather and store the dataset.

    Raises NotConvergedError where a state fails, after all others are solved and kept.
    """
    spec = TableSpec(most_states=size.states, held_out=0)
    with steps.bars("finite elements", dict.fromkeys(arm.muscles, spec.most)) as advance:
        tables = tabulate(arm, preset, spec, out / "tables", advance)
    for table in tables.values():
        table.require_complete()
    table_arm = TableArm(arm, tables)
    designs = {"factorial": factorial_cases(), "off_grid": off_grid_cases(size.off_grid, SEED)}
    cases = [(design, case) for design, chosen in designs.items() for case in chosen]
    solutions = []
    with steps.bars("equilibrium", {"cases": len(cases)}) as advance:
        for _, case in cases:
            solutions.append(table_arm(case))
            advance("cases")
    provenance = {
        "simulator": "table",
        "preset": preset,
        "arm_checksum": arm_checksum(arm),
        "myograph_version": myograph.__version__,
    }
    table = tables[MUSCLE]
    words = [design for design, _ in cases]
    dataset = dataset_from_solutions(solutions, words, MUSCLE, (table.reference, table.skin), provenance)
    save_dataset(dataset, out / "dataset.zarr")
    return Simulation(arm, tables, tuple(solutions), dataset)
