"""`myograph ensemble run` and `resume`: from a design to a full store; running again goes on."""

import shlex
import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Any

import typer

import myograph
from myograph.case import MUSCLES
from myograph.cli.ensemble.asked import Angle, Count, DesignMethod, File, Level, Load, Seed, Step, asked_design
from myograph.cli.ensemble.compute import (
    Again,
    Scheduler,
    Slurm,
    Tables,
    TimeLimit,
    Where,
    Workers,
    compute,
    run_options,
    tell,
)
from myograph.cli.ensemble.tables import tables_ready
from myograph.cli.options import ArmFile, Json, read_arm
from myograph.config import parse
from myograph.ensemble.config import EnsembleConfig, read_config
from myograph.ensemble.design import make_design
from myograph.ensemble.simulators import BUILT_IN
from myograph.ensemble.spec import SimulatorSpec
from myograph.ensemble.store.making import make_store, plan_at, plan_store, require_muscles
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.tables import simulator_of
from myograph.errors import InputError


def run(
    out: Annotated[Path, typer.Option(help="Folder of the store; one that is there already is gone on with.")],
    config: Annotated[Path | None, typer.Argument(help="TOML file of the ensemble.")] = None,
    design: DesignMethod = None,
    step: Step = None,
    count: Count = None,
    seed: Seed = None,
    level: Level = None,
    cases: File = None,
    load_n: Load = None,
    angle_deg: Angle = None,
    simulator: Annotated[str | None, typer.Option(help="table, direct, or package.module:function.")] = None,
    preset: Annotated[str | None, typer.Option(help="Size: tiny, quick or thesis.")] = None,
    muscle: Annotated[list[str] | None, typer.Option(help="Store only this muscle; several times for more.")] = None,
    tables: Annotated[
        Path | None,
        typer.Option(help="Folder of the arm's tables: built there if missing; for 'direct' where its searches begin."),
    ] = None,
    arm_file: ArmFile = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    slurm: Slurm = None,
    time_limit: TimeLimit = None,
    retry_failed: Again = False,
    json: Json = False,
) -> None:
    """Compute all cases of a design; run it again to go on after an interrupt.

    A case that fails is stored with its reason; the others go on.
    """
    numbers = {"step": step, "count": count, "seed": seed, "level": level, "file": cases}
    chosen = asked_design({"method": design, **numbers, "hand_load_n": load_n, "elbow_angle_deg": angle_deg})
    options = {"simulator": simulator, "preset": preset, "muscles": muscle and tuple(muscle), "arm": arm_file}
    given: dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    if config is not None and (chosen is not None or given):
        raise InputError(f"expected either {config} or options of the design and the simulator, got both")
    if chosen is not None:
        given["design"] = (chosen,)
    asked = read_config(config) if config else parse(given, EnsembleConfig, "ensemble")
    limit = time_limit if time_limit is not None else asked.run.time_limit_s
    own = workers if workers is not None else asked.run.workers
    options = run_options(Where(own, scheduler, slurm, limit, retry_failed))
    folder = _make(asked, tables or asked.tables, out)
    tell(compute(out, replace(options, tables=folder)), json)


def resume(
    store: Annotated[Path, typer.Argument(help="Folder of the store.")],
    workers: Workers = None,
    scheduler: Scheduler = None,
    slurm: Slurm = None,
    time_limit: TimeLimit = None,
    retry_failed: Again = False,
    tables: Tables = None,
    json: Json = False,
) -> None:
    """Compute what is missing in a store."""
    read_plan(store)
    where = Where(workers, scheduler, slurm, time_limit, retry_failed, tables)
    tell(compute(store, run_options(where)), json)


def _make(asked: EnsembleConfig, tables: Path | None, out: Path) -> Path | None:
    """Make the store, and before that the tables, if the simulator needs them; where these lie.

    What can be refused is refused before any table is built.
    """
    design, arm, there = make_design(asked.design), read_arm(asked.arm), plan_at(out)
    if there is not None and there.simulator.kind != asked.simulator:
        made_with = f"holds answers of '{there.simulator.kind}', asked for '{asked.simulator}'"
        raise InputError(f"{out}: {made_with}; take another folder, or run it with what it was made with")
    if asked.simulator in BUILT_IN:
        require_muscles(asked.muscles, MUSCLES)
    folder = tables if asked.simulator in BUILT_IN else None
    if asked.simulator == "table" and there is None:
        folder = tables or out.resolve().with_name(f"tables-{asked.preset}")
        tables_ready(arm, asked.preset, folder)
    elif asked.simulator == "table" and there is not None:
        known = simulator_of(out, there, tables).tables
        folder = Path(known) if known else None
    place = None if folder is None else str(folder.resolve())
    spec = SimulatorSpec(asked.simulator, asked.preset, arm.model_dump_json(), place, asked.gravity)
    plan, bodies = plan_store(design, spec, asked.muscles)
    make_store(out, plan, bodies, _provenance())
    return folder


def _provenance() -> dict[str, str]:
    packages = ("numpy", "scipy", "xarray", "zarr", "numcodecs")
    return {
        "command": shlex.join(sys.argv),
        "myograph_version": myograph.__version__,
        **{f"{package}_version": version(package) for package in packages},
    }
