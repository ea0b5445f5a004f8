"""`myograph view`: one whole page, or one sentence and no page."""

import json

import pytest
import typer

from myograph.anatomy.load import built_in_arm
from myograph.cli.view import view
from myograph.errors import InputError
from myograph.inference.model_file import MODEL_FILE, model_text, read_model_file
from myograph.view.page import read_arm_models
from tests.inference.low_rank.stand_in import save_arm, save_modes
from tests.view.page.arm import save_network

TEMPLATE = "<title>myograph</title>@@MYOGRAPH_DATA@@|@@MYOGRAPH_NUMBERS@@<!--@@MYOGRAPH_RUNTIME@@-->"


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    return save_arm(tmp_path_factory.mktemp("models") / "arm")


@pytest.fixture
def call(capsys, monkeypatch):
    monkeypatch.setattr("myograph.cli.view.read_template", lambda: TEMPLATE)
    app = typer.Typer()
    app.command()(view)

    def said(*words):
        app([str(word) for word in words], standalone_mode=False)
        return capsys.readouterr().out

    return said


def refused(call, out, *words):
    with pytest.raises(InputError) as problem:
        call(*words, "--out", out)
    assert not out.exists()
    assert list(out.parent.glob(f".{out.name}-*")) == []
    return str(problem.value)


def test_it_writes_one_file_and_says_what_is_in_it(call, arm, tmp_path):
    told = json.loads(call(arm, "--out", tmp_path / "page.html", "--json"))
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert told["bytes"] == len(text.encode())
    assert told["muscles"] == ["brachioradialis", "brachialis", "biceps", "anconeus", "triceps"]
    assert "@@" not in text
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]


def test_a_movement_is_put_into_the_page(call, arm, tmp_path):
    (tmp_path / "up.csv").write_text("time,biceps\n0,0\n2,1\n")
    told = json.loads(call(arm, "--movement", tmp_path / "up.csv", "--out", tmp_path / "page.html", "--json"))
    assert told["movement_s"] == 2
    assert any("no column for" in note for note in told["notes"])


def test_the_shipped_arm_is_taken_without_a_model(call, arm, tmp_path, monkeypatch):
    monkeypatch.setattr("myograph.cli.arm_model.models_folder", lambda: arm.parent)
    assert "left_arm" not in call("--out", tmp_path / "page.html")
    monkeypatch.setattr("myograph.cli.arm_model.models_folder", lambda: tmp_path / "none")
    assert "no arm of its own; expected MODEL" in refused(call, tmp_path / "other.html")


def test_a_network_is_put_beside_the_shipped_arm_or_beside_modes(call, arm, tmp_path, monkeypatch):
    models = read_arm_models(arm, built_in_arm())
    save_network(tmp_path / "net", models)
    monkeypatch.setattr("myograph.cli.arm_model.models_folder", lambda: arm.parent)
    monkeypatch.setattr("myograph.cli.view.read_runtime", lambda: "<runtime>")
    told = json.loads(call(tmp_path / "net", "--out", tmp_path / "page.html", "--json"))
    assert (told["network"], len(told["muscles"])) == ("mean", 5)
    assert (tmp_path / "page.html").read_text(encoding="utf-8").endswith("<runtime>")
    beside = json.loads(call(arm, "--network", tmp_path / "net", "--out", tmp_path / "other.html", "--json"))
    assert beside["network"] == "mean"
    words = (tmp_path / "net", "--network", tmp_path / "net")
    assert "expected neural modes beside --network" in refused(call, tmp_path / "third.html", *words)
    assert "shipped ones are arm, " in refused(call, tmp_path / "third.html", "gen-bicep")
    words = (arm, "--network", arm / "biceps")
    assert "expected a network that answers anywhere" in refused(call, tmp_path / "third.html", *words)
    monkeypatch.setattr("myograph.cli.view.read_runtime", missing)
    assert "no built page" in refused(call, tmp_path / "third.html", tmp_path / "net")


def missing():
    raise InputError("this installation has no built page")


def test_a_movement_of_unknown_muscles_is_refused(call, arm, tmp_path):
    (tmp_path / "up.csv").write_text("time,bicep\n0,0\n2,1\n")
    sentence = refused(call, tmp_path / "page.html", arm, "--movement", tmp_path / "up.csv")
    assert "unknown muscle 'bicep': did you mean 'biceps'?" in sentence


def test_a_model_of_another_version_is_refused(call, tmp_path):
    save_modes(tmp_path / "old")
    told = read_model_file(tmp_path / "old").model_copy(update={"schema_version": 99})
    (tmp_path / "old" / MODEL_FILE).write_text(model_text(told))
    assert "expected schema version 1, got 99" in refused(call, tmp_path / "page.html", tmp_path / "old")


def test_a_folder_without_models_and_one_as_the_page_are_refused(call, arm, tmp_path):
    assert "expected the folder of a saved model" in refused(call, tmp_path / "page.html", tmp_path / "nothing")
    with pytest.raises(InputError, match=r"expected a file such as page\.html, got the folder"):
        call(arm, "--out", tmp_path)
    assert "expected a file such as page.html, got" in refused(call, tmp_path / "page.txt", arm)
