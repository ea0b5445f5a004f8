"""How long a solver takes for the whole arm in one state, to stand beside the page's own milliseconds.

Only what the cases themselves tell: a store says how many seconds its runs took, a file of the truth keeps the mean.
"""

from dataclasses import dataclass

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.errors import InputError
from myograph.inference.shipped import shipped_truth
from myograph.inference.truth import seconds_per_case

SOLVERS = {"direct": "finite elements", "table": "table"}
"""Kind of simulator -> its name for people."""


@dataclass(frozen=True)
class SolveTime:
    """Seconds of a case, what solved it, and what the time is of, in words."""

    seconds: float
    what: str
    told: str


def solve_time(cases: MuscleCases) -> SolveTime | None:
    """As the cases say; None where they do not."""
    seconds, what = seconds_per_case(cases), SOLVERS.get(cases.attributes.get("simulator", ""))
    if seconds is None or what is None:
        return None
    preset = cases.attributes.get("preset", "")
    size = f" of the size '{preset}'" if preset else ""
    return SolveTime(seconds, what, f"all muscles{size} in one state, mean of the run that solved them")


def shipped_solve_time(muscle: str, arm_checksum: str) -> SolveTime | None:
    """Of finite elements, from the cases that come with the package; None where these are of another arm."""
    try:
        cases = shipped_truth(muscle)
    except InputError:
        return None
    direct = cases.attributes.get("simulator") == "direct"
    return solve_time(cases) if direct and cases.attributes.get("arm_checksum") == arm_checksum else None
