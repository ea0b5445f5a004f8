"""Pictures of a limb and its movement."""

from pathlib import Path

import numpy as np
from jaxtyping import Float

from myograph.cli.arm import bone_surfaces
from myograph.cli.limb_source import LimbSource
from myograph.errors import InputError
from myograph.files import write_whole
from myograph.limb.limb import Limb
from myograph.limb.motion.movement import Movement
from myograph.limb.table_arm import TableArm
from myograph.mesh.presets import preset_mesh
from myograph.mesh.tissue import tendon_share
from myograph.units import NEWTON_MM_PER_NEWTON_METRE
from myograph.view import Surface, draw_equilibria, draw_film, draw_moments, draw_movement
from myograph.view.palette import MUSCLE_COLOURS

STATES = 5
"""Of a film strip."""
LEVELS = 21
"""Activations of each group in the picture of equilibria."""


def draw_all(source: LimbSource, movement: Movement, out: Path) -> list[str]:
    """Write all pictures that this limb allows; return their paths."""
    pictures = {"movement.png": movement_picture(movement), "moments.png": moments_picture(source.limb)}
    surface = equilibria_picture(source.limb, movement.hand_load, source.near)
    if surface is not None:
        pictures["equilibria.png"] = surface
    if source.arm is not None:
        pictures["film.png"] = film_picture(source.arm, movement)
    for name, data in pictures.items():
        write_whole(out / name, lambda file, data=data: file.write(data))
    return [str(out / name) for name in pictures]


def movement_picture(movement: Movement) -> bytes:
    """PNG of angle, activations and moments over time."""
    names, in_nm = movement.muscles, 1 / NEWTON_MM_PER_NEWTON_METRE
    excitations = dict(zip(names, movement.excitations.T, strict=True)) if movement.kind == "dynamic" else None
    return draw_movement(
        movement.times,
        np.degrees(movement.angles),
        dict(zip(names, movement.activations.T, strict=True)),
        dict(zip(names, in_nm * movement.muscle_moments.T, strict=True)),
        in_nm * movement.outside_moments,
        excitations,
    )


def moments_picture(limb: Limb) -> bytes:
    """PNG of each muscle's moment over the angle at three activations."""
    angles = np.linspace(limb.low, limb.high, 101)
    return draw_moments(
        np.degrees(angles),
        {
            name: {level: muscle.moment(angles, level) / NEWTON_MM_PER_NEWTON_METRE for level in (0.0, 0.5, 1.0)}
            for name, muscle in limb.muscles.items()
        },
    )


def equilibria_picture(limb: Limb, hand_load: float, near: float) -> bytes | None:
    """PNG of the angle at rest over the activations of all flexors and all extensors; None where one group is empty."""
    angles = np.linspace(limb.low, limb.high, 21)
    flexes = np.array([muscle.moment(angles, 1.0).mean() > 0 for muscle in limb.muscles.values()])
    if flexes.all() or not flexes.any():
        return None
    levels = np.linspace(0, 1, LEVELS)
    rests = np.full((LEVELS, LEVELS), np.nan)
    for k, flexors in enumerate(levels):
        for j, extensors in enumerate(levels):
            try:
                rest = limb.rest(np.where(flexes, flexors, extensors).tolist(), hand_load, near)
            except InputError:
                continue
            rests[k, j] = np.degrees(rest.angle)
    return draw_equilibria(levels, levels, rests) if np.isfinite(rests).any() else None


def film_picture(arm: TableArm, movement: Movement) -> bytes:
    """PNG of states of the arm, equally far apart in time."""
    chosen = np.unique(np.linspace(0, len(movement.times) - 1, STATES).astype(int)).tolist()
    tendons = {name: _tendon(arm, name) for name in arm.tables}
    states, titles = [], []
    for k in chosen:
        solution = arm(movement.case(k))
        muscles = [
            Surface(solution.fields[name]["position"], arm.tables[name].skin, name, MUSCLE_COLOURS[name], tendon)
            for name, tendon in tendons.items()
        ]
        states.append([*bone_surfaces(arm.arm, solution.elbow_angle - arm.arm.reference_angle), *muscles])
        titles.append(f"{movement.times[k]:.2f} s, {np.degrees(solution.elbow_angle):.0f}°")
    return draw_film(states, titles)


def _tendon(arm: TableArm, name: str) -> Float[np.ndarray, " nodes"]:
    """Fraction of tendon at each node of a muscle's table."""
    return tendon_share(arm.arm, name, preset_mesh(arm.arm, name, arm.tables[name].preset))
