"""What a training writes beside its checkpoints."""

import csv
import sys
from pathlib import Path

import numpy as np
import pytest

from myograph.errors import InputError, MissingPackageError
from myograph.learning.training import logs, train


def rows(folder):
    with (folder / "course.csv").open() as file:
        return list(csv.DictReader(file))


def test_the_log_has_a_row_for_every_step(field, tmp_path):
    history = train(*field(validation=0.2, validate_every=3), folder=tmp_path)
    written = rows(tmp_path)
    assert list(written[0]) == ["step", "loss", "rmse_mm", "rate", "validation_mm", "seconds"]
    for column, values in (("loss", history.loss), ("rmse_mm", history.rmse), ("rate", history.rate)):
        np.testing.assert_array_equal([float(row[column]) for row in written], values)
    assert [row["validation_mm"] == "" for row in written] == np.isnan(history.validation).tolist()
    np.testing.assert_array_equal([float(row["seconds"]) for row in written], history.elapsed)


def test_a_log_of_fewer_rows_skips_steps(field, tmp_path):
    train(*field(log_every=4, steps=9), folder=tmp_path)
    assert [row["step"] for row in rows(tmp_path)] == ["4", "8"]


def test_tensorboard_has_scalars_histograms_and_the_mesh_as_it_moves(field, tmp_path):
    accumulator = pytest.importorskip("tensorboard.backend.event_processing.event_accumulator")
    trainable, config = field(tensorboard=True, histogram_every=3, validation=0.2, validate_every=3)
    trainable.mesh = lambda: (np.eye(3), np.array([[0, 1, 2]]))
    history = train(trainable, config, folder=tmp_path)
    folder, everything = str(tmp_path / "tensorboard"), {"histograms": 0}
    events = accumulator.EventAccumulator(folder, size_guidance=everything).Reload()
    assert sorted(events.Tags()["scalars"]) == ["loss", "rate", "rmse_mm", "validation_mm"]
    np.testing.assert_allclose([event.value for event in events.Scalars("rmse_mm")], history.rmse, rtol=1e-5)
    assert [event.step for event in events.Scalars("validation_mm")] == [3, 6]
    assert sorted(events.Tags()["histograms"]) == sorted(dict(trainable.module.named_parameters()))
    assert [event.step for event in events.Histograms("layers.0.weight")] == [3, 6]
    assert {"graph_VERTEX", "graph_FACE"} <= set(events.Tags()["tensors"])


def test_a_training_that_goes_on_has_every_step_once_in_tensorboard(field, tmp_path):
    accumulator = pytest.importorskip("tensorboard.backend.event_processing.event_accumulator")

    def stop(step, *_):
        if step == 5:
            raise KeyboardInterrupt

    trainable, config = field(tensorboard=True, checkpoint_every=3)
    with pytest.raises(KeyboardInterrupt):
        train(trainable, config, stop, tmp_path)
    train(field()[0], config, folder=tmp_path)
    events = accumulator.EventAccumulator(str(tmp_path / "tensorboard")).Reload()
    assert [event.step for event in events.Scalars("loss")] == [1, 2, 3, 4, 5, 6]


def test_tensorboard_where_it_is_not_installed_is_a_missing_package(field, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "torch.utils.tensorboard", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[train\]"):
        train(*field(tensorboard=True), folder=tmp_path)


def test_without_a_folder_nothing_is_written(field, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    train(*field())
    assert list(tmp_path.iterdir()) == []


FULL = Path("/dev/full")
full_disk = pytest.mark.skipif(not FULL.exists(), reason="there is no file that is always full here")


class Board:
    """One of TensorBoard that fails from some call on."""

    def __init__(self, most):
        self.calls, self.most = 0, most

    def add_scalar(self, *_):
        self.calls += 1
        if self.calls > self.most:
            raise OSError(28, "No space left on device")

    def add_histogram(self, *_):
        pass

    def close(self):
        self.add_scalar()


@full_disk
def test_a_full_disk_is_told_of_and_not_a_fault(field, tmp_path):
    train(*field(), folder=tmp_path / "run")
    log = tmp_path / "run" / "course.csv"
    log.unlink()
    log.symlink_to(FULL)
    with pytest.raises(InputError, match=r"course\.csv: cannot be written \(No space left on device\); free some room"):
        train(*field(), folder=tmp_path / "run")


@full_disk
def test_a_disk_that_becomes_full_is_told_of_at_that_step(field, tmp_path, monkeypatch):
    def fill(step, *_):
        if step == 2:
            opened[0]._file.close()
            opened[0]._file = FULL.open("w", buffering=1)

    opened = []
    enter = logs.CourseLog.__enter__
    monkeypatch.setattr(logs.CourseLog, "__enter__", lambda log: opened.append(log) or enter(log))
    with pytest.raises(InputError, match=r"course\.csv: cannot be written"):
        train(*field(), progress=fill, folder=tmp_path / "run")


@pytest.mark.parametrize("most", [0, 18], ids=["at a step", "at the end"])
def test_tensorboard_without_room_is_told_of(field, tmp_path, monkeypatch, most):
    """Three scalars a step; what waits to be written finds no room when the file is closed."""
    monkeypatch.setattr(logs, "_board", lambda *_: Board(most))
    with pytest.raises(InputError, match="tensorboard: cannot be written"):
        train(*field(tensorboard=True), folder=tmp_path / "run")
