"""`myograph picture` and `myograph film`: what their panels hold; nothing is rendered here."""

import json

import numpy as np
import pytest
import typer

from myograph.anatomy.load import built_in_arm
from myograph.cli.film import film
from myograph.cli.picture import picture
from myograph.cli.solids import bone_solids, size_of
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError
from myograph.inference.low_rank import read_low_rank_arm
from myograph.inference.truth import write_truth
from tests.ensemble.filled import filled_store
from tests.inference.low_rank.stand_in import save_arm


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    folder = tmp_path_factory.mktemp("models")
    save_arm(folder / "arm", ("biceps", "triceps"))
    return folder


class Recorder:
    """A stage that keeps what it is given."""

    shown = []  # noqa: RUF012

    def __init__(self, panels, setting, colours=None, around=None):
        self.shown[:] = []

    def image(self, panels):
        self.shown.append(panels)
        return np.full((64, 64, 3), 20 * len(self.shown), dtype=np.uint8)

    def close(self):
        """Nothing to let go of."""


@pytest.fixture
def call(models, capsys, monkeypatch, tmp_path):
    monkeypatch.setattr("myograph.cli.arm_model.models_folder", lambda: models)
    for verb in ("picture", "film"):
        monkeypatch.setattr(f"myograph.cli.{verb}.Stage", Recorder)
    monkeypatch.chdir(tmp_path)
    app = typer.Typer()
    app.command()(picture)
    app.command()(film)

    def said(*words):
        app([str(word) for word in words], standalone_mode=False)
        return capsys.readouterr().out

    return said


def test_a_picture_has_a_panel_for_each_state_and_the_field_on_its_muscles(call, models):
    words = ("--activation", "biceps=1", "--activation", "0,0,0,0,1", "--field", "von_mises", "--load", "2")
    found = json.loads(call("picture", *words, "--json"))
    assert found["colours"]["title"] == "von Mises stress [MPa]"
    assert [title.split(",")[0] for title in found["panels"]] == ["biceps 1", "triceps 1"]
    assert "OUTSIDE" in found["panels"][1]
    biceps = Recorder.shown[0][0].solids[0]
    wanted = read_low_rank_arm(models / "arm")["biceps"].at(np.array([0, 0, 1.0, 0, 0]), 2.0)
    assert biceps.name == "biceps"
    np.testing.assert_allclose(biceps.points, wanted["position"])
    np.testing.assert_allclose(biceps.values, wanted["von_mises"])


def test_a_contact_sheet_has_a_panel_for_each_muscle(call):
    found = json.loads(call("picture", "--each", "--activation", "biceps=1", "--activation", "biceps=0.5", "--json"))
    assert [title.split("\n")[0] for title in found["panels"]] == ["biceps", "triceps"] * 2
    assert found["colours"] is None


@pytest.mark.parametrize("field", ["displacement", "half_width_90", "fibre_stretch"])
def test_fields_of_the_model_and_those_made_of_it_are_drawn(call, field):
    call("picture", "--activation", "biceps=1", "--field", field)
    values = Recorder.shown[0][0].solids[0].values
    assert values.min() >= 0
    assert values.max() > values.min()


def test_cases_of_a_dataset_are_drawn_with_their_own_fields(call, tmp_path):
    store = filled_store(tmp_path / "store")
    found = json.loads(call("picture", store, "--case", "1", "--muscle", "biceps", "--field", "von_mises", "--json"))
    assert found["panels"][0].startswith("case 1: ")
    cases = read_muscle(store, "biceps")
    drawn = Recorder.shown[0][0].solids[-1]
    np.testing.assert_allclose(drawn.values, cases.values("von_mises", np.array([1]))[0])
    call("picture", store, "--muscle", "biceps", "--field", "displacement")
    with pytest.raises(InputError, match="expected --case of a dataset, got --activation"):
        call("picture", store, "--activation", "biceps=1")
    with pytest.raises(InputError, match="expected cases from 0 to"):
        call("picture", store, "--case", "9999")


def test_a_film_shows_the_movement(call, tmp_path):
    (tmp_path / "m.csv").write_text("time,biceps\n0,0\n1,1\n")
    found = json.loads(call("film", "--movement", "m.csv", "--rate", "4", "--json"))
    assert (found["images"], found["seconds"]) == (5, 1.25)
    first, last = Recorder.shown[0][0], Recorder.shown[-1][0]
    assert (first.title[:6], last.title[:6]) == ("0.00 s", "1.00 s")
    assert np.abs(first.solids[0].points - last.solids[0].points).max() > 0.1
    assert (tmp_path / "film.gif").read_bytes()[:6] == b"GIF89a"


def test_a_film_of_a_dataset_shows_its_cases(call, tmp_path):
    store = filled_store(tmp_path / "store")
    cases = read_muscle(store, "triceps")
    found = json.loads(call("film", store, "--rate", "4", "--field", "displacement", "--json"))
    assert (found["images"], found["muscles"]) == (len(cases), ["biceps", "triceps"])
    last = Recorder.shown[-1][0]
    assert last.title.startswith(f"case {len(cases) - 1}, elbow ")
    np.testing.assert_allclose(last.solids[-1].points, cases.values("position", np.array([len(cases) - 1]))[0])
    assert last.solids[-1].values.max() > 0
    call("film", store, "--muscle", "triceps", "--by-angle")
    angles = [float(panels[0].title.split("elbow ")[1].rstrip("°")) for panels in Recorder.shown]
    assert angles == sorted(angles)
    assert angles[0] < angles[-1]
    call("film", store, "--case", "3", "--case", "1")
    assert [panels[0].title.split(",")[0] for panels in Recorder.shown] == ["case 3", "case 1"]


def test_a_film_of_a_file_of_cases_shows_them(call, tmp_path):
    cases = read_muscle(filled_store(tmp_path / "store"), "biceps")
    write_truth(tmp_path / "biceps.npz", cases, np.arange(4), ("position",))
    found = json.loads(call("film", tmp_path / "biceps.npz", "--json"))
    assert (found["images"], found["muscles"]) == (4, ["biceps"])
    with pytest.raises(InputError, match="expected cases of triceps, got those of biceps"):
        call("film", tmp_path / "biceps.npz", "--muscle", "triceps")
    with pytest.raises(InputError, match="expected one of the fields muscle, got 'von_mises'"):
        call("film", tmp_path / "biceps.npz", "--field", "von_mises")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--case", "99"), "--case: expected cases from 0 to"),
        (("--movement", "m.csv"), "expected no --movement of a dataset"),
        (("--load", "3"), "expected no --load of a dataset"),
        (("--rate", "0"), "--rate: expected a number above 0"),
        (("--muscle", "heart"), "expected one of biceps, triceps, got 'heart'"),
    ],
)
def test_wrong_options_of_a_film_of_a_dataset_are_refused(call, tmp_path, words, message):
    store = filled_store(tmp_path / "store", count=2)
    with pytest.raises(InputError, match=message):
        call("film", store, *words)
    with pytest.raises(InputError, match="expected no --case of a model"):
        call("film", "--case", "3")


def test_bones_turn_with_the_angle_and_are_left_out_where_it_is_not_known():
    arm = built_in_arm()
    straight, bent = ({bone.name: bone.points for bone in bone_solids(arm, angle)} for angle in (0.2, 1.2))
    assert np.array_equal(straight["humerus"], bent["humerus"])
    hinge = arm.hinge.frame()
    np.testing.assert_allclose(bent["radius"].mean(axis=0), hinge.flex(straight["radius"], 1.0).mean(axis=0), atol=1.0)
    assert bone_solids(arm, None) == bone_solids(None, 1.0) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("picture", "--camera", "inside"), "camera: expected one of"),
        (("picture", "--case", "3"), "expected --activation of a model, got --case"),
        (("picture", "--size", "big"), "--size: expected such as 800x600, got 'big'"),
        (("film", "--out", "film.avi"), "expected a film such as"),
        (("film", "--muscle", "heart"), "unknown muscle 'heart'"),
        (("film", "--movement", "none.csv"), "cannot be read"),
    ],
)
def test_wrong_options_are_refused(call, words, message):
    with pytest.raises(InputError, match=message):
        call(*words)


def test_sizes_are_width_and_height():
    assert size_of("800x600") == (800, 600)
