"""How sound a solved state is: volume kept, elements right side out, nothing inside a bone."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import ATTACHED, Arm, Bone
from myograph.errors import InputError
from myograph.mechanics.newton import smallest_volume_ratio
from myograph.mechanics.problem import MuscleProblem

_CLEAR = 0.05
"""Depth [mm] up to which a body counts as clear of its obstacles at the start."""


@dataclass(frozen=True)
class Soundness:
    """Of one state.

    Parameters
    ----------
    volume_change
        Volume of the whole muscle over that of its reference body, minus 1.
    smallest_jacobian
        Smallest J = det F over all integration points.
    penetration, obstacle
        Largest depth [mm] of a node of the skin inside a bone or the pulley, attached ends apart, and in which;
        negative: the smallest gap.
    """

    volume_change: float
    smallest_jacobian: float
    penetration: float
    obstacle: str


def soundness(problem: MuscleProblem, vector: Float[np.ndarray, " unknowns"], flexion: float) -> Soundness:
    """Of a solved state at a flexion [rad] from the reference pose."""
    positions = problem.positions(vector)
    depths = _depths(problem, positions, flexion, tuple(problem.arm.bones))
    obstacle = max(depths, key=lambda name: depths[name].max())
    return Soundness(
        volume_change=problem.mesh.volume(positions) / problem.mesh.volume() - 1,
        smallest_jacobian=smallest_volume_ratio(problem, vector),
        penetration=float(depths[obstacle].max()),
        obstacle=obstacle,
    )


def depths_in_obstacles(
    problem: MuscleProblem, vector: Float[np.ndarray, " unknowns"], flexion: float
) -> dict[str, float]:
    """Largest depth [mm] of a node of the free skin inside each obstacle that pushes the muscle."""
    depths = _depths(problem, problem.positions(vector), flexion, problem.muscle.contact.bones)
    return {name: float(depth.max()) for name, depth in depths.items()}


def check_clear(problem: MuscleProblem) -> None:
    """Raise InputError where the reference body starts inside one of the obstacles that push it."""
    points = problem.mesh.points
    for obstacle, depth in _depths(problem, points, 0.0, problem.muscle.contact.bones).items():
        worst = int(np.argmax(depth))
        if depth[worst] > _CLEAR:
            place = points[_free_skin(problem)][worst].round(1).tolist()
            raise InputError(
                f"{problem.name}: its skin starts {depth[worst]:.2f} mm inside the {obstacle}, at {place} mm; expected"
                f" it outside: raise bow or bow_lateral, make the sections there smaller, or take the {obstacle} out of"
                " contact"
            )


def _depths(
    problem: MuscleProblem, positions: Float[np.ndarray, "nodes 3"], flexion: float, bones: tuple[str, ...]
) -> dict[str, Float[np.ndarray, " skin"]]:
    """Depth of the free skin's nodes inside each obstacle [mm], negative outside."""
    arm, hinge, points = problem.arm, problem.hinge, positions[_free_skin(problem)]
    depths = {name: _depth(arm, arm.bones[name], points, flexion) for name in bones}
    if problem.muscle.contact.pulley > 0:
        depths["pulley"] = problem.muscle.contact.pulley - np.linalg.norm(hinge.to_plane(points)[:, :2], axis=1)
    return depths


def _free_skin(problem: MuscleProblem) -> np.ndarray:
    skin = np.unique(problem.mesh.skin)
    along = problem.mesh.along[skin]
    return skin[(along >= ATTACHED) & (along <= 1 - ATTACHED)]


def _depth(arm: Arm, bone: Bone, points: Float[np.ndarray, "skin 3"], flexion: float) -> Float[np.ndarray, " skin"]:
    ends = np.array([bone.start, bone.end])
    start, end = arm.hinge.frame().flex(ends, flexion) if bone.moves_with == "forearm" else ends
    share = np.clip((points - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
    return bone.radius - np.linalg.norm(points - start - share[:, None] * (end - start), axis=1)
