"""Progress of long steps on standard error: bars with time left, and how long each step took."""

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn


@dataclass
class Steps:
    """Shows the steps of a long job one after the other and remembers their times [s]."""

    console: Console = field(default_factory=lambda: Console(stderr=True))
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def bars(self, title: str, totals: Mapping[str, int]) -> Iterator[Callable[[str], None]]:
        """A bar for each name of `totals`; the yielded function advances the bar of a name by one."""
        started = time.perf_counter()
        columns = (
            TextColumn("{task.description:>28}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeElapsedColumn(),
            TextColumn("left"),
            TimeRemainingColumn(),
        )
        with Progress(*columns, console=self.console) as progress:
            tasks = {name: progress.add_task(f"{title}: {name}", total=total) for name, total in totals.items()}
            yield lambda name: progress.advance(tasks[name])
        self.seconds[title] = time.perf_counter() - started

    @contextmanager
    def timed(self, title: str) -> Iterator[None]:
        """A step without a bar."""
        started = time.perf_counter()
        with self.console.status(title):
            yield
        self.seconds[title] = time.perf_counter() - started
