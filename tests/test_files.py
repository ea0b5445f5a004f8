"""Files appear whole or not at all."""

import pytest

from myograph.errors import InputError
from myograph.files import sweep, write_whole, write_whole_folder


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


def test_what_killed_writers_left_is_swept_by_the_names_that_they_wrote(tmp_path, monkeypatch):
    write_whole_folder(tmp_path / "model", _folder_with("old"))
    with monkeypatch.context() as killed:
        killed.setattr("myograph.files.shutil.rmtree", lambda *_, **__: None)
        killed.setattr("myograph.files.Path.unlink", lambda *_, **__: None)
        write_whole_folder(tmp_path / "model", _folder_with("new"))
        for name in ("a.npz", "b.npz"):
            with pytest.raises(KeyboardInterrupt):
                write_whole(tmp_path / name, _interrupted)
    assert len(list(tmp_path.iterdir())) == 4
    sweep(tmp_path, "model", "a.npz")
    assert len(list(tmp_path.iterdir())) == 2
    sweep(tmp_path, "*.npz")
    assert [path.name for path in tmp_path.iterdir()] == ["model"]
    assert (tmp_path / "model" / "content").read_text() == "new"
    sweep(tmp_path / "nowhere", "model")


def _interrupted(file):
    raise KeyboardInterrupt


def test_a_leftover_that_cannot_be_removed_is_named(tmp_path, monkeypatch):
    (tmp_path / ".a.npz-1").write_bytes(b"")

    def refused(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("myograph.files.Path.unlink", refused)
    with pytest.raises(InputError, match=r"\.a\.npz-1: cannot be written \(Permission denied\)"):
        sweep(tmp_path, "a.npz")
