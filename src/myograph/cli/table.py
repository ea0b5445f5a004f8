"""`myograph table`: build the tables of an arm's muscles, and say what is in them."""

from pathlib import Path
from typing import Annotated, Any

import typer
from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table

from myograph.anatomy.model import Arm
from myograph.case import MUSCLES, check_muscle
from myograph.cli.options import ArmFile, Json, Preset, print_json, read_arm
from myograph.cli.progress import Steps
from myograph.errors import InputError, MissingPackageError, NotConvergedError
from myograph.limb.tables.provenance import table_key
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table import MuscleTable
from myograph.limb.tables.table_file import load_table, table_path
from myograph.mesh.presets import resolution

app = typer.Typer(
    name="table",
    help="Build the sparse-grid tables of an arm's muscles, or say what is in them.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
_DEFAULT = TableSpec()


@app.command()
def build(
    preset: Preset = "quick",
    arm_file: ArmFile = None,
    out: Annotated[Path, typer.Option(help="Folder of the tables and, in it, of all solved states.")] = Path("tables"),
    tolerance_mm: Annotated[
        float, typer.Option(help="Mean distance of the nodes on the held-out states, at most.")
    ] = _DEFAULT.tolerance_mm,
    tolerance_nm: Annotated[
        float, typer.Option(help="Mean error of the moment [N·m] on the held-out states, at most.")
    ] = _DEFAULT.tolerance_nm,
    most_states: Annotated[
        int, typer.Option(help="States in a muscle's table, at most, whatever the error.")
    ] = _DEFAULT.most_states,
    muscle: Annotated[list[str] | None, typer.Option(help="Only this muscle; may be given several times.")] = None,
    json: Json = False,
) -> None:
    """Solve the muscles of an arm over elbow angle and activation, until the tables in between are good enough.

    An interrupted run goes on where it was. Exit code 3 where a state fails.
    """
    anatomy = read_arm(arm_file)
    spec = TableSpec(tolerance_mm=tolerance_mm, tolerance_nm=tolerance_nm, most_states=most_states)
    names = [check_muscle(name) for name in muscle or MUSCLES]
    resolution(preset)
    tables = build_tables(anatomy, preset, spec, out, names)
    rows = {name: describe_table(table, table_path(out, name), anatomy) for name, table in tables.items()}
    _show(rows, json)
    failed = [table for table in tables.values() if table.failures]
    if failed:
        raise NotConvergedError("\n".join(_complaint(table) for table in failed))


@app.command()
def info(
    path: Annotated[Path, typer.Argument(help="A table, or a folder of tables.")],
    arm_file: ArmFile = None,
    json: Json = False,
) -> None:
    """Say how many states a table has, how good it is, and whether it belongs to this arm."""
    anatomy = read_arm(arm_file)
    paths = [path] if not path.is_dir() else [p for name in MUSCLES if (p := table_path(path, name)).exists()]
    if not paths:
        raise InputError(f"{path}: expected tables such as biceps.npz, got none; make them with 'myograph table build'")
    tables = [(one, load_table(one)) for one in paths]
    _show({table.muscle: describe_table(table, one, anatomy) for one, table in tables}, json)


def describe_table(table: MuscleTable, path: Path, arm: Arm) -> dict[str, Any]:
    """States, errors, cost and origin of a table, as `--json` prints them."""
    solved = table.record.failures == ""
    return {
        "preset": table.preset,
        "states": table.size,
        "failed": table.failures,
        "newton_mean": float(table.record.newton_steps[solved].mean()) if solved.any() else None,
        "held_out": {"states": len(table.held_out.points), **table.held_out.summary()},
        "spec": table.spec.as_dict(),
        "met": table.met,
        "modes": {name: len(modes.vectors) for name, modes in table.modes.items()},
        "cpu_minutes": float(table.provenance["cpu_seconds"]) / 60,
        "megabytes": path.stat().st_size / 1e6,
        "belongs_to_this_arm": table.key == table_key(arm, table.muscle, table.preset, table.spec),
        "provenance": dict(table.provenance),
        "path": str(path),
    }


def build_tables(arm: Arm, preset: str, spec: TableSpec, out: Path, names: list[str]) -> dict[str, MuscleTable]:
    """Tables of muscles in a folder, with progress; raises MissingPackageError without finite elements."""
    try:
        import myograph.mechanics.muscle  # noqa: F401
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "simulate", "building tables") from None
    from myograph.limb.tables.tabulate import tabulate

    with Steps().bars("states, at most", dict.fromkeys(names, spec.most)) as advance:
        return tabulate(arm, preset, spec, out, advance, names)


def _show(rows: dict[str, dict[str, Any]], json: bool) -> None:
    if json:
        print_json({"tables": rows})
        return
    table = Table(box=SIMPLE, show_edge=False, padding=(0, 1, 0, 0))
    table.add_column("muscle", no_wrap=True)
    for name in ("preset", "states", "failed", "Newton", "mean mm", "max mm", "mean N·m", "max N·m", "CPU min", "MB"):
        table.add_column(name, justify="right", no_wrap=True)
    for name in ("met", "this arm"):
        table.add_column(name, justify="center", no_wrap=True)
    for name, row in rows.items():
        errors = row["held_out"]
        cells = (
            row["preset"],
            str(row["states"]),
            str(row["failed"]),
            _number(row["newton_mean"], 1),
            *(_number(errors[key], 3) for key in ("mean_mm", "max_mm", "moment_mean_nm", "moment_max_nm")),
            _number(row["cpu_minutes"], 1),
            _number(row["megabytes"], 1),
            {True: "yes", False: "NO", None: "not measured"}[row["met"]],
            "yes" if row["belongs_to_this_arm"] else "NO",
        )
        table.add_row(name, *cells)
    Console(width=140).print(table)
    for name, row in rows.items():
        if row["met"] is False and not row["failed"]:
            typer.echo(f"{name}: {_unmet(row)}")


def _number(value: float | None, digits: int) -> str:
    return "–" if value is None else f"{value:.{digits}f}"


def _unmet(row: dict[str, Any]) -> str:
    asked, errors = row["spec"], row["held_out"]
    return (
        f"asked for {asked['tolerance_mm']:g} mm and {asked['tolerance_nm']:g} N·m in the mean, got"
        f" {_number(errors['mean_mm'], 3)} mm and {_number(errors['moment_mean_nm'], 3)} N·m with {row['states']}"
        " states; allow more with --most-states"
    )


def _complaint(table: MuscleTable) -> str:
    try:
        table.require_complete()
    except NotConvergedError as failure:
        return str(failure)
    return ""
