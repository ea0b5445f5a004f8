"""The cases that experiments need: tables of all muscles, and stores of the biceps, made when they are first asked for.

    ensemble   corners, random tenths ('support'), continuous activations; from tables
    steps      all cases of step 0.5, random tenths, continuous ones to teach and others to test; from tables
    direct     corners and continuous activations; each solved by finite elements
    beside     the same cases from tables

All of them go on where an interrupted run left them.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np
from jaxtyping import Float

import myograph
from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.cli.progress import Steps
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import MUSCLE
from myograph.ensemble.design import Design, DesignSpec, make_design
from myograph.ensemble.here import compute_here
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import FACTORIAL, OFF_GRID, SUPPORT
from myograph.ensemble.simulators import IMPORT
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.making import make_store, plan_store
from myograph.ensemble.store.opening import reasons
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.ensemble.store.rows import states
from myograph.errors import InputError, MissingPackageError, NotConvergedError
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.folder import load_tables
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.tabulate import tabulate

SEED = 0
CONTINUOUS, TESTS, HALVES, TENTHS, AT_A_STEP = "continuous", "off_grid", "halves", "tenths", 32
"""Words of the store 'steps', and the number of cases that teach at each step."""


@dataclass(frozen=True)
class Places:
    """Where things lie: the folder of the run; a store, tables and an arm of somebody else, if they are to be used."""

    out: Path
    store: Path | None = None
    tables: Path | None = None
    arm: Path | None = None


@dataclass(frozen=True)
class Data:
    """The stores by name. Raises InputError for places that hold something else."""

    arm: Arm
    preset: str
    size: Size
    places: Places
    steps: Steps
    _opened: dict[str, MuscleCases] = field(default_factory=dict)

    def path(self, name: str) -> Path:
        """Folder of a store."""
        if name == "ensemble" and self.places.store is not None:
            return self.places.store
        return self.places.out / "stores" / name

    def cases(self, name: str) -> MuscleCases:
        """The biceps in a store; simulates what is missing."""
        if name not in self._opened:
            given = name == "ensemble" and self.places.store is not None
            if not given:
                _MAKERS[name](self)
            found = read_muscle(self.path(name), MUSCLE)
            told = found.attributes.get("preset")
            if told in ("tiny", "quick", "thesis") and told != self.preset:
                raise InputError(f"{self.path(name)}: expected cases of preset '{self.preset}', got '{told}'")
            self._check_arm(name, found)
            if given:
                self._check_designs(found)
            self._opened[name] = found
        return self._opened[name]

    def _check_arm(self, name: str, cases: MuscleCases) -> None:
        """Raise InputError for cases of another arm; imported ones are of none."""
        wanted, found = arm_checksum(self.arm), cases.attributes.get("arm_checksum")
        if found not in (None, wanted) and cases.attributes.get("simulator") != IMPORT:
            raise InputError(
                f"{self.path(name)}: expected cases of the arm {wanted[:16]}, got those of {str(found)[:16]}; name "
                "their arm by --arm"
            )

    def _check_designs(self, cases: MuscleCases) -> None:
        """Raise InputError where a design that teaches or tests is not there, or is another one of its name."""
        lacking = [word for word in (FACTORIAL, SUPPORT, OFF_GRID) if not len(cases.named(word))]
        if lacking:
            raise InputError(
                f"{self.places.store}: expected cases of the designs {FACTORIAL}, {SUPPORT} and {OFF_GRID}, got none "
                f"of {', '.join(lacking)}; simulate them too, or leave out --store"
            )
        corners = cases.activation[cases.named(FACTORIAL)]
        between = (corners > 0) & (corners < 1)
        if between.any():
            raise InputError(
                f"{self.places.store}: expected activations 0 and 1 in the design {FACTORIAL}, got "
                f"{int(between.any(axis=1).sum())} cases between; simulate it with step 1"
            )
        least, found = min(self.size.taught), len(cases.named(SUPPORT))
        if found < least:
            raise InputError(
                f"{self.places.store}: expected {least} cases of the design {SUPPORT} at least, got {found}"
            )

    def numbers(self, name: str, *words: str) -> tuple[int, ...]:
        """Numbers of the cases that carry one of these words."""
        return tuple(self.cases(name).named(*words).tolist())

    @cached_property
    def tables(self) -> dict[str, MuscleTable]:
        """Of all muscles; raises NotConvergedError where a state failed."""
        if self.places.tables is not None:
            return load_tables(self.places.tables, self.arm, self.preset)
        spec = TableSpec(most_states=self.size.states, held_out=0)
        with self.steps.bars("finite elements", dict.fromkeys(self.arm.muscles, spec.most)) as advance:
            tables = tabulate(self.arm, self.preset, spec, self.tables_folder, advance)
        for table in tables.values():
            table.require_complete()
        return tables

    @property
    def tables_folder(self) -> Path:
        """Where the tables lie."""
        return self.places.tables or self.places.out / "tables"

    def from_tables(self, name: str, design: Design) -> None:
        """Fill a store by tables, or go on filling it."""
        simulator = TableArm(self.arm, self.tables)
        store = self._make(name, design, "table")
        missing = states(store, len(design.cases)).count(None)
        if missing:
            with self.steps.bars(f"equilibrium, {name}", {"cases": missing}) as advance:
                compute_here(store, simulator, lambda: advance("cases"))
        for reason in reasons(store).values():
            raise NotConvergedError(reason)

    def by_finite_elements(self, name: str, design: Design) -> None:
        """Fill a store by finite elements, or go on; cases that fail are left out, unless all do."""
        try:
            from myograph.ensemble.running.run import Listener, RunOptions, run_store
        except ModuleNotFoundError as missing:
            raise MissingPackageError(str(missing.name), "simulate", "solving cases by finite elements") from None
        assert self.tables
        store = self._make(name, design, "direct")
        missing = states(store, len(design.cases)).count(None)
        if not missing:
            return
        ready = len(design.cases) - missing
        with self.steps.bars(f"finite elements, {name}", {"cases": missing}) as advance:

            def heard(count: int) -> None:
                nonlocal ready
                for _ in range(count - ready):
                    advance("cases")
                ready = max(ready, count)

            run_store(store, RunOptions(), Listener(heard))

    def _make(self, name: str, design: Design, kind: str) -> Path:
        spec = SimulatorSpec(kind, self.preset, self.arm.model_dump_json(), str(self.tables_folder))
        plan, bodies = plan_store(design, spec, [MUSCLE])
        make_store(self.path(name), plan, bodies, {"myograph_version": myograph.__version__})
        return self.path(name)


def _ensemble(data: Data) -> None:
    specs = [
        DesignSpec(),
        DesignSpec(method="tenths", count=data.size.support, seed=SEED, label="support"),
        DesignSpec(method="latin_hypercube", count=data.size.off_grid, seed=SEED),
    ]
    data.from_tables("ensemble", make_design(specs))


def _steps(data: Data) -> None:
    specs = [
        DesignSpec(),
        DesignSpec(method="factorial", step=0.5, label=HALVES),
        DesignSpec(method="tenths", count=AT_A_STEP, seed=SEED + 1, label=TENTHS),
        DesignSpec(method="latin_hypercube", count=AT_A_STEP, seed=SEED + 1, label=CONTINUOUS),
        DesignSpec(method="latin_hypercube", count=data.size.off_grid, seed=SEED, label=TESTS),
    ]
    data.from_tables("steps", make_design(specs))


def _direct(data: Data) -> None:
    corners = make_design([DesignSpec()])
    spread = fraction(np.array([case.activations for case in corners.cases]), data.size.direct_factorial)
    inside = make_design([DesignSpec(method="latin_hypercube", count=data.size.direct_off_grid, seed=SEED)])
    cases = (*(corners.cases[number] for number in spread), *inside.cases)
    data.by_finite_elements("direct", Design(cases, ("factorial",) * len(spread) + inside.words))


def fraction(corners: Float[np.ndarray, "corners muscles"], count: int) -> list[int]:
    """Numbers of so many corners in which each muscle is as often active as not, whatever another one does.

    Fractions of the full factorial design by their words; source: Box & Hunter 1961.
    """
    kept = [number for number, own in enumerate(corners) if not any(sum(own[list(word)]) % 2 for word in WORDS[count])]
    assert len(kept) == count
    return kept


def _beside(data: Data) -> None:
    data.cases("direct")
    plan = read_plan(data.path("direct"))
    done = [case for case, state in enumerate(states(data.path("direct"), plan.size)) if state == "done"]
    cases: Sequence = plan.design.cases
    data.from_tables("beside", Design(tuple(cases[k] for k in done), tuple(plan.design.words[k] for k in done)))


WORDS: dict[int, tuple[tuple[int, ...], ...]] = {32: (), 16: ((0, 1, 2, 3, 4),), 8: ((0, 1, 3), (0, 2, 4))}
"""Number of corners -> muscles of which an even number is active in each of them."""
_MAKERS: dict[str, Callable[[Data], None]] = {
    "ensemble": _ensemble,
    "steps": _steps,
    "direct": _direct,
    "beside": _beside,
}
