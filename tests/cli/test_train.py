"""`myograph train`: from a file to a trained method, its errors and a saved model."""

import json
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

pytest.importorskip("torch", reason="training needs torch")

from myograph.cli.train import fitting, train, verb
from myograph.cli.train.judging import judge
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.errors import InputError, MissingPackageError
from myograph.learning import saving
from tests.learning.conftest import stand_in

GEN = """
store = "store"
method = "gen"
pairs = 10

[options]
nodes_per_axis = 2

[training]
steps = 6
batch = 4
queries = 16
device = "cpu"
checkpoint_every = 2
"""
AFFINE = 'store = "store"\nmethod = "affine"\npairs = 10\n'
FEED_FORWARD = 'store = "store"\nmethod = "feed_forward"\npairs = 4\n[training]\nsteps = 2\n'

app = typer.Typer()
app.command()(train)


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A working folder; whatever store is named holds the stand-in; nothing is exported."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: stand_in())
    monkeypatch.setattr(saving, "save_model", lambda model, training, folder: folder.mkdir(parents=True, exist_ok=True))
    return tmp_path


def run(text, *options):
    """Standard output; raises what the verb raises."""
    with open("asked.toml", "w") as file:
        file.write(text)
    done = CliRunner().invoke(app, ["asked.toml", *options])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    assert done.exit_code == 0, done.output
    return done.stdout


def test_json_is_one_object_with_the_errors_by_protocol(place):
    told = json.loads(run(GEN, "--json"))
    assert list(told) == ["model", "method", "parameters", "train_s", "protocols"]
    assert told["method"] == "gen_8"
    assert told["parameters"] > 5000
    assert told["train_s"] > 0
    assert list(told["protocols"]) == ["thesis", "strict", "off_grid"]
    assert {"mean_mm", "rmse_mm", "p95_mm", "max_mm", "relative"} <= set(told["protocols"]["strict"])
    assert told["model"] == "asked/model"
    assert (place / "asked" / "training" / "course.csv").is_file()


def test_people_read_a_table(place):
    told = run(AFFINE)
    assert told.startswith("affine: 0 parameters")
    rows = {line.split()[0]: line.split()[1:] for line in told.splitlines() if line}
    assert {"thesis", "strict", "off_grid"} <= set(rows)
    assert float(rows["strict"][0]) > 0
    assert "not saved" in told


def test_the_saved_model_says_how_it_was_made(place, monkeypatch):
    kept = []
    monkeypatch.setattr(saving, "save_model", lambda *given: kept.append(given))
    run(GEN, "--out", "here")
    model, training, folder = kept[0]
    assert (model.name, folder.as_posix()) == ("gen_8", "here/model")
    assert training.split.protocol == "strict"
    assert training.command.startswith("myograph")
    assert training.metrics["strict"]["mean_mm"] > 0


@pytest.mark.slow
def test_a_trained_method_is_saved_and_can_be_loaded_again(place, monkeypatch):
    monkeypatch.undo()
    monkeypatch.chdir(place)
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: stand_in())
    told = json.loads(run(GEN, "--json"))
    loaded = saving.load_torch(place / told["model"])
    assert loaded.name == told["method"] == "gen_8"
    assert (place / "asked" / "model" / "model.onnx").is_file()


def test_an_interrupted_training_goes_on_when_run_again(place, monkeypatch):
    whole = json.loads(run(GEN, "--json", "--out", "whole"))
    steps = []

    @contextmanager
    def stopping(name):
        def told(step, *_):
            steps.append(step)
            if steps == [1, 2, 3]:
                raise KeyboardInterrupt

        yield told

    monkeypatch.setattr(fitting, "shown", stopping)
    with pytest.raises(AssertionError):
        run(GEN, "--json", "--out", "cut")
    resumed = json.loads(run(GEN, "--json", "--out", "cut"))
    assert steps == [1, 2, 3, 3, 4, 5, 6]
    assert resumed["protocols"] == whole["protocols"]


def test_a_finished_training_is_judged_anew_and_keeps_its_time(place):
    first, again = (json.loads(run(GEN, "--json")) for _ in range(2))
    assert again["protocols"] == first["protocols"]
    assert again["train_s"] > 0


def test_a_model_is_judged_only_where_its_training_is_fair(place):
    told = json.loads(run(AFFINE.replace("pairs", 'protocol = "thesis"\npairs'), "--json"))
    assert list(told["protocols"]) == ["thesis", "off_grid"]


def test_protocols_that_lack_cases_are_left_out(place, monkeypatch):
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: stand_in(off_grid=0))
    assert list(json.loads(run(AFFINE, "--json"))["protocols"]) == ["thesis", "strict"]


def test_sensors_may_be_listed(place, monkeypatch):
    seen = []

    def spy(predictor, sampler, *rest):
        seen.append(sampler.sensors)
        return judge(predictor, sampler, *rest)

    monkeypatch.setattr(verb, "judge", spy)
    run(AFFINE + "sensors = [3, 40, 80, 120, 150]\n")
    np.testing.assert_array_equal(seen[0], [3, 40, 80, 120, 150])


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        (GEN.replace('"gen"', '"gne"'), (), "unknown method 'gne': expected one of .*did you mean 'gen'"),
        (GEN.replace("nodes_per_axis", "nodes_per_axs"), (), "unknown key 'nodes_per_axs'; did you mean 'nodes_per_"),
        (GEN.replace("steps = 6", "stepps = 6"), (), "training: unknown key 'stepps'; did you mean 'steps'"),
        (GEN.replace("steps = 6", "steps = 0"), (), "training: steps: .*greater than or equal to 1, got 0"),
        (GEN.replace("pairs", "pears"), (), "unknown key 'pears'; did you mean 'pairs'"),
        (GEN.replace('store = "store"', ""), (), "expected 'store', the folder of an ensemble, got none"),
        (GEN.replace("pairs", 'muscle = "deltoid"\npairs'), (), "muscle: expected one of .*got 'deltoid'"),
        (GEN.replace("pairs", "sensors = 1000\npairs"), (), "expected between 1 and 152 sensors"),
        (GEN.replace("pairs", 'asked = ["colour"]\npairs'), (), "expected one of the fields .*got 'colour'"),
        (GEN.replace("pairs", "asked = []\npairs"), (), "asked: .*at least 1 item"),
        (GEN.replace("[training]", "hidden = [-1]\n[training]"), (), "hidden.0: .*greater than or equal to 1, got -1"),
        (
            GEN.replace("[training]", "inputs = [[]]\n[training]"),
            (),
            "inputs: expected features at the sensors, got none",
        ),
        (GEN.replace("steps = 6", f"steps = 6\nseed = {10**30}"), (), "training: seed: "),
        (FEED_FORWARD + "[options]\nsurface_only = true\n", (), "surface_only: a saved model answers at all nodes"),
        (GEN, ("--device", "tpu"), "--device: expected one of auto, cpu, cuda, got 'tpu'"),
        (
            GEN.replace("[options]", '[options]\nskip = "affine"\nactivation_input = true'),
            (),
            "skip 'affine': expected",
        ),
        (GEN.replace("steps = 6", "steps = 6\nvalidation = 0.01"), (), "validation: expected cases for both training"),
        (
            GEN.replace("steps = 6", "steps = 6\npatience = 3"),
            (),
            "patience: .*got none; set 'validation', such as 0.1",
        ),
        (GEN.replace("pairs", 'asked = ["von_mises"]\npairs'), (), "expected one that asks for position"),
        (GEN.replace("steps = 6", 'steps = 6\nprecision = "16-mixed"'), (), "precision: expected a GPU for '16-mixed'"),
        (
            FEED_FORWARD + "validation = 0.01\npatience = 3\n",
            (),
            "patience: expected cases to validate on, got none of",
        ),
        (AFFINE + "[options]\nsize = 2", (), "'affine' has no options, got size"),
        (AFFINE + "[training]\nsteps = 2", (), r"'affine' is not trained in steps: leave \[training\] out"),
        ("method =", (), "not TOML"),
    ],
)
def test_a_mistake_is_named(place, text, options, words):
    with pytest.raises(InputError, match=words):
        run(text, *options)
    assert not (place / "asked").exists()


def test_a_field_that_is_not_judged_is_not_learned_alone(place, monkeypatch):
    cases = stand_in()
    further = replace(cases, fields=(*cases.fields, "fibre_stretch"))
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: further)
    monkeypatch.setattr(verb, "fit", lambda *_: pytest.fail("it was trained"))
    with pytest.raises(InputError, match="expected one of cauchy_stress, position, von_mises among them"):
        run(FEED_FORWARD.replace("pairs", 'asked = ["fibre_stretch"]\npairs'))


def test_two_trainings_that_begin_at_once_do_not_share_a_folder(place, monkeypatch):
    """The other one claims the folder between this one's look and its own claim, or overwrites that."""
    claimed = verb.claim_folder

    def late(out, asked, cases):
        claimed(out, asked, cases)
        (out / "train.json").write_text((out / "train.json").read_text().replace('"feed_forward"', '"gen"'))

    monkeypatch.setattr(verb, "claim_folder", late)
    with pytest.raises(InputError, match="holds another training: method was gen, now feed_forward"):
        run(FEED_FORWARD)


def test_a_gpu_where_there_is_none_is_a_mistake(place):
    import torch

    if torch.cuda.is_available():
        pytest.skip("there is a GPU")
    with pytest.raises(InputError, match="expected a CUDA GPU, found none"):
        run(GEN, "--device", "cuda")


def test_a_missing_file_and_a_missing_store_are_mistakes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match="nowhere"):
        run(AFFINE, "--data", "nowhere")
    done = CliRunner().invoke(app, ["absent.toml"])
    assert "expected a TOML file, found none" in str(done.exception)


def test_a_store_without_the_cases_of_the_protocol_is_a_mistake(place, monkeypatch):
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: stand_in(off_grid=0))
    with pytest.raises(InputError, match="protocol 'off_grid': expected at least 2 cases"):
        run(AFFINE.replace("pairs", 'protocol = "off_grid"\npairs'))


def test_a_folder_of_another_training_is_refused_with_what_differs(place):
    run(GEN)
    with pytest.raises(InputError, match="asked: holds another training: sensors was 9, now 12; choose another folder"):
        run(GEN.replace("pairs", "sensors = 12\npairs"))


def test_a_folder_of_other_data_is_refused(place, monkeypatch):
    run(AFFINE)
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: stand_in(off_grid=4))
    with pytest.raises(InputError, match="holds another training: data was"):
        run(AFFINE)


def test_another_training_of_the_same_method_is_refused(place):
    run(GEN)
    with pytest.raises(InputError, match="another training: steps was 6, now 7"):
        run(GEN.replace("steps = 6", "steps = 7"))


@pytest.mark.parametrize("name", ["notes.txt", "train.json"])
def test_a_folder_of_something_else_is_refused(place, name):
    (place / "asked").mkdir()
    (place / "asked" / name).write_text("words")
    with pytest.raises(InputError, match="choose another folder"):
        run(AFFINE)


def test_without_torch_the_extra_is_named(place, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "myograph.learning.learners", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[train\]"):
        run(GEN)


def test_only_the_first_of_several_processes_tells_and_saves(place, monkeypatch):
    monkeypatch.setattr(fitting, "in_first_process", lambda: False)
    monkeypatch.setattr(verb, "in_first_process", lambda: False)
    assert run(GEN) == ""
    assert not (place / "asked" / "model").exists()
    assert not (place / "asked" / "train.json").exists()


def test_a_method_with_cases_enough_is_saved_with_its_intervals(place, monkeypatch):
    saved = []
    monkeypatch.setattr(saving, "save_model", lambda model, training, folder: saved.append((model, training)))
    run(FEED_FORWARD.replace("pairs", 'protocol = "off_grid"\ncalibration = 0.4\npairs'))
    ((model, training),) = saved
    assert model.name == "feed_forward"
    assert training.half_width_90["position"] > 0
    assert training.split_seed == 0
    cases = stand_in()
    all_of_it = len(split_pairs(cases, "off_grid").train.cases)
    assert len(training.split.train.cases) == all_of_it - round(0.4 * all_of_it)


def test_the_seed_of_a_method_without_steps_is_that_of_its_options(place, monkeypatch):
    saved = []
    monkeypatch.setattr(saving, "save_model", lambda model, training, folder: saved.append(training))
    run('store = "store"\nmethod = "pod_gp"\npairs = 4\n[options]\nseed = 5\n')
    assert saved[0].seed == 5


def test_too_few_cases_calibrate_nothing(place, monkeypatch):
    saved = []
    monkeypatch.setattr(saving, "save_model", lambda model, training, folder: saved.append(training))
    run(FEED_FORWARD)
    assert saved[0].half_width_90 == {}


def test_held_out_cases_that_weigh_too_little_calibrate_nothing_and_that_is_said(place, monkeypatch):
    """Most of the twelve are corners, which weigh a 32nd of a case in the middle: together less than nine."""
    few = replace(stand_in(off_grid=25), design=("factorial",) * 32 + ("support",) * 15 + ("off_grid",) * 10)
    saved = []
    monkeypatch.setattr(verb, "read_muscle", lambda store, muscle: few)
    monkeypatch.setattr(saving, "save_model", lambda model, training, folder: saved.append(training))
    (place / "asked.toml").write_text(FEED_FORWARD.replace("pairs", "calibration = 0.3\npairs"))
    done = CliRunner().invoke(app, ["asked.toml"])
    assert done.exit_code == 0, done.exception
    assert "a share of 0.3 holds out too few cases for 90 % intervals: all teach" in done.stderr
    assert saved[0].half_width_90 == {}


def test_a_corrected_file_is_trained_in_the_folder_of_the_wrong_one(place):
    with pytest.raises(InputError, match="skip 'affine'"):
        run(GEN.replace("[options]", '[options]\nskip = "affine"\nactivation_input = true'))
    assert json.loads(run(GEN, "--json"))["method"] == "gen_8"


def test_a_training_that_was_killed_before_its_first_step_goes_on(place):
    run(GEN)
    (place / "asked" / "train.json").unlink()
    (place / "asked" / "model").rmdir()
    assert json.loads(run(GEN, "--json"))["method"] == "gen_8"
    assert (place / "asked" / "train.json").is_file()


def test_a_folder_below_a_file_is_refused_before_anything_is_learned(place, monkeypatch):
    (place / "file").write_text("words")
    monkeypatch.setattr(verb, "fit", lambda *_: pytest.fail("it was trained"))
    with pytest.raises(InputError, match="cannot be written"):
        run(AFFINE, "--out", "file/model")
