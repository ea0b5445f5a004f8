"""The biceps by finite elements: its moment about the elbow over the angle, relaxed and half active."""

from myograph.anatomy.load import built_in_arm
from myograph.mechanics.muscle import FiniteElementMuscle
from myograph.units import degrees, newton_metres, radians

ANGLES_DEG = (40, 60, 80)


def moments() -> dict[tuple[float, float], float]:
    """Moment [N·m] by (angle in degrees, activation)."""
    biceps = FiniteElementMuscle(built_in_arm(), "biceps", preset="tiny")
    states = biceps.walk([radians(angle) for angle in ANGLES_DEG], [0.0, 0.5])
    return {(float(round(degrees(s.angle))), s.activation): newton_metres(s.moment) for _, _, s in states}


if __name__ == "__main__":
    for (angle, activation), moment in sorted(moments().items()):
        print(f"{angle:4.0f} degrees, activation {activation:.1f}: {moment:6.2f} N·m")
