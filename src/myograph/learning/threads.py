"""Linear algebra of small matrices on one thread of the processor.

Trap: of several threads, those that have done their part wait by spinning. Where other work needs the processors, they
take its time from the one that has not: fits of seconds take minutes.
"""

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import threadpool_limits

Given = ParamSpec("Given")
Result = TypeVar("Result")


def on_one_thread(work: Callable[Given, Result]) -> Callable[Given, Result]:
    """The same work, with one thread for the linear algebra of NumPy and SciPy while it lasts."""

    @wraps(work)
    def limited(*arguments: Given.args, **options: Given.kwargs) -> Result:
        with threadpool_limits(limits=1, user_api="blas"):
            return work(*arguments, **options)

    return limited
