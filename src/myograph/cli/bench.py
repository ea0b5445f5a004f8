"""`myograph bench`: speed and accuracy as ratios within one run."""

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from myograph.case import MUSCLES
from myograph.cli.bench_learn import learn
from myograph.cli.limb_source import read_table_arm
from myograph.cli.options import ArmFile, Json, print_json
from myograph.cli.progress import Steps
from myograph.errors import MissingPackageError, NotConvergedError
from myograph.limb.judgement import Judgement, judge, random_cases, seconds_per_case
from myograph.limb.table_arm import TableArm
from myograph.units import degrees

app = typer.Typer(
    name="bench",
    help="Speed and accuracy, as ratios within one run.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
_TIMED = 1000
"""Cases that the tables are timed on."""


@app.callback()
def _bench() -> None:
    """Speed and accuracy, as ratios within one run."""


app.command()(learn)


@app.command()
def limb(
    tables: Annotated[Path, typer.Option(help="Folder of the arm's tables, from 'myograph table build'.")] = Path(
        "tables"
    ),
    arm_file: ArmFile = None,
    cases: Annotated[int, typer.Option(help="Random activations solved by finite elements too.")] = 10,
    seed: Annotated[int, typer.Option(help="Of the activations.")] = 0,
    json: Json = False,
) -> None:
    """Set an arm's tables beside finite elements at random equilibria: milliseconds, and errors in mm and degrees."""
    arm = read_table_arm(tables, arm_file, gravity=True)
    result = _judged(arm, tables, cases, seed)
    if json:
        print_json(result)
        return
    node = result["node_mm"]
    typer.echo(
        f"{result['cases']} random equilibria, {result['preset']} meshes, {result['failed']} failed\n"
        f"  tables           {result['table_ms']:10.3f} ms for the equilibrium and all nodes of the biceps\n"
        f"  finite elements  {result['direct_ms']:10.0f} ms for all five muscles at the equilibrium\n"
        f"  ratio            {result['speedup']:10.0f}\n"
        f"  angle            {result['angle_deg']['mean']:10.4f} degrees apart in the mean,"
        f" {result['angle_deg']['max']:.4f} at most\n"
        f"  nodes            {node['mean']:10.4f} mm apart in the mean, {node['max']:.3f} at most"
    )
    for name, row in result["muscles"].items():
        typer.echo(f"    {name:16} {row['mean']:8.4f} mm in the mean, {row['max']:.3f} at most")


def _judged(arm: TableArm, folder: Path, count: int, seed: int) -> dict[str, Any]:
    chosen, preset = random_cases(count, seed), arm.tables[MUSCLES[0]].preset
    table_ms = 1000 * seconds_per_case(arm, random_cases(_TIMED, seed))
    try:
        from myograph.limb.direct_arm import DirectArm
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "simulate", "finite elements") from None
    rows: list[Judgement] = []
    steps = Steps()
    with steps.bars("finite elements", {"cases": count}) as advance:
        direct = DirectArm.beside_tables(folder, arm.arm, arm.tables, preset, gravity=arm.gravity)
        for row in judge(arm, direct, chosen):
            rows.append(row)
            advance("cases")
    solved = [row for row in rows if not row.failure]
    if not solved:
        raise NotConvergedError(f"none of {count} cases was solved; the first: {rows[0].failure}")
    angles = np.abs([row.angle_error for row in solved])
    errors = np.array([[row.node_errors[name] for name in MUSCLES] for row in solved])
    direct_ms = 1000 * float(np.median([row.seconds for row in solved]))
    return {
        "preset": preset,
        "cases": count,
        "failed": len(rows) - len(solved),
        "failures": [row.failure for row in rows if row.failure],
        "table_ms": table_ms,
        "direct_ms": direct_ms,
        "speedup": direct_ms / table_ms,
        "angle_deg": {"mean": degrees(float(angles.mean())), "max": degrees(float(angles.max()))},
        "node_mm": {"mean": float(errors[..., 0].mean()), "max": float(errors[..., 1].max())},
        "muscles": {
            name: {"mean": float(errors[:, k, 0].mean()), "max": float(errors[:, k, 1].max())}
            for k, name in enumerate(MUSCLES)
        },
    }
