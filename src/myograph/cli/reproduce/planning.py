"""How long the sections take: processor seconds, measured once, said before anything is made.

Tables and stores are those of a run from nothing; a section counts what no section before it has made.
"""

import os
from collections.abc import Mapping, Sequence

from myograph.evaluation.page import duration

PLANNED: Mapping[str, Mapping[str, float]] = {
    "tiny": {},
    "quick": {},
    "thesis": {},
}
"""Preset -> 'tables' and each section -> processor seconds on an Intel Xeon of 2026, no graphics card."""
TABLES = "tables"


def plan(preset: str, sections: Sequence[str], simulated: bool) -> str:
    """Lines to print: what each section takes on as many processors as there are; tables only where they are made."""
    known = PLANNED[preset]
    processors = os.cpu_count() or 1
    names = [*([TABLES] if simulated else []), *sections]
    parts = [f"{name} {duration(known[name] / processors)}" for name in names if name in known]
    whole = sum(known[name] for name in names if name in known) / processors
    return f"plan, on {processors} processors from nothing: {', '.join(parts)}; together {duration(whole)}"
