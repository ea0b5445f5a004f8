"""The line of action of a muscle in the plane of flexion: the shortest line around a circle about the hinge.

The line starts at a fixed origin, wraps the circle on one side where the straight line would cut it, and ends at a
point that turns with the forearm. Its derivative over the elbow angle is minus the moment arm.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True)
class LineOfAction:
    """Planar shortest path (forward, up) [mm] from `start` to `end` around a circle about the hinge.

    Parameters
    ----------
    start, end
        End points in the reference pose; `end` turns with the forearm.
    radius
        Radius of the circle [mm]; 0 for a straight line.
    side
        +1 where the line passes in front of the hinge (flexor), -1 behind it (extensor).
    """

    start: Float[np.ndarray, " 2"]
    end: Float[np.ndarray, " 2"]
    radius: float
    side: int

    def length(self, flexion: float) -> float:
        """Length [mm] after a flexion of `flexion` [rad] from the reference pose."""
        points = self.corners(flexion)
        straight = np.linalg.norm(points[1] - points[0]) + np.linalg.norm(points[3] - points[2])
        return float(straight + self.radius * self._wrap_angle(points))

    def moment_arm(self, flexion: float) -> float:
        """Moment arm [mm] -d(length)/d(angle); positive flexes."""
        first, last = self.corners(flexion)[2:]
        along = (last - first) / np.linalg.norm(last - first)
        return float(first[0] * along[1] - first[1] * along[0]) * -1.0

    def end_direction(self, flexion: float) -> float:
        """Angle [rad] of the line's last straight piece in the plane, continuous over flexion."""
        first, last = self.corners(flexion)[2:]
        radial = np.arctan2(self.end[1], self.end[0]) + flexion
        along = np.arctan2(last[1] - first[1], last[0] - first[0])
        return float(radial + np.angle(np.exp(1j * (along - radial))))

    def corners(self, flexion: float) -> Float[np.ndarray, "4 2"]:
        """Start, where the circle is met, where it is left, end."""
        c, s = np.cos(flexion), np.sin(flexion)
        end = np.array([c * self.end[0] - s * self.end[1], s * self.end[0] + c * self.end[1]])
        first, last = self._tangent(self.start, -self.side), self._tangent(end, self.side)
        if self._wrap_angle(np.array([self.start, first, last, end])) <= 0 or self._clears(end):
            middle = (self.start + end) / 2
            return np.array([self.start, middle, middle, end])
        return np.array([self.start, first, last, end])

    def sample(self, flexion: float, count: int) -> Float[np.ndarray, "count 2"]:
        """Points along the line at equal distances."""
        corners = self.corners(flexion)
        first = np.arctan2(corners[1, 1], corners[1, 0])
        turns = first - self.side * np.linspace(0, 1, 65) * self._wrap_angle(corners)
        arc = self.radius * np.stack([np.cos(turns), np.sin(turns)], axis=1)
        wrapped = self.radius > 0 and not np.allclose(corners[1], corners[2])
        line = np.vstack([corners[:1], arc, corners[3:]]) if wrapped else corners[[0, 3]]
        reached = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
        places = np.linspace(0, reached[-1], count)
        return np.stack([np.interp(places, reached, line[:, k]) for k in (0, 1)], axis=1)

    def _clears(self, end: Float[np.ndarray, " 2"]) -> bool:
        """True where the straight line already passes the hinge on the right side, outside the circle."""
        along = end - self.start
        offset = (self.start[0] * along[1] - self.start[1] * along[0]) / np.linalg.norm(along)
        return bool(-self.side * offset >= self.radius)

    def _tangent(self, point: Float[np.ndarray, " 2"], turn: int) -> Float[np.ndarray, " 2"]:
        """Point of the circle whose tangent meets `point`, on the side given by `turn`."""
        distance = max(float(np.linalg.norm(point)), self.radius)
        angle = np.arctan2(point[1], point[0]) + turn * np.arccos(self.radius / distance)
        return self.radius * np.array([np.cos(angle), np.sin(angle)])

    def _wrap_angle(self, corners: Float[np.ndarray, "4 2"]) -> float:
        """Angle wrapped around the circle, from -pi to pi; negative where there is nothing to wrap."""
        first, last = (np.arctan2(p[1], p[0]) for p in corners[1:3])
        return float(np.angle(np.exp(1j * (first - last) * self.side)))
