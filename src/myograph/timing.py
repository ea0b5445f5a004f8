"""How long calls take: medians are of a machine as it is, least times of one that does nothing else."""

import time
from collections.abc import Callable

import numpy as np
from jaxtyping import Float


def call_times(work: Callable[[], object], repeats: int) -> Float[np.ndarray, " repeats"]:
    """Times of that many calls [ms]; one call before them, which may set things up, does not count."""
    work()
    times = []
    for _ in range(repeats):
        started = time.perf_counter()
        work()
        times.append(time.perf_counter() - started)
    return 1000 * np.array(times)
