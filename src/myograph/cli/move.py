"""`myograph move`: a movement from activations over time."""

from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from myograph.cli.limb_source import Asked, Gravity, LimbFile, LimbSource, Tables, read_source
from myograph.cli.options import ArmFile, Json, print_json
from myograph.errors import InputError
from myograph.limb.motion.activation_file import Activations, read_activations
from myograph.limb.motion.movement import Movement, save_movement
from myograph.units import degrees, newton_metres


def move(
    file: Annotated[Path, typer.Argument(help="Activations over time: CSV, or OpenSim's .sto.")],
    dynamic: Annotated[
        bool, typer.Option("--dynamic", help="Forward dynamics; without it the arm is at rest at every time.")
    ] = False,
    load: Annotated[float, typer.Option(help="Weight in the hand [N].")] = 0.0,
    step: Annotated[float, typer.Option(help="Longest time between two rows of the result [s].")] = 0.01,
    renamed: Annotated[
        list[str] | None,
        typer.Option("--map", help="Column=muscle for other names; 'column=' leaves it out; may be repeated."),
    ] = None,
    tables: Tables = None,
    limb_file: LimbFile = None,
    arm_file: ArmFile = None,
    gravity: Gravity = True,
    out: Annotated[Path, typer.Option(help="Folder for movement.csv and the pictures.")] = Path("movement"),
    json: Json = False,
) -> None:
    """Move the arm by activations over time; write angles, moments and activations, and draw them."""
    source = read_source(Asked(tables, limb_file, arm_file, gravity))
    given = read_activations(file, source.limb.names, _names(renamed or [])).every(step)
    movement = _moved(source, given, load, dynamic)
    save_movement(movement, out / "movement.csv")
    pictures = _draw(source, movement, out)
    row = describe_movement(movement)
    if json:
        print_json({"limb": source.name, **row, "out": str(out / "movement.csv"), "pictures": pictures})
        return
    low, high = row["angle_deg"]["least"], row["angle_deg"]["largest"]
    typer.echo(
        f"{source.name}, {movement.kind}, {row['times']} times to {row['end_s']:g} s with {load:g} N in the hand\n"
        f"  elbow from {row['angle_deg']['first']:.1f} to {row['angle_deg']['last']:.1f} degrees,"
        f" between {low:.1f} and {high:.1f}"
    )
    for note in movement.notes:
        typer.echo(f"  note: {note}")
    typer.echo(f"  {out / 'movement.csv'}" + "".join(f", {picture}" for picture in pictures))


def describe_movement(movement: Movement) -> dict[str, Any]:
    """What `--json` prints of it; the series themselves are in the CSV file."""
    angles = np.degrees(movement.angles)
    return {
        "kind": movement.kind,
        "hand_load_n": movement.hand_load,
        "muscles": list(movement.muscles),
        "times": len(movement.times),
        "start_s": float(movement.times[0]),
        "end_s": float(movement.times[-1]),
        "angle_deg": {
            "first": float(angles[0]),
            "last": float(angles[-1]),
            "least": float(angles.min()),
            "largest": float(angles.max()),
        },
        "fastest_deg_s": degrees(float(np.abs(movement.velocities).max())),
        "largest_moment_nm": {
            name: newton_metres(float(column[np.abs(column).argmax()]))
            for name, column in zip(movement.muscles, movement.muscle_moments.T, strict=True)
        },
        "notes": list(movement.notes),
    }


def _names(pairs: list[str]) -> dict[str, str]:
    for pair in pairs:
        if "=" not in pair:
            raise InputError(f"--map: expected column=muscle, got '{pair}'")
    return {column: muscle for column, _, muscle in (pair.rpartition("=") for pair in pairs)}


def _moved(source: LimbSource, given: Activations, load: float, dynamic: bool) -> Movement:
    from myograph.limb.motion.dynamics import mechanism, move, rest_at
    from myograph.limb.motion.quasi_static import follow_equilibria

    if not dynamic:
        return follow_equilibria(source.limb, given, load, source.near)
    if source.dynamics is None or source.load is None:
        raise InputError(
            f"{source.name}: expected a table [dynamics] and a forearm's mass for --dynamic, got none; see docs/limb.md"
        )
    moving = mechanism(source.dynamics, source.load, load)
    return move(source.limb, given, load, moving, rest_at(source.limb, given, load, source.near))


def _draw(source: LimbSource, movement: Movement, out: Path) -> list[str]:
    """The pictures that can be made; none where matplotlib is missing."""
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        typer.echo("myograph: no pictures without matplotlib: pip install 'myograph[view]'", err=True)
        return []
    from myograph.cli.limb_pictures import draw_all

    return draw_all(source, movement, out)
