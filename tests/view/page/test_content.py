"""What is put into the page: numbers that unpack to the model's, ends of colours, notes; and what is refused."""

import base64
import json
from dataclasses import replace

import numpy as np
import pytest

from myograph.anatomy.load import arm_checksum, built_in_arm
from myograph.case import MUSCLES
from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.inference.shipped import models_folder
from myograph.inference.truth import read_truth, write_truth
from myograph.view.page import (
    PageArm,
    SolveTime,
    filled_page,
    page_content,
    read_template,
    read_truth_cases,
    shipped_solve_time,
)
from myograph.view.page.packing import Packer
from tests.view.page.arm import APART, CASES, make_arm, truth_folder, whole_content

FRAME = "<title>myograph</title>@@MYOGRAPH_DATA@@|@@MYOGRAPH_NUMBERS@@"
TYPES = {"f4": "<f4", "f8": "<f8", "i2": "<i2", "u2": "<u2", "u4": "<u4"}


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    return make_arm(tmp_path_factory.mktemp("arm") / "arm")


@pytest.fixture(scope="module")
def content(models, tmp_path_factory):
    return whole_content(models, tmp_path_factory.mktemp("truth"))


def unpacked(numbers, told):
    array = np.frombuffer(base64.b64decode(numbers), TYPES[told["type"]], int(np.prod(told["shape"])), told["at"])
    array = array.reshape(told["shape"])
    return array * np.array(told["scale"]).reshape(-1, *[1] * (array.ndim - 1)) if "scale" in told else array


def test_numbers_unpack_to_those_that_were_packed():
    packer = Packer()
    values = np.random.default_rng(0).normal(size=(4, 7, 3)) * np.array([1, 10, 0, 1e-3])[:, None, None]
    told = [packer.reals(values), packer.doubles(values), packer.compact(values), packer.integers(np.array([1, 70000]))]
    real, double, compact, whole = (unpacked(packer.text(), each) for each in told)
    np.testing.assert_array_equal(double, values)
    np.testing.assert_allclose(real, values, rtol=1e-6)
    assert (np.abs(compact - values) <= 1.6e-5 * np.abs(values).max(axis=(1, 2), keepdims=True)).all()
    assert whole.tolist() == [1, 70000]


def test_modes_of_the_page_are_the_models(models, content):
    data = json.loads(content.data)
    assert [body["name"] for body in data["bodies"]] == list(MUSCLES)
    body, muscle = data["bodies"][2], models.muscles["biceps"]
    nodes = unpacked(content.numbers, body["nodes"])
    np.testing.assert_array_equal(nodes, np.unique(muscle.skin))
    modes = unpacked(content.numbers, body["fields"]["cauchy_stress"]["modes"])
    np.testing.assert_allclose(modes, muscle.fields["cauchy_stress"].modes[:, nodes], rtol=1e-6, atol=1e-9)


def test_errors_are_offered_with_a_truth_only_and_the_time_of_a_solver_where_it_is_known(models, content):
    known = page_content(PageArm(models, solve=SolveTime(21.5, "finite elements", "of a test")))
    assert json.loads(known.data)["solve"] == {"seconds": 21.5, "what": "finite elements", "told": "of a test"}
    assert json.loads(content.data)["solve"] is None
    without = known.fields
    assert "error" in content.fields
    assert "stress_error" in content.fields
    assert "error" not in without
    assert {"muscle", "von_mises", "displacement", "deviation", "stress_deviation", "fibre_stretch"} <= set(without)


def test_nearly_all_errors_lie_below_the_end_of_their_colours(content):
    choice = next(each for each in json.loads(content.data)["fields"] if each["key"] == "error")
    assert choice["low"] == 0
    assert choice["high"] == pytest.approx(APART, rel=0.2)


def test_the_colours_of_the_fibre_stretch_end_as_far_below_as_above_one(content):
    choice = next(each for each in json.loads(content.data)["fields"] if each["key"] == "fibre_stretch")
    assert choice["unit"] == "1"
    assert (choice["low"] + choice["high"]) / 2 == pytest.approx(1)
    assert choice["low"] < 1


def test_the_time_of_a_solver_is_told_where_the_cases_know_it(models, tmp_path):
    times = {}
    for name, attributes in {
        "file": {"simulator": "direct", "preset": "quick", "seconds_per_case": "21.5"},
        "store": {"simulator": "table", "seconds": "10.0"},
        "older": {"simulator": "direct"},
        "foreign": {"simulator": "synthetic", "seconds": "10.0"},
        "broken": {"simulator": "direct", "seconds": "unknown"},
    }.items():
        folder = tmp_path / name
        folder.mkdir()
        cases = read_truth(truth_folder(folder, models) / "biceps.npz")
        write_truth(folder / "biceps.npz", replace(cases, attributes=attributes), np.arange(CASES), ("position",))
        for other in MUSCLES:
            if other != "biceps":
                (folder / f"{other}.npz").unlink()
        times[name] = PageArm(models, read_truth_cases(folder, models.muscles)).solve_time
    assert times["file"].seconds == 21.5
    assert times["file"].what == "finite elements"
    assert "size 'quick'" in times["file"].told
    assert (times["store"].seconds, times["store"].what) == (10.0 / CASES, "table")
    assert times["older"] is times["foreign"] is times["broken"] is None


def test_the_shipped_cases_tell_how_long_finite_elements_take_for_their_own_arm():
    checksum = arm_checksum(built_in_arm())
    if not (models_folder() / "truth" / "biceps.npz").is_file():
        pytest.skip("this installation has no cases of its own")
    found = shipped_solve_time("biceps", checksum)
    assert found is not None
    assert found.what == "finite elements"
    assert 1 < found.seconds < 1000
    assert shipped_solve_time("biceps", "another arm") is None
    assert shipped_solve_time("triceps", checksum) is None


def test_cases_of_the_truth_carry_its_positions(models, content):
    data = json.loads(content.data)
    assert len(data["truth"]) == CASES
    case, nodes = data["truth"][1], np.unique(models.muscles["triceps"].skin)
    wanted = models.muscles["triceps"].at(np.array(case["activation"]))["position"][nodes] + [0, APART, 0]
    np.testing.assert_allclose(unpacked(content.numbers, case["bodies"][4]["position"]), wanted, atol=1e-4)
    assert case["elbow_angle_deg"] == pytest.approx(np.degrees(1.25))


def test_another_arm_leaves_out_bones_and_says_so(models):
    content = page_content(PageArm(replace(models, arm=None)))
    assert json.loads(content.data)["bones"] == []
    assert any("no bones" in note for note in content.notes)


def test_thinned_and_missing_muscles_are_noted(models):
    fewer = replace(models, muscles={name: models.muscles[name] for name in ("biceps", "triceps")})
    notes = " ".join(page_content(PageArm(fewer), most_nodes=50).notes)
    assert "nodes of the surface are drawn" in notes
    assert "No model of brachioradialis, brachialis, anconeus" in notes


def test_large_arms_are_packed_into_half(models, monkeypatch):
    monkeypatch.setattr("myograph.view.page.content.SINGLE_BYTES", 1000)
    content = page_content(PageArm(models))
    field = json.loads(content.data)["bodies"][0]["fields"]["position"]
    assert field["modes"]["type"] == "i2"
    nodes = np.unique(models.muscles["brachioradialis"].skin)
    wanted = models.muscles["brachioradialis"].fields["position"].modes[:, nodes]
    np.testing.assert_allclose(unpacked(content.numbers, field["modes"]), wanted, atol=2e-5 * np.abs(wanted).max())


def test_a_body_without_a_skin_names_its_muscle(models):
    bare = replace(models.muscles["biceps"], skin=np.zeros((0, 4), dtype=np.int64))
    with pytest.raises(InputError, match="model of biceps: expected a body with a skin"):
        page_content(PageArm(replace(models, muscles={"biceps": bare})))


def test_no_text_of_the_data_can_end_its_element(models):
    told = {name: each.model_copy(update={"name": "</script><b>"}) for name, each in models.told.items()}
    content = page_content(PageArm(replace(models, told=told, name="</title>", arm=None)))
    page = filled_page(FRAME, content)
    assert "</script>" not in page
    assert "</title>" in page.replace("</title>@", "", 1)
    assert page.count("</title>") == 1


def test_a_truth_of_another_body_is_refused(models, tmp_path):
    muscle = models.muscles["biceps"]
    body = Body(muscle.reference + 1.0, muscle.skin, muscle.cells)
    cases = cases_in_memory("biceps", body, np.zeros((1, 5)), ["off_grid"], {"position": body.reference[None]})
    write_truth(tmp_path / "biceps.npz", cases, np.arange(1), ("position",))
    with pytest.raises(InputError, match="expected the body of biceps that the model knows"):
        read_truth_cases(tmp_path, models.muscles)


def test_a_truth_of_no_such_muscle_or_nothing_is_refused(models, tmp_path):
    truth_folder(tmp_path, models)
    only = {"biceps": models.muscles["biceps"]}
    with pytest.raises(InputError, match="expected cases of biceps, found none"):
        read_truth_cases(tmp_path / "triceps.npz", only)
    with pytest.raises(InputError, match="found nothing there"):
        read_truth_cases(tmp_path / "none", only)


def test_an_even_choice_of_cases_is_taken(models, tmp_path):
    found = read_truth_cases(truth_folder(tmp_path, models), models.muscles, most=3)
    assert [case.name.split(":")[0] for case in found] == ["off_grid 0", "off_grid 2", "off_grid 4"]


def test_a_template_that_is_missing_or_broken_says_what_to_do(monkeypatch):
    monkeypatch.setattr("myograph.view.page.template.TEMPLATE", "none.html")
    with pytest.raises(InputError, match=r"made without npm.*npm --prefix web run build"):
        read_template()
    monkeypatch.setattr("myograph.view.page.template.TEMPLATE", "packing.py")
    with pytest.raises(InputError, match="not the built page"):
        read_template()
