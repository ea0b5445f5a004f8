"""From the description of a muscle to the body that is meshed, and to its line of action."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.integrate import trapezoid
from scipy.interpolate import CubicSpline

from myograph.anatomy.hinge import Hinge
from myograph.anatomy.model import Arm, Muscle
from myograph.anatomy.path import LineOfAction


def line_of_action(muscle: Muscle, hinge: Hinge) -> LineOfAction:
    """The part of the muscle's line that changes length with flexion, in the plane of the hinge."""
    moving_end = muscle.via or muscle.insertion
    start, end = hinge.to_plane(np.array([muscle.origin, moving_end]))[:, :2]
    return LineOfAction(start, end, muscle.line_radius, 1 if muscle.side == "front" else -1)


def end_turn(muscle: Muscle, hinge: Hinge, flexion: float) -> float:
    """Rotation [rad] of the insertion face after `flexion`: it follows the line's tangent, not the forearm."""
    if muscle.via is not None:
        return flexion
    line = line_of_action(muscle, hinge)
    return line.end_direction(flexion) - line.end_direction(0.0)


@dataclass(frozen=True)
class Body:
    """Centre line and sections of a muscle at equidistant stations.

    Parameters
    ----------
    centres
        Centre line from origin to insertion in the reference pose [mm].
    areas
        Section areas [mm²].
    length
        Length of the centre line [mm].
    """

    centres: Float[np.ndarray, "stations 3"]
    areas: Float[np.ndarray, " stations"]
    length: float

    @property
    def volume(self) -> float:
        """Volume [mm³]."""
        return float(trapezoid(self.areas)) * self.length / (len(self.areas) - 1)


def muscle_body(arm: Arm, name: str, stations: int) -> Body:
    """Body of the named muscle with the given number of stations."""
    muscle, hinge = arm.muscles[name], arm.hinge.frame()
    planar = _planar_line(muscle, hinge)
    share = np.linspace(0, 1, len(planar))
    lateral = hinge.to_plane(np.array([muscle.origin, muscle.insertion]))[:, 2]
    tangent = np.gradient(planar, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    outwards = np.stack([-tangent[:, 1], tangent[:, 0]], axis=1) * (1 if muscle.side == "front" else -1)
    bump = np.sin(np.pi * share) ** 2
    offset = planar + outwards * (muscle.bow * bump)[:, None]
    sideways = np.interp(share, [0, 1], lateral) + muscle.bow_lateral * bump
    line = hinge.from_plane(np.column_stack([offset, sideways]))
    reached = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    places = np.linspace(0, reached[-1], stations)
    centres = np.stack([CubicSpline(reached, line[:, k])(places) for k in range(3)], axis=1)
    return Body(centres, muscle.section_area(np.linspace(0, 1, stations)), float(reached[-1]))


def _planar_line(muscle: Muscle, hinge: Hinge) -> Float[np.ndarray, "points 2"]:
    """Line of action in the reference pose, its corners rounded off by a spline."""
    line = line_of_action(muscle, hinge)
    points = line.sample(0.0, 13)
    if muscle.via is not None:
        points = np.vstack([points[[0, -1]], hinge.to_plane(np.array(muscle.insertion))[None, :2]])
    reached = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return CubicSpline(reached, points)(np.linspace(0, reached[-1], 201))
