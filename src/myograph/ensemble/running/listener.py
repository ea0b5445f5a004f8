"""What a run tells while it works."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Listener:
    """Who is told.

    Parameters
    ----------
    ready
        Called with the number of cases that have a row.
    dashboard
        Called with the address of Dask's dashboard.
    threads
        Called with the number of the workers' threads; 0 while the run waits for workers.
    """

    ready: Callable[[int], None] = lambda _: None
    dashboard: Callable[[str], None] = lambda _: None
    threads: Callable[[int], None] = lambda _: None


NOBODY = Listener()
