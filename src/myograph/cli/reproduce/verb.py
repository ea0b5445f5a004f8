"""The verb `reproduce`, and the same as a function."""

import hashlib
import json
import os
import shlex
import time
from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from myograph.anatomy.load import arm_checksum
from myograph.anatomy.model import Arm
from myograph.cli.options import ArmFile, Json, Preset, print_json, read_arm
from myograph.cli.progress import Steps
from myograph.cli.reproduce.sizes import reproduction_size
from myograph.errors import InputError, MissingPackageError

if TYPE_CHECKING:
    from myograph.cli.reproduce.data import Places
    from myograph.cli.reproduce.runner import Runner
    from myograph.cli.reproduce.shelf import Shelf

_NEEDED = ("torch", "lightning_fabric", "sklearn", "matplotlib")
_SIMULATING = {"steps", "direct"}
"""Sections that have cases of their own, whatever store is given."""
_VERSIONS = ("myograph", "ngsolve", "torch", "torch-geometric", "scikit-learn", "numpy", "scipy")

Sections = Annotated[
    list[str] | None,
    typer.Option(
        help="Only this section, several times for more: 6.2.1, 6.2.2, 6.2.3, 6.2.4, meshes, sensors, steps, direct, "
        "convolutions, edge."
    ),
]


def reproduce(
    section: Sections = None,
    preset: Preset = "quick",
    out: Annotated[Path, typer.Option(help="Folder for simulations, results and the report.")] = Path(
        "myograph-reproduce"
    ),
    store: Annotated[
        Path | None,
        typer.Option(help="Store of cases to use instead of simulating: with 'factorial', 'support', 'off_grid'."),
    ] = None,
    tables: Annotated[Path | None, typer.Option(help="Folder of tables to use instead of solving them.")] = None,
    arm_file: ArmFile = None,
    json: Json = False,
) -> None:
    """The thesis's experiments, chapter 6, and the questions it left open: from simulation to one report.

    What was simulated, trained or drawn is kept in the folder and used again: a run that was interrupted goes on where
    it was, and sections made earlier stay in the report.
    """
    from myograph.cli.reproduce.data import Places

    places = Places(out, store, tables, arm_file)
    result = run_reproduction(read_arm(arm_file), preset, section or [], places, Steps())
    if json:
        print_json(result)
        return
    for name, made in result["sections"].items():
        typer.echo(f"{name:14} {len(made['rows']):4} rows  {made['seconds']:8.0f} s of training")
    typer.echo(f"report: {result['report']}")


def run_reproduction(arm: Arm, preset: str, sections: list[str], places: "Places", steps: Steps) -> dict[str, Any]:
    """Make the sections, all where none is named; return what `--json` prints.

    Raises InputError for an unknown section or preset, and for a folder that cannot be used.
    """
    from myograph.cli.reproduce.cache import Cache
    from myograph.cli.reproduce.data import Data
    from myograph.cli.reproduce.planning import plan
    from myograph.cli.reproduce.registry import EXPERIMENTS, check_sections
    from myograph.cli.reproduce.runner import Runner
    from myograph.cli.reproduce.shelf import REPORT, Shelf
    from myograph.evaluation.experiments.page import write_chapter

    size, wanted = reproduction_size(preset), check_sections(sections or list(EXPERIMENTS))
    tabulated = places.tables is None and bool(places.store is None or _SIMULATING & set(wanted))
    _check_installed(places, tabulated or "direct" in wanted)
    shelf = Shelf(places.out, preset)
    shelf.prepare()
    cache = Cache(places.out / "cache")
    if cache.prepare():
        steps.console.print("the cache is of another version of myograph: it is made anew")
    data = Data(arm, preset, size, places, steps)
    if places.store is not None:
        data.cases("ensemble")
    steps.console.print(plan(preset, wanted, tabulated))
    runner, made_with = Runner(data, cache, steps), _made_with(arm)
    told = {"preset": preset, "training steps": size.trained, "size": size.checksum}
    provenance = {"last command": _command(sections, preset, places), **told, **made_with}
    for name in wanted:
        _make(name, runner, shelf, made_with)
        shelf.write_results(provenance)
        write_chapter(f"Chapter 6 again, preset {preset}", shelf.all(provenance), provenance, places.out / REPORT)
    made = {name: shelf.get(name) for name in wanted}
    found = {name: {"rows": list(own.rows), "seconds": own.seconds} for name, own in made.items() if own is not None}
    return {"sections": found, "report": str(places.out / REPORT)}


def _make(name: str, runner: "Runner", shelf: "Shelf", made_with: Mapping[str, str]) -> None:
    """One section, unless it lies there already with all that can be had."""
    from myograph.cli.reproduce.outcome import finished, rounded
    from myograph.cli.reproduce.registry import EXPERIMENTS
    from myograph.evaluation.experiments.page import Made

    started = time.monotonic()
    experiment, data = EXPERIMENTS[name], runner.data
    trials = experiment.trials(data, data.size)
    told = [[trial.name for trial in trials], runner.keys(trials)]
    key = hashlib.sha256(json.dumps(told).encode()).hexdigest()
    kept = shelf.get(name, key)
    if kept is not None and finished(trials, kept.rows):
        return
    outcome = runner.run(name, trials)
    with runner.steps.timed(f"figures of {name}"):
        figures = experiment.figures(outcome)
    stores = sorted({store for trial in trials for store in (trial.cases.store, trial.cases.truth) if store})
    provenance = {
        "command": _command([name], data.preset, data.places),
        "seeds": ", ".join(map(str, sorted({trial.seed for trial in trials}))),
        "data": ", ".join(f"{store} {data.cases(store).checksum[:16]}" for store in stores),
        "time taken": outcome.taken(time.monotonic() - started),
        **made_with,
    }
    shelf.put(name, key, Made(experiment.rows(outcome), figures, rounded(outcome.seconds), provenance))


def _command(sections: Sequence[str], preset: str, places: "Places") -> str:
    """What makes the sections again, in a new folder; of a path the last part is told."""
    asked = [part for name in sections for part in ("--section", name)]
    options = {"--store": places.store, "--tables": places.tables, "--arm": places.arm}
    given = [part for option, path in options.items() if path is not None for part in (option, path.absolute().name)]
    return shlex.join(["myograph", "reproduce", *asked, "--preset", preset, *given])


def _made_with(arm: Arm) -> dict[str, str]:
    """Arm, machine and versions of this run."""
    found = []
    for package in _VERSIONS:
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            continue
    load = f", {os.getloadavg()[0]:.0f} jobs at once as it began" if hasattr(os, "getloadavg") else ""
    machine = f"{os.cpu_count()} processors{load}"
    return {"arm": arm_checksum(arm), "machine": machine, "versions": ", ".join(found)}


def _check_installed(places: "Places", solved: bool) -> None:
    """Raise InputError for what lacks; `solved` says whether finite elements are needed."""
    for package in _NEEDED:
        if find_spec(package) is None:
            raise MissingPackageError(package, "all", "the reproduction")
    if solved and find_spec("ngsolve") is None:
        raise MissingPackageError("ngsolve", "all", "simulating the cases")
    for path in (places.store, places.tables):
        if path is not None and not path.is_dir():
            raise InputError(f"{path}: expected a folder, found none")
