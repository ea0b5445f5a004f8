"""What was found is kept, whole, and only for the version that found it."""

import errno
import json

import numpy as np
import pytest

from myograph.cli.reproduce.cache import Cache, Found
from myograph.cli.reproduce.trial import Chosen, Trial
from myograph.errors import InputError

FOUND = Found({"seconds": 2.5, "protocols": {"strict": {"mean_mm": 0.25}}}, {"curve": np.arange(6.0).reshape(2, 3)})


def test_what_was_put_is_got_again(tmp_path):
    cache = Cache(tmp_path / "cache")
    cache.prepare()
    assert cache.get("a") is None
    cache.put("a", FOUND)
    found = cache.get("a")
    assert found is not None
    assert found.told == FOUND.told
    np.testing.assert_array_equal(found.arrays["curve"], FOUND.arrays["curve"])


def test_a_cache_of_this_version_stays_and_one_of_another_is_made_anew(tmp_path):
    cache = Cache(tmp_path / "cache")
    assert not cache.prepare()
    cache.put("a", FOUND)
    assert not cache.prepare()
    assert cache.get("a") is not None
    (cache.folder / "format.json").write_text(json.dumps({"format": 1, "myograph": "0.0.1"}))
    assert cache.prepare()
    assert cache.get("a") is None
    assert not cache.prepare()


def test_a_cache_of_another_version_that_cannot_be_removed_is_told_of(tmp_path, monkeypatch):
    cache = Cache(tmp_path / "cache")
    cache.prepare()
    (cache.folder / "format.json").write_text("{}")

    def locked(_):
        raise OSError(errno.EACCES, "Permission denied")

    monkeypatch.setattr("myograph.cli.reproduce.cache.shutil.rmtree", locked)
    with pytest.raises(InputError, match="cache: cannot be written"):
        cache.prepare()


def test_a_cache_without_a_mark_is_made_anew(tmp_path):
    cache = Cache(tmp_path / "cache")
    cache.prepare()
    cache.put("a", FOUND)
    (cache.folder / "format.json").unlink()
    assert cache.prepare()
    assert cache.get("a") is None


@pytest.mark.parametrize("damage", [b"", b"no archive", None])
def test_a_damaged_entry_counts_as_none(tmp_path, damage):
    cache = Cache(tmp_path)
    cache.prepare()
    cache.put("a", FOUND)
    path = tmp_path / "a.npz"
    path.write_bytes(path.read_bytes()[:-200] if damage is None else damage)
    assert cache.get("a") is None


@pytest.mark.parametrize("flip", [0x40, 0xFF])
def test_an_entry_with_a_byte_that_changed_is_none_or_reads_as_it_was(tmp_path, flip):
    cache = Cache(tmp_path)
    node = np.linspace(0, 1, 30)
    cache.put("a", Found(FOUND.told, {**FOUND.arrays, "node_mm_thesis": node, "node_mm_strict": node}))
    path = tmp_path / "a.npz"
    whole, kept = path.read_bytes(), cache.get("a")
    assert kept is not None
    for place in range(len(whole)):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ flip]) + whole[place + 1 :])
        found = cache.get("a")
        if found is not None:
            assert found.told == kept.told
            assert list(found.arrays) == list(kept.arrays)
            assert all(np.array_equal(found.arrays[name], kept.arrays[name]) for name in kept.arrays)


def test_a_full_disk_is_told_and_leaves_nothing(tmp_path, monkeypatch):
    cache = Cache(tmp_path / "cache")
    cache.prepare()

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("myograph.cli.reproduce.cache.np.savez_compressed", full)
    with pytest.raises(InputError, match=r"No space left on device.*free some room"):
        cache.put("a", FOUND)
    assert [path.name for path in cache.folder.iterdir()] == ["format.json"]


def test_leftovers_of_a_kill_are_swept_and_running_trainings_stay(tmp_path):
    cache = Cache(tmp_path)
    cache.prepare()
    cache.put("abc", FOUND)
    for name in (".abc.npz-xyz", ".format.json-xyz"):
        (tmp_path / name).write_bytes(b"half")
    checkpoint = tmp_path / "running" / "def" / "checkpoint.pt"
    checkpoint.parent.mkdir(parents=True)
    checkpoint.write_bytes(b"half a training")
    assert not cache.prepare()
    assert {path.name for path in tmp_path.iterdir()} == {"abc.npz", "format.json", "running"}
    assert checkpoint.read_bytes() == b"half a training"


def trial(**changes):
    asked = {"name": "a", "method": "affine", "cases": Chosen("ensemble", (0, 1), (2, 3)), "teaching": "strict"}
    return Trial(**(asked | changes))


def test_a_key_is_of_all_but_the_name():
    checksums = {"ensemble": "abc", "beside": "def"}
    key = trial().key(checksums)
    assert trial(name="b").key(checksums) == key
    assert trial(seed=1).key(checksums) != key
    assert trial(options={"latent": 8}).key(checksums) != key
    assert trial(cases=Chosen("ensemble", (0, 1), (2,))).key(checksums) != key
    assert trial().key(checksums | {"ensemble": "abd"}) != key
    assert trial().key(checksums | {"beside": "xyz"}) == key
    both = trial(cases=Chosen("ensemble", (0, 1), (2, 3), truth="beside"))
    assert both.key(checksums) != both.key(checksums | {"beside": "xyz"})
