"""Colours: five hues that colour-blind readers tell apart (Okabe and Ito) for the five muscles, and the rest."""

from collections.abc import Iterable

from myograph.case import MUSCLES

MUSCLE_COLOURS: dict[str, str] = dict(
    zip(MUSCLES, ("#009e73", "#e69f00", "#d55e00", "#cc79a7", "#0072b2"), strict=True)
)
SERIES_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5c5c5c")
"""For runs and protocols, in this order."""

TENDON = "#f7f3ea"
BONE = "#e8d9b8"
INK = "#22262b"
FAINT = "#8a9099"
PAPER = "#ffffff"
SKY = "#edf1f6"
"""Behind a scene, so that white tendons show."""
SENSOR = "#000000"
QUERY = "#0072b2"
ARROW = "#b3005e"
UNKNOWN = "#9aa0a6"


def muscle_colours(names: Iterable[str]) -> dict[str, str]:
    """Colour of each muscle: that of the arm's five; for others those that are left, in order."""
    wanted = list(names)
    taken = {MUSCLE_COLOURS[name] for name in wanted if name in MUSCLE_COLOURS}
    free = [colour for colour in SERIES_COLOURS if colour not in taken]
    others = [name for name in wanted if name not in MUSCLE_COLOURS]
    colours = {name: free[place % len(free)] for place, name in enumerate(others)}
    return {name: MUSCLE_COLOURS.get(name) or colours[name] for name in wanted}
