"""Conversions between the units inside (mm, N, MPa, s, rad) and those that people type (degrees, N·m).

The inner set is consistent: N/mm² = MPa, N·mm = mJ. Names of quantities in other units say so (`angle_deg`).
"""

import math

NEWTON_MM_PER_NEWTON_METRE = 1000.0
STANDARD_GRAVITY = 9.80665
"""Acceleration of free fall [N/kg]."""


def radians(angle_deg: float) -> float:
    """Angle in rad of an angle in degrees."""
    return math.radians(angle_deg)


def degrees(angle: float) -> float:
    """Angle in degrees of an angle in rad."""
    return math.degrees(angle)


def newton_metres(moment: float) -> float:
    """Moment in N·m of a moment in N·mm."""
    return moment / NEWTON_MM_PER_NEWTON_METRE
