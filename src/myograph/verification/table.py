"""All checks in their order, found by name, and run one after the other."""

from collections.abc import Iterator, Sequence
from difflib import get_close_matches

from myograph.errors import InputError
from myograph.verification import closed_forms, cook, febio, land, orders, patch
from myograph.verification.check import Check, CheckResult, run_check

CHECKS: tuple[Check, ...] = (
    *febio.CHECKS,
    *closed_forms.CHECKS,
    *cook.CHECKS,
    *land.CHECKS,
    *orders.CHECKS,
    *patch.CHECKS,
)


def select(names: Sequence[str]) -> tuple[Check, ...]:
    """Checks of the given names or families, in the table's order; all where no name is given.

    Raises InputError for a name that is none of them, naming the near one.
    """
    families = {check.name.split(".")[0] for check in CHECKS}
    known = [*sorted(families), *(check.name for check in CHECKS)]
    for name in names:
        if name not in known:
            near = get_close_matches(name, known, n=1, cutoff=0.5)
            hint = (
                f"did you mean '{near[0]}'?" if near else f"expected one of {', '.join(sorted(families))}, or one check"
            )
            raise InputError(f"unknown check '{name}': {hint}")
    return tuple(c for c in CHECKS if not names or c.name in names or c.name.split(".")[0] in names)


def verify(names: Sequence[str] = ()) -> Iterator[CheckResult]:
    """Results of the selected checks, each as soon as it is there."""
    return map(run_check, select(names))
