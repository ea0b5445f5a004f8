"""One check: a number that finite elements compute, a number that is known, and how far apart they may be.

Convention: the error is relative to the reference; where the reference is zero the value is itself an error without
dimension and is taken as it is.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from myograph.errors import NotConvergedError


@dataclass(frozen=True)
class Check:
    """What is computed and what is known.

    Parameters
    ----------
    name
        Family and case, such as 'febio.ma20'.
    what
        The quantity, in words, with its unit.
    value
        Computes it.
    reference, source
        The known number and where it is from.
    tolerance
        Largest relative error [-] that passes.
    """

    name: str
    what: str
    value: Callable[[], float]
    reference: float
    source: str
    tolerance: float


@dataclass(frozen=True)
class CheckResult:
    """What came of a check; value and error are NaN where the method failed, for the reason in `failure`."""

    check: Check
    value: float
    failure: str = ""

    @property
    def relative_error(self) -> float:
        """Distance from the reference, over the reference unless that is zero [-]."""
        distance = abs(self.value - self.check.reference)
        return distance / abs(self.check.reference) if self.check.reference else distance

    @property
    def passed(self) -> bool:
        """Whether the error is inside the tolerance."""
        return self.relative_error <= self.check.tolerance


def run_check(check: Check) -> CheckResult:
    """Compute the check's value; a method that fails makes the check fail."""
    try:
        return CheckResult(check, check.value())
    except NotConvergedError as error:
        return CheckResult(check, math.nan, str(error))
