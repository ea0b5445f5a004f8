"""`myograph solve`: one muscle by finite elements at a given activation and angle."""

import time
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from myograph.case import check_activation, check_muscle
from myograph.cli.options import ArmFile, Json, Preset, print_json, read_arm
from myograph.errors import MissingPackageError
from myograph.files import write_whole
from myograph.units import degrees, newton_metres, radians


def solve(
    muscle: Annotated[str, typer.Option(help="Which muscle, such as biceps.")],
    activation: Annotated[float, typer.Option(help="From 0 to 1.")],
    angle: Annotated[float, typer.Option(help="Elbow flexion in degrees; 0 is straight.")],
    preset: Preset = "tiny",
    arm_file: ArmFile = None,
    out: Annotated[Path | None, typer.Option(help="Write all node fields to this .npz file.")] = None,
    json: Json = False,
) -> None:
    """Solve one muscle by finite elements and say its moment and its stress."""
    check_muscle(muscle)
    check_activation(activation, muscle)
    started = time.perf_counter()
    state = _solve(muscle, activation, radians(angle), (preset, arm_file))
    result = {
        "muscle": muscle,
        "activation": activation,
        "angle_deg": round(degrees(state.angle), 9),
        "moment_nm": newton_metres(state.moment),
        "von_mises_mean_mpa": float(state.fields["von_mises"].mean()),
        "von_mises_max_mpa": float(state.fields["von_mises"].max()),
        "fibre_stretch_min": float(state.fields["fibre_stretch"].min()),
        "fibre_stretch_max": float(state.fields["fibre_stretch"].max()),
        "volume_change": state.soundness.volume_change,
        "smallest_jacobian": state.soundness.smallest_jacobian,
        "penetration_mm": state.soundness.penetration,
        "obstacle": state.soundness.obstacle,
        "newton_steps": state.newton_steps,
        "nodes": len(state.fields["position"]),
        "seconds": time.perf_counter() - started,
        "out": None if out is None else str(out),
    }
    if out is not None:
        write_whole(out, lambda file: np.savez(file, allow_pickle=False, **state.fields))
    if json:
        print_json(result)
        return
    stress = f"{result['von_mises_mean_mpa']:8.3f} MPa mean, {result['von_mises_max_mpa']:.3f} at most"
    size = f"{result['nodes']} nodes, {result['seconds']:.1f} s"
    typer.echo(
        f"{muscle} at activation {activation:g}, {angle:g} degrees ({size})\n"
        f"  moment about the elbow  {result['moment_nm']:8.3f} N·m (positive flexes)\n"
        f"  von Mises stress        {stress}\n"
        f"  fibre stretch           {result['fibre_stretch_min']:8.3f} to {result['fibre_stretch_max']:.3f}\n"
        f"  volume changed by       {result['volume_change']:8.1e}, smallest J {result['smallest_jacobian']:.2f}\n"
        f"  depth in a bone         {max(result['penetration_mm'], 0.0):8.2f} mm, nearest: {result['obstacle']}"
    )
    if out is not None:
        typer.echo(f"  fields                  {out}")


def _solve(muscle: str, activation: float, angle: float, made_of: tuple[str, Path | None]) -> Any:
    preset, arm_file = made_of
    anatomy = read_arm(arm_file)
    try:
        from myograph.mechanics.muscle import FiniteElementMuscle
    except ModuleNotFoundError as missing:
        raise MissingPackageError(str(missing.name), "simulate", "solving a muscle") from None
    return FiniteElementMuscle(anatomy, muscle, preset).solve(activation, angle)
