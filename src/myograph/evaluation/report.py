"""What a report says, before it becomes a page."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from myograph.errors import InputError
from myograph.evaluation.summary import ErrorSummary

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class Figure:
    """A picture of the report: what it shows, the PNG image, and a description for those who cannot see it."""

    caption: str
    png: bytes
    alt: str

    def __post_init__(self) -> None:
        if not self.png.startswith(PNG_SIGNATURE):
            raise InputError(f"figure '{self.caption}': expected a PNG image, got bytes that begin {self.png[:8]!r}")


@dataclass(frozen=True)
class Report:
    """What a report says.

    Parameters
    ----------
    title
        Heading.
    summary
        What was done, a sentence each.
    errors
        Method -> protocol -> errors, in the order of their rows; a method may lack a protocol.
    figures
        Pictures, in their order.
    times
        What took how long [s].
    provenance
        How to do it again: command, seeds, versions, checksums.
    notes
        Limits: what not to conclude.
    """

    title: str
    summary: tuple[str, ...]
    errors: Mapping[str, Mapping[str, ErrorSummary]]
    figures: tuple[Figure, ...] = ()
    times: Mapping[str, float] = field(default_factory=dict)
    provenance: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
