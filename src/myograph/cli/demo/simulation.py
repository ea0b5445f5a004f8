"""First half of the demo: finite elements, tables, the store of the biceps."""

from dataclasses import dataclass
from pathlib import Path

import myograph
from myograph.anatomy.model import Arm
from myograph.case import Case, Solution
from myograph.cli.demo.sizes import MUSCLE, SEED, DemoSize
from myograph.cli.progress import Steps
from myograph.ensemble.design import Design, factorial_cases, off_grid_cases
from myograph.ensemble.here import compute_here
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.making import make_store, plan_store
from myograph.ensemble.store.opening import reasons
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import NotConvergedError
from myograph.files import write_whole_folder
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.tabulate import tabulate

STORE = "ensemble"


@dataclass(frozen=True)
class Simulation:
    """What was simulated: the tables of all muscles, two answers for pictures, the biceps in its store."""

    arm: Arm
    preset: str
    tables: dict[str, MuscleTable]
    rest: Solution
    active: Solution
    store: Path
    cases: MuscleCases


def simulate(arm: Arm, preset: str, size: DemoSize, out: Path, steps: Steps) -> Simulation:
    """Tabulate all muscles, solve all cases into a store.

    Raises NotConvergedError where a state or a case fails, after all other states are solved and kept.
    """
    spec = TableSpec(most_states=size.states, held_out=0)
    with steps.bars("finite elements", dict.fromkeys(arm.muscles, spec.most)) as advance:
        tables = tabulate(arm, preset, spec, out / "tables", advance)
    for table in tables.values():
        table.require_complete()
    simulator = TableArm(arm, tables)
    rest, active = (simulator(Case((level,) * len(tables))) for level in (0.0, 1.0))
    design = _design(size)
    named = SimulatorSpec("table", preset, arm.model_dump_json(), str(out / "tables"))
    with steps.bars("equilibrium", {"cases": len(design.cases)}) as advance:

        def write(store: Path) -> None:
            plan, bodies = plan_store(design, named, [MUSCLE])
            make_store(store, plan, bodies, {"myograph_version": myograph.__version__})
            compute_here(store, simulator, lambda: advance("cases"))
            for reason in reasons(store).values():
                raise NotConvergedError(reason)

        write_whole_folder(out / STORE, write)
    return Simulation(arm, preset, tables, rest, active, out / STORE, read_muscle(out / STORE, MUSCLE))


def _design(size: DemoSize) -> Design:
    corners, others = factorial_cases(), off_grid_cases(size.off_grid, SEED)
    return Design((*corners, *others), ("factorial",) * len(corners) + ("off_grid",) * len(others))
