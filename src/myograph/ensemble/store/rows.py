"""What became of a case: one small JSON file, written after the case's arrays, so that it vouches for them."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Literal

from myograph.ensemble.store.aside import place
from myograph.ensemble.store.checksum import checksum
from myograph.errors import InputError

State = Literal["done", "failed"]
ROWS = "rows"


@dataclass(frozen=True)
class Row:
    """What became of a case.

    Parameters
    ----------
    case
        Its number.
    state
        'done', or 'failed': answered with a reason instead of fields.
    elbow_angle
        Elbow flexion [rad]; None for a failed case.
    moments
        Muscle -> moment about the hinge [N*mm].
    notes
        How far to trust the answer, in words.
    reason, residuals
        Why it failed, and the residuals of the last attempt [N] where the method tells them.
    chunks
        MUSCLE/FIELD -> checksum of the bytes on disk.
    """

    case: int
    state: State
    elbow_angle: float | None = None
    moments: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    reason: str = ""
    residuals: tuple[float, ...] = ()
    chunks: Mapping[str, str] = field(default_factory=dict)


def row_path(store: Path, case: int) -> Path:
    """Where the row of a case lies."""
    return store / ROWS / f"{case:06d}.json"


def write_row(store: Path, row: Row) -> None:
    """Put the row in its place; raises OSError where there is no room."""
    body = asdict(row)
    data = {**body, "checksum": checksum(_text(body))}
    place(store, row_path(store, row.case), _text(data))


def read_row(store: Path, case: int) -> Row | None:
    """The row of a case, None where it has none yet; raises InputError for a damaged one."""
    try:
        body = json.loads(row_path(store, case).read_bytes())
        found = body.pop("checksum")
        tuples = {name: tuple(body[name]) for name in ("notes", "residuals")}
        row = Row(**{**body, **tuples})
    except FileNotFoundError:
        return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        raise InputError(f"case {case}: its row is damaged") from None
    if checksum(_text(body)) != found or row.case != case:
        raise InputError(f"case {case}: its row is damaged")
    return row


def states(store: Path, size: int) -> list[State | None]:
    """The state of every case; None for one that has no row yet, or a damaged one."""
    return [state_of(store, case) for case in range(size)]


def state_of(store: Path, case: int) -> State | None:
    """The state of a case; None where it has no row yet, or a damaged one."""
    try:
        row = read_row(store, case)
    except InputError:
        return None
    return None if row is None else row.state


def _text(body: Mapping[str, object]) -> bytes:
    return json.dumps(body, ensure_ascii=False, sort_keys=True).encode()
