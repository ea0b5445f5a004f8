"""`myograph export`: every kind from the command line, and what is refused."""

import importlib
import json
import shutil

import h5py
import numpy as np
import pytest

from myograph.case import MUSCLES
from myograph.cli.export import app
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.inference.low_rank import read_low_rank_arm
from tests.ensemble.filled import filled_store
from tests.inference.low_rank.stand_in import save_arm
from tests.inference.stand_in import FROM_ACTIVATION, FROM_SENSORS, network, save_linear, save_mean


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    """A folder with an arm of two muscles."""
    folder = tmp_path_factory.mktemp("models")
    save_arm(folder / "arm", ("biceps", "triceps"))
    return folder


@pytest.fixture
def call(models, capsys, monkeypatch, tmp_path):
    """Call a verb with the arm as the shipped one, in an empty folder: what it prints."""
    monkeypatch.setattr("myograph.cli.arm_model.models_folder", lambda: models)
    monkeypatch.chdir(tmp_path)

    def said(*words):
        app([str(word) for word in words], standalone_mode=False)
        return capsys.readouterr().out

    return said


def movement_file(path, muscle="biceps"):
    path.write_text(f"time,{muscle}\n0,0\n1,0.8\n")
    return path


def test_c_of_a_muscle_of_the_shipped_arm(call, tmp_path):
    found = json.loads(call("c", "--muscle", "biceps", "--type", "int8", "--most-kb", "9", "--name", "arm_x", "--json"))
    assert found["out"] == ["arm_x.h", "arm_x.c"]
    assert found["weight_bytes"] <= 9000
    assert "arm_x_predict" in (tmp_path / "arm_x.h").read_text()
    assert found["model_sha256"] in (tmp_path / "arm_x.c").read_text()
    assert "mm from the full model" in call("c", "arm", "--muscle", "triceps", "--stress")


def test_stl_of_a_state_says_whether_it_is_inside(call):
    found = json.loads(call("stl", "--activation", "biceps=1", "--muscle", "biceps", "--json"))
    assert (found["muscles"], found["inside"]) == (["biceps"], True)
    assert "OUTSIDE" in call("stl", "--activation", "triceps=1")


def test_gltf_with_bones_only_of_the_arm_that_the_models_were_made_with(call, tmp_path):
    found = json.loads(call("gltf", "--movement", movement_file(tmp_path / "m.csv"), "--rate", "10", "--json"))
    assert (found["muscles"], found["states"], found["bones"]) == (["biceps", "triceps"], 11, [])
    assert "made with another arm" in found["notes"][0]
    assert (tmp_path / "arm.glb").read_bytes()[:4] == b"glTF"
    assert "81 states" in call("gltf")


def test_vtkhdf_is_the_model_at_the_times_of_the_movement(call, models, tmp_path):
    movement = movement_file(tmp_path / "m.csv")
    found = json.loads(call("vtkhdf", "--movement", movement, "--rate", "4", "--load", "2", "--json"))
    assert (found["muscles"], found["states"]) == (["biceps", "triceps"], 5)
    arm = read_low_rank_arm(models / "arm")
    row = np.zeros(5)
    row[MUSCLES.index("biceps")] = 0.4
    with h5py.File(tmp_path / "arm.vtkhdf") as file:
        data = file["VTKHDF"]
        assert data["Steps/Values"][:].tolist() == [0, 0.25, 0.5, 0.75, 1]
        assert data["PointData/von_mises"].attrs["units"] == "MPa"
        assert data["FieldData/elbow_angle"][2, 0] == pytest.approx(arm["biceps"].elbow_angle(row, 2.0))
        nodes = sum(len(muscle.reference) for muscle in arm.values())
        wanted = np.vstack([muscle.at(row, 2.0)["position"] for muscle in arm.values()])
        np.testing.assert_allclose(data["Points"][2 * nodes : 3 * nodes], wanted, atol=1e-3)


def test_vtkhdf_of_a_dataset_needs_one_muscle(call, tmp_path):
    store = filled_store(tmp_path / "store")
    found = json.loads(call("vtkhdf", store, "--muscle", "biceps", "--out", "cases.vtkhdf", "--json"))
    cases = read_muscle(store, "biceps")
    assert found["states"] == len(cases)
    with h5py.File(tmp_path / "cases.vtkhdf") as file:
        np.testing.assert_allclose(
            file["VTKHDF/Points"][: cases.nodes], cases.values("position", np.array([0]))[0], rtol=1e-6
        )
    with pytest.raises(InputError, match="expected one --muscle and no --movement of a dataset, got no muscle"):
        call("vtkhdf", store)


def test_onnx_as_it_is_and_in_another_operator_set(call, models, tmp_path):
    save_linear(tmp_path / "linear")
    assert json.loads(call("onnx", tmp_path / "linear", "--json"))["opset"] == 18
    assert (tmp_path / "model.onnx").read_bytes() == (tmp_path / "linear" / "model.onnx").read_bytes()
    pytest.importorskip("onnx")
    found = json.loads(call("onnx", tmp_path / "linear", "--opset", "20", "--json"))
    assert (found["opset"], found["outputs"]) == (20, ["position", "von_mises"])
    with pytest.raises(InputError, match="can be written in, got 99"):
        call("onnx", tmp_path / "linear", "--opset", "99")


@pytest.mark.parametrize(
    ("save", "text"),
    [
        (save_linear, FROM_ACTIVATION.replace("1.0", "1.01")),
        (save_mean, FROM_SENSORS.replace("Add(query_places,", "Sub(query_places,")),
    ],
    ids=["from activations", "from sensors"],
)
def test_a_converted_network_that_answers_otherwise_is_refused(call, tmp_path, monkeypatch, save, text):
    save(tmp_path / "model")
    verb = importlib.import_module("myograph.cli.export.onnx")
    monkeypatch.setattr(verb, "_converted", lambda *_: network(text))
    with pytest.raises(InputError, match="opset: expected the same 'position' as before within 1e-05, got another"):
        call("onnx", tmp_path / "model", "--opset", "20")
    assert not (tmp_path / "model.onnx").exists()


def test_a_model_that_answers_from_sensors_is_converted(call, tmp_path):
    pytest.importorskip("onnx")
    save_mean(tmp_path / "mean")
    assert json.loads(call("onnx", tmp_path / "mean", "--opset", "20", "--json"))["opset"] == 20


def test_the_model_of_another_muscle_is_not_written_as_that_of_the_asked_one(call, tmp_path):
    save_linear(tmp_path / "linear")
    with pytest.raises(InputError, match="expected a model of triceps, got one of biceps; leave --muscle out"):
        call("onnx", tmp_path / "linear", "--muscle", "triceps")
    assert json.loads(call("onnx", tmp_path / "linear", "--muscle", "biceps", "--json"))["opset"] == 18


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("c",), "expected --muscle, one of biceps, triceps, got none"),
        (("c", "--muscle", "anconeus"), "expected muscles of biceps, triceps, got anconeus"),
        (("stl", "--muscle", "heart"), "unknown muscle 'heart'"),
        (("stl", "--activation", "biceps=2"), "activation of biceps"),
        (("gltf", "--rate", "0"), "--rate: expected a number above 0"),
        (("gltf", "--targets", "0"), "morph targets: expected at least 1"),
        (("gltf", "nowhere"), "expected the folder of a saved model"),
        (("onnx",), "expected --muscle, one of biceps, triceps"),
    ],
)
def test_wrong_options_are_refused(call, words, message):
    with pytest.raises(InputError, match=message):
        call(*words)


def test_movements_of_unknown_muscles_and_too_many_states_are_refused(call, tmp_path):
    with pytest.raises(InputError, match=r"unknown muscle 'bicep': did you mean 'biceps'\?"):
        call("gltf", "--movement", movement_file(tmp_path / "m.csv", "bicep"))
    with pytest.raises(InputError, match="expected 2 to 10000 states"):
        call("vtkhdf", "--movement", movement_file(tmp_path / "m.csv"), "--rate", "20000")


def test_places_that_cannot_be_written_are_refused(call, tmp_path):
    (tmp_path / "file").write_text("x")
    for verb in ("gltf", "stl", "vtkhdf"):
        with pytest.raises(InputError, match="expected a new file or one of the same kind"):
            call(verb, "--out", tmp_path / "file")
    with pytest.raises(InputError, match="expected a folder, got the file"):
        call("c", "--muscle", "biceps", "--out", tmp_path / "file")
    with pytest.raises(InputError, match="cannot be written"):
        call("stl", "--out", tmp_path / "file" / "x.stl")


def test_a_model_of_another_version_is_refused(call, models, tmp_path):
    shutil.copytree(models / "arm", tmp_path / "old")
    path = tmp_path / "old" / "biceps" / "model.json"
    path.write_text(path.read_text().replace('"schema_version": 1', '"schema_version": 7'))
    with pytest.raises(InputError, match="does not match its own checksum"):
        call("stl", tmp_path / "old")


def test_without_a_shipped_arm_a_model_is_asked_for(call, monkeypatch, tmp_path):
    monkeypatch.setattr("myograph.cli.arm_model.models_folder", lambda: tmp_path / "none")
    with pytest.raises(InputError, match="expected MODEL, the folder of saved models"):
        call("stl")
