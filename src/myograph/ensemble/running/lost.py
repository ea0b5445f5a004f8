"""What may be lost while a run works: all workers, or the scheduler; the run then begins anew with what is missing."""

from collections.abc import Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager

from distributed import Client
from distributed.client import ClosedClientError


class PlaceLostError(Exception):
    """Cases cannot be computed here any more."""


class NoWorkersError(PlaceLostError):
    """No worker is there, and none came."""


class SchedulerLostError(PlaceLostError):
    """The scheduler ended, or was started again and knows nothing of this run."""


@contextmanager
def reaching(client: Client) -> Iterator[None]:
    """Turn whatever Dask raises when its scheduler does not answer into SchedulerLostError."""
    try:
        yield
    except Exception as problem:
        if isinstance(problem, CancelledError | ClosedClientError | OSError) or client.status != "running":
            raise SchedulerLostError(f"its scheduler was lost ({problem})") from None
        raise
