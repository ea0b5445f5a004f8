"""Work side by side in processes of one thread each, with news from inside while it runs.

Every process is new ('spawn'), so that nothing leaks from one to another; on an error or an interrupt all are ended
at once.
"""

import multiprocessing
import os
import queue
import signal
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from multiprocessing.managers import SyncManager
from typing import Any, TypeVar

Result = TypeVar("Result")
News = Callable[[Any], None]


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
        pool = ProcessPoolExecutor(min(len(tasks), os.cpu_count() or 1), context, initializer=_prepare)
        try:
            futures = [pool.submit(_work, work, task, news) for task in tasks]
            _follow(futures, news, on_news)
            results = [future.result() for future in futures]
        except BaseException:
            _end(pool)
            raise
        pool.shutdown()
        return results


def _end(pool: ProcessPoolExecutor) -> None:
    """End the pool's processes now, whatever they are at; one that ends by itself clears up what it took first."""
    processes = list((pool._processes or {}).values())
    pool.shutdown(wait=False, cancel_futures=True)
    for process in processes:
        process.terminate()


def _work(work: Callable[..., Result], task: tuple, news: Any) -> Result:
    return work(*task, news.put)


def _follow(futures: Sequence[Future], news: Any, on_news: News) -> None:
    """Pass the news on until all tasks are done or one has failed."""
    while True:
        try:
            on_news(news.get(timeout=0.1))
        except queue.Empty:
            if all(future.done() for future in futures) or any(f.done() and f.exception() for f in futures):
                return


def _prepare() -> None:
    """One thread of computing for each process; the interrupt is the parent's business, and its end is ours."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ["OMP_NUM_THREADS"] = "1"
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)
