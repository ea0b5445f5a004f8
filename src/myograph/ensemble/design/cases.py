"""Cases in a fixed order, no case twice."""

from dataclasses import dataclass

from myograph.case import Case
from myograph.errors import InputError


@dataclass(frozen=True)
class Design:
    """Cases in their final order, and a word for each that says where it came from.

    Raises InputError for no case at all, and for a case that comes twice.
    """

    cases: tuple[Case, ...]
    words: tuple[str, ...]

    def __post_init__(self) -> None:
        if not self.cases or len(self.cases) != len(self.words):
            raise InputError(
                f"expected cases and a word for each, got {len(self.cases)} cases and {len(self.words)} words"
            )
        first: dict[Case, int] = {}
        for number, case in enumerate(self.cases):
            if case in first:
                raise InputError(f"expected every case once, got case {first[case]} again as case {number}")
            first[case] = number
