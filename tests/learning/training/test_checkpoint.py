"""A training that is interrupted goes on as if it had not been; it goes on with nothing else."""

import csv
import itertools
import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
import torch
from safetensors.torch import load_file, save_file

from myograph.errors import InputError
from myograph.learning.training import train
from myograph.learning.training.checkpoint import FILE, held
from myograph.learning.training.processes import start_fabric
from myograph.learning.training.run import Run
from tests.learning.training.conftest import FEW

SETTINGS = {
    "steps": 120,
    "batch": 4,
    "queries": 16,
    "device": "cpu",
    "checkpoint_every": 7,
    "validation": 0.2,
    "validate_every": 10,
    "averaging": 0.9,
    "clip": 0.5,
    "weight_decay": 0.01,
}


class KilledError(Exception):
    pass


def die_at(step):
    def told(now, *_):
        if now == step:
            raise KilledError

    return told


def test_a_killed_training_goes_on_to_the_same_losses_and_weights(field, tmp_path):
    """SIGKILL at whatever step the process has reached; what goes on meets the undisturbed training bit for bit."""
    command = [sys.executable, "-m", "tests.learning.training.script", str(tmp_path / "run"), json.dumps(SETTINGS)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"}) as it:
        reached = next(int(line) for line in it.stdout if int(line) >= 30)
        it.send_signal(signal.SIGKILL)
    assert it.returncode == -signal.SIGKILL
    assert reached < SETTINGS["steps"]
    (resumed, config), (undisturbed, _) = field(0.2, **SETTINGS), field(0.2, **SETTINGS)
    steps = []
    second = train(resumed, config, lambda step, *_: steps.append(step), tmp_path / "run")
    first = train(undisturbed, config)
    assert 28 < steps[0] < 120
    np.testing.assert_array_equal(second.loss, first.loss)
    np.testing.assert_array_equal(second.validation, first.validation)
    for name, value in undisturbed.module.state_dict().items():
        assert torch.equal(resumed.module.state_dict()[name], value)


@pytest.mark.parametrize("settings", [{}, {"averaging": 0.9}, {"validation": 0.2, "validate_every": 2}])
def test_every_interrupt_leads_to_the_same_end(field, tmp_path, settings):
    undisturbed, config = field(0.2, checkpoint_every=2, **settings)
    whole = train(undisturbed, config)
    for step in (1, 3, 4):
        trainable, _ = field(0.2, checkpoint_every=2, **settings)
        with pytest.raises(KilledError):
            train(trainable, config, die_at(step), tmp_path / "run")
    trainable, _ = field(0.2, checkpoint_every=2, **settings)
    resumed = train(trainable, config, folder=tmp_path / "run")
    for name in ("loss", "rmse", "rate", "validation"):
        np.testing.assert_array_equal(getattr(resumed, name), getattr(whole, name))
    for name, value in undisturbed.module.state_dict().items():
        assert torch.equal(trainable.module.state_dict()[name], value)


def test_patience_counts_across_an_interrupt(field, tmp_path):
    settings = {"steps": 50, "validate_every": 1, "patience": 3, "checkpoint_every": 1}
    for stop in (KilledError, None):
        trainable, config = field(**settings)
        trainable.validation_mm = lambda: 1.0
        if stop is KilledError:
            with pytest.raises(KilledError):
                train(trainable, config, die_at(3), tmp_path / "run")
    history = train(trainable, config, folder=tmp_path / "run")
    assert (history.stopped, len(history.loss)) == ("patience", 4)


def test_a_finished_training_is_not_trained_again(field, tmp_path):
    (first, config), (again, _) = field(), field()
    done = train(first, config, folder=tmp_path / "run")
    repeated = train(again, config, folder=tmp_path / "run")
    assert again.steps_seen == []
    np.testing.assert_array_equal(repeated.loss, done.loss)
    assert repeated.stopped == done.stopped == "steps"
    assert torch.equal(again.module.layers[0].weight, first.module.layers[0].weight)


def test_time_goes_on_where_it_stopped(field, tmp_path):
    trainable, config = field(steps=10**6, seconds=0.2)
    spent = train(trainable, config, folder=tmp_path / "run").seconds
    assert train(field()[0], config, folder=tmp_path / "run").seconds == spent


def test_a_training_with_other_settings_is_refused_and_the_setting_named(field, tmp_path):
    trainable, config = field()
    train(trainable, config, folder=tmp_path / "run")
    with pytest.raises(InputError, match=r"another training: learning_rate was 0\.006, now 0\.1; choose another"):
        train(*field(learning_rate=0.1), folder=tmp_path / "run")


def test_settings_that_change_nothing_computed_may_change(field, tmp_path):
    trainable, config = field(checkpoint_every=2)
    with pytest.raises(KilledError):
        train(trainable, config, die_at(3), tmp_path / "run")
    resumed = train(*field(checkpoint_every=3, log_every=2), folder=tmp_path / "run")
    np.testing.assert_array_equal(resumed.loss, train(*field()).loss)


def test_other_data_are_refused(field, tmp_path):
    train(*field(), folder=tmp_path / "run", about="data 1")
    with pytest.raises(InputError, match="about was data 1, now data 2"):
        train(*field(), folder=tmp_path / "run", about="data 2")


def test_another_module_is_refused(field, tmp_path):
    train(*field(), folder=tmp_path / "run")
    trainable, config = field()
    trainable.module.layers[0].bias = None
    with pytest.raises(InputError, match="weights was of other names or shapes"):
        train(trainable, config, folder=tmp_path / "run")


def test_a_folder_of_something_else_is_refused_and_left_alone(field, tmp_path):
    (tmp_path / "thesis.tex").write_text("words")
    with pytest.raises(InputError, match="expected a training or nothing, got something else"):
        train(*field(), folder=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_a_truncated_checkpoint_is_named(field, tmp_path):
    train(*field(), folder=tmp_path)
    data = (tmp_path / FILE).read_bytes()
    (tmp_path / FILE).write_bytes(data[:-100])
    with pytest.raises(InputError, match=r"checkpoint.safetensors: not a checkpoint, or a damaged one"):
        train(*field(), folder=tmp_path)


def test_other_tensors_are_no_checkpoint(field, tmp_path):
    save_file({"weights": torch.zeros(3)}, tmp_path / FILE)
    with pytest.raises(InputError, match="not a checkpoint"):
        train(*field(), folder=tmp_path)


def test_altered_bytes_are_found(field, tmp_path):
    train(*field(), folder=tmp_path)
    data = bytearray((tmp_path / FILE).read_bytes())
    data[-20] ^= 1
    (tmp_path / FILE).write_bytes(data)
    with pytest.raises(InputError, match="not a checkpoint, or a damaged one"):
        train(*field(), folder=tmp_path)


@pytest.mark.parametrize(
    ("number", "other", "words"),
    [
        (b'waited\\": 0', b'waited\\": 9', "altered bytes"),
        (b'schema\\": 2', b'schema\\": 1', "expected schema 2, got 1: it is of another version"),
    ],
)
def test_other_numbers_beside_the_tensors_are_found(field, tmp_path, number, other, words):
    train(*field(), folder=tmp_path)
    data = (tmp_path / FILE).read_bytes()
    assert number in data
    (tmp_path / FILE).write_bytes(data.replace(number, other))
    with pytest.raises(InputError, match=words):
        train(*field(), folder=tmp_path)


def test_the_remains_of_a_checkpoint_that_was_being_written_are_swept_away(field, tmp_path):
    (tmp_path / f".{FILE}-abc").write_bytes(b"half")
    train(*field(), folder=tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [".runner", FILE, "course.csv"]


def test_two_trainings_in_one_folder_are_one_too_many(field, tmp_path):
    def second(*_):
        train(*field(), folder=tmp_path)

    with pytest.raises(InputError, match="is at work on it"):
        train(*field(), progress=second, folder=tmp_path)


def test_a_second_training_leaves_alone_what_the_first_is_writing(field, tmp_path):
    def second(step, *_):
        if step == 1:
            (tmp_path / f".{FILE}-now").write_bytes(b"half")
            with pytest.raises(InputError, match="is at work on it"):
                train(*field(), folder=tmp_path)
            assert (tmp_path / f".{FILE}-now").exists()

    train(*field(), progress=second, folder=tmp_path)


def test_what_the_first_process_refuses_all_refuse_and_only_the_first_writes(field, tmp_path, monkeypatch):
    trainable, config = field()
    fabric = start_fabric(config)
    monkeypatch.setattr(type(fabric), "is_global_zero", False)
    monkeypatch.setattr(fabric, "broadcast", lambda _: "run: holds another training")
    with (
        pytest.raises(InputError, match="run: holds another training"),
        held(tmp_path / "run", Run(trainable, config, fabric), ""),
    ):
        pass
    assert not (tmp_path / "run").exists()


def test_a_folder_that_cannot_be_written_is_a_mistake(field, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="file"):
        train(*field(), folder=tmp_path / "file" / "run")


def test_a_checkpoint_holds_plain_tensors_and_the_settings(field, tmp_path):
    train(*field(averaging=0.9), folder=tmp_path)
    tensors = load_file(tmp_path / FILE)
    assert {name.partition(".")[0] for name in tensors} == {"module", "average", "optimiser", "course"}
    assert len(tensors["course.loss"]) == FEW.steps


def test_rows_of_steps_that_were_lost_do_not_stay_in_the_log(field, tmp_path):
    trainable, config = field(checkpoint_every=2)
    with pytest.raises(KilledError):
        train(trainable, config, die_at(3), tmp_path)
    assert [row["step"] for row in rows(tmp_path)] == ["1", "2", "3"]
    history = train(field()[0], config, folder=tmp_path)
    assert [int(row["step"]) for row in rows(tmp_path)] == list(range(1, 7))
    assert [float(row["loss"]) for row in rows(tmp_path)] == history.loss.tolist()


def rows(folder):
    with (folder / "course.csv").open() as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
@pytest.mark.parametrize("launch", ["torchrun", pytest.param("slurm", marks=pytest.mark.exhaustive)])
def test_two_processes_share_batches_and_have_the_losses_of_one(field, tmp_path, launch):
    """Under torchrun, and started as SLURM's srun would start them; gloo between them."""
    settings = {"steps": 6, "batch": 8, "queries": 16, "device": "cpu", "validation": 0.2, "validate_every": 3}
    arguments = ["-m", "tests.learning.training.script", str(tmp_path / "run"), json.dumps(settings)]
    outputs = start_two(launch, arguments)
    told = [json.loads(line) for output in outputs for line in output.splitlines() if line.startswith("{")]
    alone = train(*field(**settings))
    assert len(told) == 2
    for two in told:
        np.testing.assert_allclose(two["loss"], alone.loss, rtol=1e-5)
        np.testing.assert_allclose(two["rmse"], alone.rmse, rtol=1e-5)


PORTS = itertools.count(29_600 + os.getpid() % 1000)


def start_two(launch, arguments):
    """Standard output of both processes."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "MASTER_ADDR": "127.0.0.1", "MASTER_PORT": str(next(PORTS))}
    if launch == "torchrun":
        run = [sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node", "2", *arguments]
        done = subprocess.run(run, capture_output=True, text=True, env=environment, timeout=300, check=False)
        assert done.returncode == 0, done.stderr
        return [done.stdout]
    slurm = {"SLURM_NTASKS": "2", "SLURM_NTASKS_PER_NODE": "2", "SLURM_NNODES": "1", "SLURM_NODEID": "0"}
    slurm |= {"SLURM_JOB_ID": "1", "SLURM_JOB_NAME": "training"}
    started = [
        subprocess.Popen(
            [sys.executable, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**environment, **slurm, "SLURM_PROCID": str(rank), "SLURM_LOCALID": str(rank)},
        )
        for rank in (0, 1)
    ]
    ended = [process.communicate(timeout=300) for process in started]
    assert [process.returncode for process in started] == [0, 0], ended
    return [output for output, _ in ended]
