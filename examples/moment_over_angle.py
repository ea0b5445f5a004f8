"""The biceps by finite elements: its moment about the elbow over the angle, relaxed and half active."""

import numpy as np

from myograph.anatomy.load import built_in_arm
from myograph.mechanics.muscle import FiniteElementMuscle
from myograph.mechanics.walk import Walk
from myograph.units import degrees, newton_metres, radians

ANGLES_DEG = (40, 60, 80)


def moments() -> dict[tuple[float, float], float]:
    """Moment [N·m] by (angle in degrees, activation)."""
    walk = Walk(FiniteElementMuscle(built_in_arm(), "biceps", preset="tiny"))
    points = np.array([(radians(angle), activation) for angle in ANGLES_DEG for activation in (0.0, 0.5)])
    return {(float(round(degrees(s.angle))), s.activation): newton_metres(s.moment) for _, s in walk.states(points)}


if __name__ == "__main__":
    for (angle, activation), moment in sorted(moments().items()):
        print(f"{angle:4.0f} degrees, activation {activation:.1f}: {moment:6.2f} N·m")
