"""What a model weighs, in Python's files and in plain C."""

import errno
import shutil
from dataclasses import replace

import pytest

from myograph.cli.reproduce import weighing
from myograph.cli.reproduce.experiment import corners, taught_twice
from myograph.cli.reproduce.trying import run_trial
from myograph.cli.reproduce.weighing import in_c
from myograph.errors import InputError
from tests.inference.low_rank.stand_in import save_modes


@pytest.fixture
def model(tmp_path):
    save_modes(tmp_path / "model")
    return tmp_path / "model"


def test_neural_modes_in_c_have_a_size_and_a_time(model, tmp_path):
    if shutil.which("cc") is None and shutil.which("gcc") is None:
        pytest.skip("no compiler here")
    told = in_c(model, tmp_path)
    assert 0 < told["c_int8_kb"] < told["c_kb"]
    assert 0 < told["c_ms"] < 10


def test_without_a_compiler_nothing_is_said_of_c(model, tmp_path, monkeypatch):
    monkeypatch.setattr(weighing.shutil, "which", lambda _: None)
    assert in_c(model, tmp_path) == {}


def test_a_compiler_that_fails_leaves_the_sizes(model, tmp_path, monkeypatch):
    monkeypatch.setattr(weighing.shutil, "which", lambda _: "false")
    assert set(in_c(model, tmp_path)) == {"c_kb", "c_int8_kb"}


def test_no_room_for_the_model_is_told_of(data, store, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    options = {"modes": 2, "width": 4, "members": 1}
    asked = taught_twice("m", "neural_modes", corners(data), data.size, options=options)[0]
    monkeypatch.setattr(weighing.tempfile, "TemporaryDirectory", full)
    with pytest.raises(InputError, match="No space left on device"):
        run_trial(replace(asked, weighed=True), {"ensemble": store})


@pytest.mark.exhaustive
def test_neural_modes_of_a_trial_are_weighed_in_both(data, store):
    options = {"modes": 2, "width": 4, "members": 1}
    asked = taught_twice("m", "neural_modes", corners(data), data.size, options=options)[0]
    told = run_trial(replace(asked, weighed=True), {"ensemble": store}).told
    assert {"weights_kb", "onnx_kb", "onnx_ms", "multiply_adds", "c_kb"} <= set(told)
    assert told["c_kb"] < told["weights_kb"]
