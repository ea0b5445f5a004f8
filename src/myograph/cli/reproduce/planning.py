"""How long the sections take: processor seconds, said before anything is made.

Of one run of each preset from nothing: the time of a section times the processors; what else ran beside that of thesis
was left out by estimate. A section counts what no section before it has made.
"""

import os
from collections.abc import Mapping, Sequence

from myograph.evaluation.page import duration

PLANNED: Mapping[str, Mapping[str, float]] = {
    "tiny": {
        "tables": 32, "6.2.1": 37, "6.2.2": 14, "6.2.3": 25, "6.2.4": 14, "meshes": 12, "sensors": 11, "steps": 15,
        "direct": 30, "convolutions": 21, "edge": 29,
    },
    "quick": {
        "tables": 240, "6.2.1": 270, "6.2.2": 90, "6.2.3": 100, "6.2.4": 60, "meshes": 55, "sensors": 40,
        "steps": 32, "direct": 90, "convolutions": 65, "edge": 130,
    },
    "thesis": {
        "tables": 1000, "6.2.1": 2550, "6.2.2": 480, "6.2.3": 500, "6.2.4": 600, "meshes": 370, "sensors": 140,
        "steps": 90, "direct": 950, "convolutions": 170, "edge": 450,
    },
}  # fmt: skip
"""Preset -> 'tables' and each section -> processor seconds on an AMD EPYC of 2026, no graphics card."""
TABLES = "tables"


def plan(preset: str, sections: Sequence[str], simulated: bool) -> str:
    """Lines to print: what each section takes on as many processors as there are; tables only where they are made."""
    known = PLANNED[preset]
    processors = os.cpu_count() or 1
    names = [*([TABLES] if simulated else []), *sections]
    parts = [f"{name} {duration(known[name] / processors)}" for name in names if name in known]
    whole = sum(known[name] for name in names if name in known) / processors
    return f"plan, on {processors} processors from nothing: {', '.join(parts)}; together {duration(whole)}"
