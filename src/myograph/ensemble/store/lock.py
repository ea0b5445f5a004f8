"""One runner at a time: a lock that the operating system frees when its holder dies, however it dies."""

import json
import os
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import IO, Any

from myograph.errors import InputError
from myograph.files import refusing

RUNNER = ".runner"


@dataclass(frozen=True)
class Runner:
    """Who works on a store: process, machine, since when [s since 1970], with how many cases ready before."""

    pid: int
    host: str
    started: float
    ready: int


@contextmanager
def locked(store: Path, ready: int) -> Iterator[None]:
    """Hold the store; raises InputError where somebody else does, and where it cannot be written."""
    with refusing(store):
        file = (store / RUNNER).open("a+b", buffering=0)
    with file:
        if not _take(file):
            other = runner(store)
            name = f"process {other.pid} on {other.host}" if other else "another process"
            raise InputError(f"{store}: {name} is at work on it; wait for its end, or take another folder")
        who = Runner(os.getpid(), socket.gethostname(), time.time(), ready)
        with refusing(store):
            file.truncate(0)
            file.write(json.dumps(asdict(who)).encode())
        try:
            yield
        finally:
            file.truncate(0)


def runner(store: Path) -> Runner | None:
    """Who wrote itself down as working on the store; it may be dead (see `is_locked`)."""
    try:
        return Runner(**json.loads((store / RUNNER).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None


def is_locked(store: Path) -> bool:
    """Whether somebody works on the store now."""
    try:
        with (store / RUNNER).open("a+", encoding="utf-8") as file:
            return not _take(file)
    except OSError:
        return False


def _take(file: IO[Any]) -> bool:
    """Try to lock the file until it is closed."""
    try:
        import fcntl
    except ModuleNotFoundError:
        return _take_on_windows(file)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _take_on_windows(file: IO[Any]) -> bool:
    import msvcrt

    file.seek(1 << 20)
    try:
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # pyright: ignore[reportAttributeAccessIssue]
    except OSError:
        return False
    return True
