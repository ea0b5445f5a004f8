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
from myograph.limb.table import MuscleTable, regular_grid
from myograph.limb.table_arm import TableArm
from myograph.limb.tabulate import tabulate


@dataclass(frozen=True)
class Simulation:
    """What was simulated: the tables of all muscles, the answers to all cases, the dataset of the biceps."""

    arm: Arm
    tables: dict[str, MuscleTable]
    solutions: tuple[Solution, ...]
    dataset: xr.Dataset


def simulate(arm: Arm, preset: str, size: DemoSize, out: Path, steps: Steps) -> Simulation:
    """Tabulate all muscles, solve all cases, gather and store the dataset."""
    grid = regular_grid(arm, size.angles, size.activations)
    with steps.bars("finite elements", dict.fromkeys(arm.muscles, grid.size)) as advance:
        tables = tabulate(arm, preset, grid, out / "tables", advance)
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
