"""Work side by side: results in their order, the first error, and nothing left behind."""

import multiprocessing
import os
import subprocess
import sys
import time
import warnings
from pathlib import Path

import pytest

from myograph.errors import InputError
from myograph.processes import side_by_side

ROOT = Path(__file__).parents[1]
FOUR = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "4")
COUNTED = """
import os

import numpy
from threadpoolctl import threadpool_info

from myograph.processes import side_by_side


def threads(tell):
    return {own["num_threads"] for own in threadpool_info()}


if __name__ == "__main__":
    (found,) = side_by_side(threads, [()], lambda _: None)
    print(sorted(found), os.environ["OPENBLAS_NUM_THREADS"])
"""
KEPT = []


def _square(number, tell):
    tell(number)
    return number**2, os.getpid()


def _fail(number, tell):
    if number == 2:
        raise InputError("two is too many")
    return number


def test_results_come_in_order_and_news_arrives():
    heard = []
    results = side_by_side(_square, [(3,), (1,), (2,)], heard.append)
    assert [value for value, _ in results] == [9, 1, 4]
    assert sorted(heard) == [1, 2, 3]
    assert os.getpid() not in {pid for _, pid in results}


def test_each_process_computes_on_one_thread_whatever_the_main_module_imports(tmp_path):
    """A new process imports the main module before anything else: here NumPy, as our own does."""
    (tmp_path / "counted.py").write_text(COUNTED)
    run = subprocess.run(
        [sys.executable, "counted.py"], cwd=tmp_path, env=os.environ | FOUR, check=True,
        capture_output=True, text=True,
    )  # fmt: skip
    assert run.stdout.split() == ["[1]", "4"]


def test_the_error_of_a_task_is_raised_here():
    with pytest.raises(InputError, match="two is too many"):
        side_by_side(_fail, [(1,), (2,), (3,)], print)


def test_no_tasks_have_no_results():
    assert side_by_side(_square, [], print) == []


def _warn(number, tell):
    warnings.warn("this network is blind", stacklevel=1)
    tell(number)
    time.sleep(0.5)


def test_what_several_processes_warn_of_is_warned_of_here_once(capfd):
    heard = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("default")
        side_by_side(_warn, [(1,), (2,), (3,)], heard.append)
    assert [str(own.message) for own in caught] == ["this network is blind"]
    assert sorted(heard) == [1, 2, 3]
    assert not capfd.readouterr().err


WARNING = """
from myograph.cli import app as command_line
from myograph.processes import side_by_side
from tests.test_processes import _warn

if __name__ == "__main__":
    command_line.app = lambda standalone_mode: side_by_side(_warn, [(1,), (2,)], print) and 0
    command_line.main()
"""


def test_on_the_command_line_it_is_one_line(tmp_path):
    (tmp_path / "warning.py").write_text(WARNING)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(tmp_path / "warning.py")]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0
    assert run.stderr == "myograph: warning: this network is blind\n"


LOCKING = """
from myograph.processes import side_by_side
from tests.test_processes import _lock

if __name__ == "__main__":
    print(side_by_side(_lock, [(1,), (2,), (3,)], print))
"""


def _lock(number, _tell):
    """Takes a lock of the system, as progress bars do, and keeps it."""
    KEPT.append(multiprocessing.get_context("spawn").Lock())
    return number


def test_processes_that_have_done_their_work_leave_nothing_of_the_system_behind(tmp_path):
    (tmp_path / "locking.py").write_text(LOCKING)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(tmp_path / "locking.py")]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert run.stdout == "[1, 2, 3]\n"
    assert not run.stderr


PARENT = """
import time
from myograph.processes import side_by_side
from tests.test_processes import _sleep

if __name__ == "__main__":
    side_by_side(_sleep, [(60.0,)], lambda pid: print(pid, flush=True))
"""


def _sleep(seconds, tell):
    tell(os.getpid())
    time.sleep(seconds)


@pytest.mark.skipif(not Path("/proc").exists(), reason="looks at Linux's table of processes")
def test_all_processes_end_when_their_parent_is_killed(tmp_path):
    (tmp_path / "parent.py").write_text(PARENT)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(tmp_path / "parent.py")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as parent:
        worker = int(parent.stdout.readline())
        children = _children(parent.pid)
        assert worker in children
        parent.kill()
    for _ in range(100):
        left = [child for child in children if Path(f"/proc/{child}").exists()]
        if not left:
            return
        time.sleep(0.1)
    raise AssertionError(f"{len(left)} processes outlived their parent by ten seconds")


def _children(parent):
    stats = [path.read_text() for path in Path("/proc").glob("[0-9]*/stat")]
    return [int(stat.split()[0]) for stat in stats if int(stat.rpartition(")")[2].split()[1]) == parent]
