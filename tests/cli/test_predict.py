"""`myograph predict` and `myograph evaluate` on models whose errors are known by formula."""

import csv
import json
import shutil

import numpy as np
import pytest
import typer

from myograph.cli.evaluate import evaluate
from myograph.cli.predict import predict
from myograph.errors import InputError
from myograph.inference.held_out import factorial_checksum
from myograph.inference.truth import read_truth, write_truth
from tests.inference.stand_in import SENSORS, place, save_linear, save_mean, stand_in_cases

ERROR = 0.75  # mm, in x at every node


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Shipped models and their truth, whose every node is 0.75 mm beside what the model `linear` says."""
    folder = tmp_path_factory.mktemp("models")
    save_linear(folder / "linear")
    save_mean(folder / "mean")
    (folder / "truth").mkdir()
    everything = np.arange(40)
    write_truth(folder / "truth" / "biceps.npz", stand_in_cases(error=ERROR), everything, ("position", "von_mises"))
    return folder


@pytest.fixture
def call(folder, capsys, monkeypatch):
    """Call a verb as from the command line: what it prints."""
    monkeypatch.setattr("myograph.inference.shipped.models_folder", lambda: folder)
    app = typer.Typer()
    app.command()(predict)
    app.command()(evaluate)

    def said(*words):
        app([str(word) for word in words], standalone_mode=False)
        return capsys.readouterr().out

    return said


def test_a_case_is_predicted_by_the_shipped_model(call):
    found = json.loads(call("predict", "--activation", "0,0,1,0,0.5", "--load", "5", "--json"))
    assert (found["model"], found["muscle"], found["nodes"], found["out"]) == ("linear", "biceps", 40, None)
    rest, now = place(np.array([[0, 0, 0, 0, 0], [0, 0, 1, 0, 0.5]]))
    moved = np.linalg.norm(now - rest, axis=1)
    (case,) = found["cases"]
    assert case["displacement_mean_mm"] == pytest.approx(moved.mean(), rel=1e-5)
    assert case["von_mises_max_mpa"] == pytest.approx(moved.max() / 100, rel=1e-5)
    assert (case["half_width_90_mm"], case["inside"]) == (0.25, True)


def test_muscles_that_are_not_named_rest(call):
    named = json.loads(call("predict", "linear", "--activation", "biceps=1, triceps=0.5", "--json"))
    assert named["cases"] == json.loads(call("predict", "--activation", "0,0,1,0,0.5", "--json"))["cases"]


def test_many_cases_come_from_a_file_and_go_into_one(call, tmp_path):
    asked = tmp_path / "asked.csv"
    asked.write_text("biceps,brachialis,brachioradialis,anconeus,triceps,hand_load_n\n1,0,0,0,0,0\n0,1,0,0,1,30\n")
    text = call("predict", "--activations", asked, "--out", tmp_path / "out.npz")
    assert "case 1: moved" in text
    assert "OUTSIDE" in text.splitlines()[2]
    with np.load(tmp_path / "out.npz", allow_pickle=False) as arrays:
        expected = place(np.array([[0, 0, 1.0, 0, 0], [0, 1.0, 0, 0, 1.0]]))
        np.testing.assert_allclose(arrays["position"], expected, atol=1e-4)
        assert arrays["inside"].tolist() == [True, False]


def test_sensors_come_from_a_file(call, tmp_path):
    sensors = tmp_path / "sensors.csv"
    rest = place(np.zeros((1, 5)))[0]
    rows = "".join(f"{node},{x + 1},{y + 2},{z + 2}\n" for node, (x, y, z) in zip((3, 30), rest[[3, 30]], strict=True))
    sensors.write_text("node,x_mm,y_mm,z_mm\n" + rows)
    found = json.loads(call("predict", "--sensors", sensors, "--json"))
    assert found["model"] == "mean"
    assert found["cases"][0]["displacement_mean_mm"] == pytest.approx(3.0, abs=1e-3)
    assert found["cases"][0]["von_mises_max_mpa"] is None


def test_intervals_from_sensors_allow_for_their_noise(call, tmp_path):
    rest = place(np.zeros((1, 5)))[0]
    at = "".join(
        f"{node},{x + node / 20},{y},{z}\n" for node, (x, y, z) in zip(SENSORS, rest[list(SENSORS)], strict=True)
    )
    (tmp_path / "s.csv").write_text("node,x_mm,y_mm,z_mm\n" + at)
    exact = json.loads(call("predict", "mean", "--sensors", tmp_path / "s.csv", "--json"))["cases"][0]
    noisy = json.loads(call("predict", "mean", "--sensors", tmp_path / "s.csv", "--sensor-noise", "0.3", "--json"))
    assert exact["half_width_90_mm"] > 0
    assert noisy["cases"][0]["half_width_90_mm"] is None  # it knows of no noise


def test_more_cases_than_are_answered_at_once_are_as_one_by_one(call, tmp_path, monkeypatch):
    rows = [f"0,0,{k / 9},0,0" for k in range(10)]
    (tmp_path / "a.csv").write_text("\n".join([COLUMNS, *rows]))
    ask = ("predict", "linear", "--activations", tmp_path / "a.csv", "--out", tmp_path / "o.npz", "--json")
    together = json.loads(call(*ask))["cases"]
    positions = np.load(tmp_path / "o.npz")["position"]
    monkeypatch.setattr("myograph.cli.predict.AT_ONCE", 3)
    assert json.loads(call(*ask))["cases"] == together
    np.testing.assert_array_equal(np.load(tmp_path / "o.npz")["position"], positions)
    monkeypatch.setattr("myograph.cli.predict.MOST_STATES", 399)
    with pytest.raises(InputError, match="expected at most 9 cases in one file, got 10"):
        call(*ask)


def test_a_grid_for_paraview(call, tmp_path):
    h5py = pytest.importorskip("h5py")
    call("predict", "--activation", "0,0,1,0,0", "--out", tmp_path / "out.vtkhdf")
    with h5py.File(tmp_path / "out.vtkhdf") as file:
        points = np.asarray(file["VTKHDF/Points"])
    np.testing.assert_allclose(points, place(np.array([[0, 0, 1.0, 0, 0]]))[0], atol=1e-4)


def test_a_movement_may_come_back_to_where_it_was(call, tmp_path):
    asked = tmp_path / "asked.csv"
    asked.write_text(f"{COLUMNS}\n0,0,0,0,0\n0,0,1,0,0\n0,0,0,0,0\n")
    cases = json.loads(call("predict", "--activations", asked, "--json"))["cases"]
    assert len(cases) == 3
    assert cases[0] == cases[2] != cases[1]


def test_the_verdict_and_the_intervals_stand_in_every_kind_of_file(call, tmp_path):
    h5py = pytest.importorskip("h5py")
    asked = tmp_path / "asked.csv"
    asked.write_text(f"{COLUMNS},hand_load_n\n0,0,1,0,0,0\n1,0,0,0,1,30\n")
    for kind in ("csv", "vtkhdf"):
        call("predict", "--activations", asked, "--out", tmp_path / f"out.{kind}")
    with (tmp_path / "out.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["inside"] for row in rows] == ["1"] * 40 + ["0"] * 40
    with h5py.File(tmp_path / "out.vtkhdf") as file:
        data = file["VTKHDF"]
        assert data["FieldData/inside"][:, 0].tolist() == [1, 0]
        assert data["FieldData/hand_load"][:, 0].tolist() == [0, 30]
        assert set(data["PointData/position_half_width_90"][:].tolist()) == {0.25}


def test_deviations_stand_in_a_grid_for_paraview(call, tmp_path):
    h5py = pytest.importorskip("h5py")
    rest = place(np.zeros((1, 5)))[0]
    rows = [f"3,{rest[3, 0]},{rest[3, 1]},{rest[3, 2]}", f"30,{rest[30, 0] + 4},{rest[30, 1]},{rest[30, 2]}"]
    (tmp_path / "sensors.csv").write_text("node,x_mm,y_mm,z_mm\n" + "\n".join(rows) + "\n")
    call("predict", "--sensors", tmp_path / "sensors.csv", "--out", tmp_path / "out.vtkhdf")
    with h5py.File(tmp_path / "out.vtkhdf") as file:
        np.testing.assert_allclose(file["VTKHDF/PointData/position_deviation"][:], 2.0, atol=1e-3)


COLUMNS = "brachioradialis,brachialis,biceps,anconeus,triceps"
MISTAKES = {
    (): "expected one of --activation and --activations, or --sensors",
    ("--activation", "0,0,1,0,0", "--activations", "a.csv"): "expected one of",
    ("--activation", "0,0,1"): "expected 5 numbers",
    ("--activation", "0,0,x,0,0"): "expected numbers such as",
    ("--activation", "0,0,1.5,0,0"): r"biceps: expected a number in \[0, 1\], got 1.5",
    ("--activation", "bicep=1"): "unknown muscle 'bicep'",
    ("--activation", "biceps=1,biceps=0.5"): "expected every muscle once",
    ("--activations", "load.csv", "--out", "load.csv"): "expected another file than the one that is read",
    ("--activation", "0,0,1,0,0", "--sensor-noise", "0.1"): "expected --sensors beside it",
    ("--activation", "0,0,1,0,0", "--load", "nan"): "expected newtons",
    ("--activation", "0,0,1,0,0", "--out", "a.xlsx"): r"ends in .csv, .npz, .vtkhdf",
    ("nothing", "--activation", "0,0,1,0,0"): "nothing: expected the folder of a saved model",
    ("mean", "--activation", "0,0,1,0,0"): "answers from sensors",
    ("--activations", "none.csv"): "not a readable CSV file",
    ("--activations", "angle.csv"): "expected no elbow_angle_deg",
    ("--activations", "load.csv", "--load", "3"): "got both",
    ("--activations", "foreign.csv"): "expected the columns",
    ("--sensors", "none.csv"): "not a readable CSV file",
}


@pytest.mark.parametrize("words", MISTAKES)
def test_mistakes_are_named_and_nothing_is_written(call, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "angle.csv").write_text(f"{COLUMNS},elbow_angle_deg\n0,0,0,0,0,90\n")
    (tmp_path / "load.csv").write_text(f"{COLUMNS},hand_load_n\n0,0,0,0,0,5\n")
    (tmp_path / "foreign.csv").write_text(f"{COLUMNS},calf\n0,0,0,0,0,5\n")
    with pytest.raises(InputError, match=MISTAKES[words]):
        call("predict", *words, *(() if "--out" in words else ("--out", "out.npz")))
    assert not list(tmp_path.glob("*out*"))


def test_a_model_is_as_far_off_as_the_truth_was_moved(call, folder):
    found = json.loads(call("evaluate", folder / "linear", folder / "truth" / "biceps.npz", "--json"))
    assert set(found["protocols"]) == {"thesis", "strict", "off_grid"}
    for figures in found["protocols"].values():
        for name in ("mean_mm", "rmse_mm", "p95_mm", "max_mm"):
            assert figures[name] == pytest.approx(ERROR, abs=1e-4)
        assert figures["von_mises_max_mpa"] <= 2**-17 + 1e-6  # a truth is rounded
        assert figures["coverage_90"] == 0  # the model says ± 0.25 mm
    assert found["parameters"] == 30
    assert found["latency_ms"] > 0


def test_without_a_name_all_shipped_models_are_evaluated(call):
    found = json.loads(call("evaluate", "--pairs", "5", "--json"))["models"]
    assert set(found) == {"linear", "mean"}
    assert found["linear"]["protocols"]["strict"]["mean_mm"] == pytest.approx(ERROR, abs=1e-4)
    assert found["linear"]["pairs"] == {"thesis": 5, "strict": 5, "off_grid": 5}
    assert found["mean"]["protocols"]["strict"]["von_mises_mean_mpa"] is None


def test_a_shipped_model_without_shipped_cases_is_left_out(call, folder, monkeypatch):
    save_linear(folder / "arm" / "triceps", muscle="triceps")
    found = json.loads(call("evaluate", "--pairs", "5", "--json"))
    shutil.rmtree(folder / "arm")
    assert set(found["models"]) == {"linear", "mean"}
    assert "no cases of triceps" in found["left_out"]["arm/triceps"]


def test_the_figures_are_said_in_words(call):
    text = call("evaluate", "linear", "--pairs", "5")
    assert "linear: biceps, 30 parameters" in text
    assert "mean_mm              0.75" in text
    assert "mean: biceps" in call("evaluate", "--pairs", "5")


def test_protocols_that_would_flatter_are_left_out(call, folder, tmp_path):
    origin = save_linear(tmp_path / "model").origin.model_copy(update={"protocol": "off_grid"})
    save_linear(tmp_path / "model", origin=origin)
    found = json.loads(call("evaluate", tmp_path / "model", folder / "truth" / "biceps.npz", "--json"))
    assert set(found["protocols"]) == {"thesis", "off_grid"}
    assert "taught this model" in found["left_out"]["strict"]
    assert "strict: left out" in call("evaluate", tmp_path / "model")


@pytest.mark.parametrize("change", ["order", "number"])
def test_protocols_whose_held_out_cases_are_not_certain_are_left_out(call, folder, tmp_path, change):
    """Another list of corners, and the seed of the split holds out others than the training did."""
    chosen = np.arange(40)[::-1] if change == "order" else np.arange(1, 40)
    write_truth(tmp_path / "other.npz", stand_in_cases(), chosen, ("position",))
    found = json.loads(call("evaluate", folder / "linear", tmp_path / "other.npz", "--json"))
    assert set(found["protocols"]) == {"off_grid"}
    assert set(found["left_out"]) == {"thesis", "strict"}
    assert "may have taught this model: expected the factorial cases of the training" in found["left_out"]["strict"]


def test_a_model_says_which_list_its_training_was_split_from(call, folder, tmp_path):
    backwards = np.arange(40)[::-1]
    write_truth(tmp_path / "other.npz", stand_in_cases(), backwards, ("position",))
    cases = read_truth(tmp_path / "other.npz")
    for told in ({"factorial": factorial_checksum(cases)}, {"factorial": "another", "dataset": cases.checksum}):
        origin = save_linear(tmp_path / "model").origin.model_copy(update=told)
        save_linear(tmp_path / "model", origin=origin)
        found = json.loads(call("evaluate", tmp_path / "model", tmp_path / "other.npz", "--json"))
        assert set(found["protocols"]) == {"thesis", "strict", "off_grid"}
        again = json.loads(call("evaluate", tmp_path / "model", folder / "truth" / "biceps.npz", "--json"))
        assert set(again["protocols"]) == {"off_grid"}


def test_cases_off_the_grid_are_enough(call, folder, tmp_path):
    write_truth(tmp_path / "few.npz", stand_in_cases(), np.arange(32, 36), ("position",))
    found = json.loads(call("evaluate", folder / "linear", tmp_path / "few.npz", "--json"))
    assert found["pairs"] == {"off_grid": 12}
    write_truth(tmp_path / "none.npz", stand_in_cases(), np.arange(32, 33), ("position",))
    with pytest.raises(InputError, match="expected cases for at least one protocol"):
        call("evaluate", folder / "linear", tmp_path / "none.npz")


def test_there_is_nothing_to_evaluate_without_models(call, monkeypatch, tmp_path):
    monkeypatch.setattr("myograph.inference.shipped.models_folder", lambda: tmp_path)
    with pytest.raises(InputError, match="has no models of its own"):
        call("evaluate")


def test_a_dataset_that_is_none_is_refused(call, folder, tmp_path):
    with pytest.raises(InputError, match="expected the store of an ensemble"):
        call("evaluate", folder / "linear", tmp_path)
    write_truth(tmp_path / "triceps.npz", stand_in_cases("triceps"), np.arange(40), ("position",))
    with pytest.raises(InputError, match="expected cases of biceps, got those of triceps"):
        call("evaluate", folder / "linear", tmp_path / "triceps.npz")
