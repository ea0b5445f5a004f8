"""Files appear whole or not at all; work goes on side by side."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from myograph.errors import InputError
from myograph.files import write_whole, write_whole_folder
from myograph.processes import side_by_side


def _square(number, tell):
    tell(number)
    return number**2, os.getpid()


def _fail(number, tell):
    if number == 2:
        raise InputError("two is too many")
    return number


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "table.npz"
    path.write_bytes(b"old")

    def half(file):
        file.write(b"ne")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_whole(path, half)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["table.npz"]


def test_a_finished_write_replaces_the_old_file_and_others_may_read_it(tmp_path):
    path = tmp_path / "deep" / "table.npz"
    write_whole(path, lambda file: file.write(b"one"))
    write_whole(path, lambda file: file.write(b"two"))
    assert path.read_bytes() == b"two"
    assert path.stat().st_mode & 0o044


def test_a_folder_in_the_way_and_a_full_disk_are_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="choose another folder"):
        write_whole(tmp_path / "file" / "x", lambda file: file.write(b""))

    def full(file):
        raise OSError(28, "No space left on device")

    with pytest.raises(InputError, match="No space left on device"):
        write_whole(tmp_path / "x", full)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def _folder_with(text):
    def write(folder):
        folder.mkdir()
        (folder / "content").write_text(text)

    return write


def test_a_folder_is_replaced_as_a_whole(tmp_path):
    write_whole_folder(tmp_path / "model", _folder_with("old"))
    write_whole_folder(tmp_path / "model", _folder_with("new"))
    assert (tmp_path / "model" / "content").read_text() == "new"
    assert [p.name for p in tmp_path.iterdir()] == ["model"]


def test_a_failed_folder_leaves_the_old_one_even_where_the_last_rename_fails(tmp_path):
    write_whole_folder(tmp_path / "model", _folder_with("old"))

    def broken(folder):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_whole_folder(tmp_path / "model", broken)
    with pytest.raises(InputError, match="cannot be written"):
        write_whole_folder(tmp_path / "model", lambda folder: None)
    assert (tmp_path / "model" / "content").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["model"]


def test_results_come_in_order_and_news_arrives():
    heard = []
    results = side_by_side(_square, [(3,), (1,), (2,)], heard.append)
    assert [value for value, _ in results] == [9, 1, 4]
    assert sorted(heard) == [1, 2, 3]
    assert os.getpid() not in {pid for _, pid in results}


def test_the_error_of_a_task_is_raised_here():
    with pytest.raises(InputError, match="two is too many"):
        side_by_side(_fail, [(1,), (2,), (3,)], print)


def test_no_tasks_have_no_results():
    assert side_by_side(_square, [], print) == []


PARENT = """
import time
from myograph.processes import side_by_side
from tests.test_files import _sleep

if __name__ == "__main__":
    side_by_side(_sleep, [(60.0,)], lambda pid: print(pid, flush=True))
"""


def _sleep(seconds, tell):
    tell(os.getpid())
    time.sleep(seconds)


@pytest.mark.skipif(not Path("/proc").exists(), reason="looks at Linux's table of processes")
def test_all_processes_end_when_their_parent_is_killed(tmp_path):
    (tmp_path / "parent.py").write_text(PARENT)
    root = Path(__file__).parents[1]
    environment = {**os.environ, "PYTHONPATH": str(root)}
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
