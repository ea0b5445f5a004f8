"""Work side by side in processes of one thread each, with news from inside while it runs.

Every process is new ('spawn'), so that nothing leaks from one to another; on an error or an interrupt all are ended
at once. What they warn of is warned of here, so that several that say the same are heard once.

Trap: a new process first imports what the caller's main module does, NumPy among it, whose number of threads is settled
there and then. It must lie in the environment that the process is born with.
"""

import multiprocessing
import os
import queue
import signal
import threading
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing.managers import SyncManager
from typing import Any, TypeVar

Result = TypeVar("Result")
News = Callable[[Any], None]
ONE_THREAD: Mapping[str, str] = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Environment of a process that computes on one thread."""


def side_by_side(work: Callable[..., Result], tasks: Sequence[tuple], on_news: News) -> list[Result]:
    """Results of work(*task, tell) for every task, in their order; what a task tells arrives at `on_news` here.

    As many processes as processors; the tasks start in the given order. The first error of a task is raised here.
    """
    if not tasks:
        return []
    context = multiprocessing.get_context("spawn")
    manager = SyncManager(ctx=context)
    manager.start(_prepare)
    with manager:
        news = manager.Queue()
        pool = ProcessPoolExecutor(min(len(tasks), os.cpu_count() or 1), context, _prepare_worker, (news,))
        try:
            with _environment(ONE_THREAD):
                futures = [pool.submit(_work, work, task, news) for task in tasks]
            _follow(futures, news, on_news)
            results = [future.result() for future in futures]
        except BaseException:
            _end(pool)
            raise
        pool.shutdown()
        return results


@contextmanager
def _environment(names: Mapping[str, str]) -> Iterator[None]:
    """What processes that are begun within inherit."""
    before = {name: os.environ.get(name) for name in names}
    os.environ.update(names)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _end(pool: ProcessPoolExecutor) -> None:
    """End the pool's processes now, whatever they are at; one that ends by itself clears up what it took first."""
    processes = list((pool._processes or {}).values())
    pool.shutdown(wait=False, cancel_futures=True)
    for process in processes:
        process.terminate()


def _work(work: Callable[..., Result], task: tuple, news: Any) -> Result:
    return work(*task, news.put)


def _follow(futures: Sequence[Future], news: Any, on_news: News) -> None:
    """Pass the news on, and warn, until all tasks are done or one has failed."""
    while True:
        try:
            told = news.get(timeout=0.1)
            if isinstance(told, Warning):
                warnings.warn(told, stacklevel=3)
            else:
                on_news(told)
        except queue.Empty:
            if all(future.done() for future in futures) or any(f.done() and f.exception() for f in futures):
                return


def _prepare_worker(news: Any) -> None:
    """As every process; its warnings are news, as text alone: not every warning can be sent."""
    _prepare()

    def tell(message: Warning | str, *_place: object) -> None:
        news.put(UserWarning(str(message)))

    warnings.showwarning = tell


def _prepare() -> None:
    """The interrupt is the parent's business, and its end is ours."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)
