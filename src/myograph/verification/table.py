"""All checks in their order, found by name, and run one after the other.

Those of `CHECKS` are always there; those of the published limb need a folder of reference data.
"""

from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from pathlib import Path

from myograph.errors import InputError
from myograph.verification import closed_forms, cook, febio, land, limb, orders, patch
from myograph.verification.check import Check, CheckResult, run_check

CHECKS: tuple[Check, ...] = (
    *febio.CHECKS,
    *closed_forms.CHECKS,
    *cook.CHECKS,
    *land.CHECKS,
    *orders.CHECKS,
    *patch.CHECKS,
)


def select(names: Sequence[str], data: Path | None = None) -> tuple[Check, ...]:
    """Checks of the given names or families, in the table's order; all where no name is given.

    `data` is the folder of reference data. Raises InputError for a name that is none of them, naming the near one, and
    for one of the published limb without its data.
    """
    there = (*CHECKS, *limb.checks(data))
    families = {check.name.split(".")[0] for check in there}
    known = [*sorted(families), *(check.name for check in there)]
    for name in names:
        if name not in known:
            raise InputError(_unknown(name, known, families))
    return tuple(c for c in there if not names or c.name in names or c.name.split(".")[0] in names)


def skipped(names: Sequence[str], data: Path | None = None) -> dict[str, str]:
    """Families that were meant but are not there -> what to do about it."""
    wanted = not names or limb.FAMILY in {name.split(".")[0] for name in names}
    return {limb.FAMILY: limb.HOW} if wanted and not limb.checks(data) else {}


def verify(names: Sequence[str] = (), data: Path | None = None) -> Iterator[CheckResult]:
    """Results of the selected checks, each as soon as it is there."""
    return map(run_check, select(names, data))


def _unknown(name: str, known: Sequence[str], families: set[str]) -> str:
    if name.split(".")[0] == limb.FAMILY and limb.FAMILY not in families:
        return f"check '{name}' has no data: {limb.HOW}"
    near = get_close_matches(name, known, n=1, cutoff=0.5)
    hint = f"did you mean '{near[0]}'?" if near else f"expected one of {', '.join(sorted(families))}, or one check"
    return f"unknown check '{name}': {hint}"
