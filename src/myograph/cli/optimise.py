"""`myograph optimise`: activations that hold a target angle."""

from typing import Annotated, Any

import typer

from myograph.cli.limb_source import Asked, Gravity, LimbFile, Tables, read_source
from myograph.cli.options import ArmFile, Json, print_json
from myograph.errors import InputError
from myograph.limb.limb import Limb
from myograph.limb.optimise import Optimum, Target
from myograph.units import degrees, newton_metres, radians


def optimise(
    angle: Annotated[float, typer.Option(help="Elbow flexion to hold, in degrees.")],
    load: Annotated[float, typer.Option(help="Weight in the hand [N].")] = 0.0,
    previous: Annotated[
        str | None,
        typer.Option("--from", help="Activations before, such as 0,0.5: the smallest change; else the least sum."),
    ] = None,
    tables: Tables = None,
    limb_file: LimbFile = None,
    arm_file: ArmFile = None,
    gravity: Gravity = True,
    json: Json = False,
) -> None:
    """Find the least activations, or the smallest change of activations, that hold an angle under a load."""
    from myograph.limb.optimise import optimise as least

    source = read_source(Asked(tables, limb_file, arm_file, gravity))
    before = None if previous is None else _activations(previous, source.limb)
    found = least(source.limb, Target(radians(angle), load, before))
    row = describe_optimum(found)
    if json:
        print_json({"limb": source.name, **row})
        return
    typer.echo(f"{source.name} at {angle:g} degrees with {load:g} N in the hand")
    for name, activation in row["activations"].items():
        typer.echo(f"  {name:16} {activation:6.3f}   moves the elbow by {row['degrees_per_tenth'][name]:6.2f}° per 0.1")
    what = "sum of activations" if before is None else "change of activations"
    typer.echo(f"  {what} {row['cost']:.4f}, left over {row['imbalance_nm']:.1e} N·m")
    for note in found.notes:
        typer.echo(f"  note: {note}")


def describe_optimum(found: Optimum) -> dict[str, Any]:
    """What `--json` prints of it."""
    by_name = dict(zip(found.muscles, found.sensitivity, strict=True))
    return {
        "angle_deg": round(degrees(found.target.angle), 9),
        "hand_load_n": found.target.hand_load,
        "objective": "least sum" if found.target.previous is None else "smallest change",
        "activations": dict(zip(found.muscles, found.activations, strict=True)),
        "cost": found.cost,
        "imbalance_nm": newton_metres(found.imbalance),
        "stable": found.stable,
        "degrees_per_tenth": {name: degrees(value) / 10 for name, value in by_name.items()},
        "notes": list(found.notes),
    }


def _activations(text: str, limb: Limb) -> tuple[float, ...]:
    try:
        values = tuple(float(part) for part in text.split(","))
    except ValueError:
        raise InputError(
            f"--from: expected numbers with commas between ({','.join(limb.names)}), got '{text}'"
        ) from None
    return limb.check(values, 0.0)
