"""Files around a model: sensors in, answers out, the truth beside shipped models, the models themselves."""

import csv
import io
import os
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.inference.answer_file import write_answer
from myograph.inference.answers import answer_of
from myograph.inference.arrays import read_arrays
from myograph.inference.fitting import check_same_body
from myograph.inference.latency import forward_milliseconds
from myograph.inference.loaded import load
from myograph.inference.sensor_file import read_sensors
from myograph.inference.shipped import find_model, shipped_models, shipped_truth
from myograph.inference.truth import read_truth, write_truth
from tests.inference.stand_in import save_linear, save_mean, stand_in_cases

HEAD = "node,x_mm,y_mm,z_mm\n"


def test_sensors_are_read_by_node_and_by_place(tmp_path):
    path = tmp_path / "sensors.csv"
    path.write_text("z_mm,node,x_mm,y_mm\n3,7,1,2\n6,8,4,5\n")
    nodes, now = read_sensors(path)
    assert (nodes.tolist(), now.tolist()) == ([7, 8], [[1, 2, 3], [4, 5, 6]])
    path.write_text("place_x_mm,place_y_mm,place_z_mm,x_mm,y_mm,z_mm\n.5,0,10,1,2,3\n")
    places, now = read_sensors(path)
    assert (places.tolist(), now.tolist()) == ([[0.5, 0, 10]], [[1, 2, 3]])


def test_sensors_are_read_as_spreadsheets_write_them(tmp_path):
    (tmp_path / "s.csv").write_bytes(b"\xef\xbb\xbf" + f"{HEAD}7,1,2,3\n".replace("\n", "\r\n").encode())
    nodes, now = read_sensors(tmp_path / "s.csv")
    assert (nodes.tolist(), now.tolist()) == ([7], [[1, 2, 3]])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected the columns node, x_mm"),
        ("node,x,y,z\n", "got node, x, y, z"),
        ("node,node,x_mm,y_mm,z_mm\n", "each once"),
        (HEAD, "expected at least one sensor"),
        (HEAD + "1,2,3\n", "line 2: expected 4 columns"),
        (HEAD + "1,2,3,4,5\n", "line 2: expected 4 columns"),
        (HEAD + "1,,3,4\n", "line 2: expected a number in every column"),
        (HEAD + "4_6,2,3,4\n", "line 2: expected a number in every column"),
        (HEAD + "1e300,2,3,4\n", "line 2: expected the number of a node"),
        (HEAD + "1,2,3,4\n1,2,three,4\n", "line 3: expected a number"),
        (HEAD + "1,2,nan,4\n", "line 2: expected finite"),
        (HEAD + "1.5,2,3,4\n", r"line 2: expected the number of a node, got 1\.5"),
        ("\x80", "not a readable CSV file"),
    ],
)
def test_sensor_files_that_cannot_be_are_refused(tmp_path, text, message):
    (tmp_path / "s.csv").write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError, match=message):
        read_sensors(tmp_path / "s.csv")


def test_answers_are_written_as_they_are(tmp_path, linear):
    answer = linear.predict_activation([[0, 0, 1, 0, 0], [1, 0, 0, 0, 0]])
    write_answer(tmp_path / "a.npz", answer, linear.body)
    with np.load(tmp_path / "a.npz", allow_pickle=False) as arrays:
        np.testing.assert_array_equal(arrays["position"], answer.values["position"])
        assert arrays["inside"].tolist() == [True, True]
    write_answer(tmp_path / "a.csv", answer, linear.body)
    with (tmp_path / "a.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 80
    assert (rows[43]["case"], rows[43]["node"]) == ("1", "3")
    assert float(rows[43]["position_z_mm"]) == pytest.approx(answer.values["position"][1, 3, 2], rel=1e-6)
    assert float(rows[43]["von_mises_mpa"]) == pytest.approx(answer.values["von_mises"][1, 3], rel=1e-6)
    assert float(rows[43]["position_half_width_90_mm"]) == 0.25
    assert list(rows[43])[-1] == "inside"
    assert {row["inside"] for row in rows} == {"1"}
    write_answer(tmp_path / "a.csv", replace(answer, inside=None), linear.body)
    assert "inside" not in (tmp_path / "a.csv").read_text().splitlines()[0]


def test_answers_go_to_known_kinds_of_files(tmp_path, linear):
    with pytest.raises(InputError, match=r"ends in \.csv, \.npz, got '\.xlsx'"):
        write_answer(tmp_path / "a.xlsx", linear.predict_activation([0] * 5), linear.body)


def test_cauchy_stress_brings_von_mises_stress_along():
    pulled = np.zeros((1, 1, 6), dtype=np.float32)
    pulled[..., 0] = 2.0  # MPa along x: von Mises stress is the same
    assert answer_of({"cauchy_stress": pulled}).values["von_mises"].tolist() == [[2.0]]


def test_the_truth_comes_back_to_what_it_is_rounded_to(tmp_path):
    cases, chosen = stand_in_cases(), np.array([3, 33, 34])
    write_truth(tmp_path / "biceps.npz", cases, chosen, ("position", "von_mises"))
    found = read_truth(tmp_path / "biceps.npz")
    assert (found.muscle, found.design) == ("biceps", ("factorial", "off_grid", "off_grid"))
    np.testing.assert_array_equal(found.activation, cases.activation[chosen])
    everything = np.arange(3)
    for name, finest in (("position", 2.0**-13), ("von_mises", 2.0**-16)):
        expected = cases.values(name, chosen)
        single = np.abs(expected).max() * 2.0**-24
        np.testing.assert_allclose(found.values(name, everything), expected, rtol=0, atol=finest / 2 + single)


def _changed(path, **other):
    with np.load(path) as arrays:
        found = {**arrays, **other}
    np.savez(path, **{name: array for name, array in found.items() if array is not None})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"schema": np.array(2)}, "expected schema 1, got 2"),
        ({"activation": None}, "found no activation"),
        ({"field_taste": np.zeros(3)}, "unknown fields taste"),
        ({"muscle": np.array("calf")}, "unknown muscle 'calf'"),
        ({"field_position": np.full((3, 40, 3), np.nan)}, "expected finite"),
        ({"design": np.array("factorial")}, r"design: expected shape \(3,\) of kind 'U'"),
        ({"hand_load": np.zeros(2)}, r"hand_load: expected shape \(3,\)"),
        ({"elbow_angle": np.zeros(2)}, r"elbow_angle: expected shape \(3,\)"),
        ({"activation": np.full((3, 5), "a")}, "activation: expected .* of kind 'f'"),
        ({"activation": np.zeros(3)}, r"activation: expected shape \(None, 5\)"),
        ({"reference": np.array(0.0)}, r"reference: expected shape \(None, 3\)"),
        ({"field_position": np.zeros((3, 40))}, r"field_position: expected shape \(3, 40, 3\)"),
        ({"reference": np.zeros((0, 3))}, "expected cases of a body of nodes, got 3 cases of 0 nodes"),
        ({"skin": np.full((1, 4), 40)}, "skin: expected nodes from 0 to 39"),
        ({"seconds": np.zeros(2)}, r"seconds: expected shape \(\)"),
    ],
)
def test_a_truth_that_does_not_fit_itself_is_refused(tmp_path, change, message):
    write_truth(tmp_path / "t.npz", stand_in_cases(), np.array([3, 33, 34]), ("position",))
    _changed(tmp_path / "t.npz", **change)
    with pytest.raises(InputError, match=message):
        read_truth(tmp_path / "t.npz")


def test_a_truth_that_is_none_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_truth(tmp_path / "none.npz")
    (tmp_path / "none.npz").write_text("PK")
    with pytest.raises(InputError, match="not a file of plain arrays"):
        read_truth(tmp_path / "none.npz")


@pytest.mark.skipif(os.name == "nt", reason="needs devices that are files")
def test_a_truth_that_is_a_device_is_not_read(tmp_path):
    (tmp_path / "zero.npz").symlink_to("/dev/zero")
    with pytest.raises(InputError, match="expected a plain file"):
        read_truth(tmp_path / "zero.npz")


def _npy(header, data=b""):
    """The bytes of an .npy file with that header, whatever it promises."""
    text = header.ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text.encode() + data


def _npz(member):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as packed:
        packed.writestr("a.npy", member)
    return file.getvalue()


@pytest.mark.parametrize(
    "data",
    [
        _npz(_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (4398046511104, 3)}", b"1234")),
        _npz(_npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3,)}", b"1234")),
        _npz(_npy("{'descr': '|O', 'fortran_order': False, 'shape': (1,)}", b"12345678")),
        _npz(_npy("{'descr': '<f4', 'fortran_order'")),
        _npz(b"no array"),
        _npz(b"no array").replace(b"\x00\x00\x00\x00", b"\x01\x00\x63\x00"),
    ],
    ids=["promises too much", "promises more", "pickled", "broken header", "no array", "encrypted, unknown packing"],
)
def test_arrays_that_are_not_what_they_say_are_refused_before_memory_is_taken(data):
    with pytest.raises(InputError, match="not a file of plain arrays"):
        read_arrays(data, "a.npz", 2**20)


@pytest.fixture
def shipped(tmp_path, monkeypatch):
    monkeypatch.setattr("myograph.inference.shipped.models_folder", lambda: tmp_path / "models")
    return tmp_path / "models"


def test_without_shipped_models_that_is_said(shipped):
    assert shipped_models() == {}
    with pytest.raises(InputError, match="has no models of its own"):
        find_model(None)
    with pytest.raises(InputError, match="has no cases of biceps"):
        shipped_truth("biceps")


def test_the_shipped_model_that_answers_what_is_asked_is_found(shipped, tmp_path):
    save_linear(shipped / "any_triceps", muscle="triceps")
    save_linear(shipped / "from_activation")
    save_mean(shipped / "from_sensors")
    (shipped / "truth").mkdir()
    write_truth(shipped / "truth" / "biceps.npz", stand_in_cases(), np.arange(2), ("position",))
    assert find_model(None) == shipped / "from_activation"
    assert find_model(None, from_sensors=True) == shipped / "from_sensors"
    assert find_model("any_triceps") == shipped / "any_triceps"
    assert find_model(str(shipped / "from_sensors")) == shipped / "from_sensors"
    assert len(shipped_truth("biceps")) == 2
    with pytest.raises(InputError, match="shipped ones are any_triceps, from_activation, from_sensors"):
        find_model("nothing")


def test_a_folder_without_a_model_does_not_hide_a_shipped_one(shipped, tmp_path, monkeypatch):
    save_linear(shipped / "biceps")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "biceps").mkdir()
    assert find_model("biceps") == shipped / "biceps"
    with pytest.raises(InputError, match="found no"):
        load(tmp_path / "biceps")
    (tmp_path / "biceps").rmdir()
    save_linear(tmp_path / "biceps")
    assert find_model("biceps") == Path("biceps")
    with pytest.raises(InputError, match="cannot be read"):
        find_model("x" * 5000)


def test_models_of_an_arm_come_after_single_ones_and_have_a_truth_of_their_own_body(shipped):
    save_linear(shipped / "arm" / "biceps")
    save_linear(shipped / "finer")
    (shipped / "truth" / "arm").mkdir(parents=True)
    write_truth(shipped / "truth" / "arm" / "biceps.npz", stand_in_cases(), np.arange(2), ("position",))
    assert list(shipped_models()) == ["finer", "arm/biceps"]
    assert find_model(None) == shipped / "finer"
    assert find_model("arm/biceps") == shipped / "arm" / "biceps"
    assert len(shipped_truth("biceps", nodes=40)) == 2
    with pytest.raises(InputError, match="a body of 41 nodes, only of 40"):
        shipped_truth("biceps", nodes=41)


def test_positions_of_a_truth_are_kept_to_a_ten_thousandth_of_a_millimetre(tmp_path):
    cases = stand_in_cases()
    write_truth(tmp_path / "truth.npz", cases, np.arange(3), ("position",))
    kept = read_truth(tmp_path / "truth.npz").values("position", np.arange(3))
    assert np.abs(kept - cases.values("position", np.arange(3))).max() <= 2**-14
    assert not np.mod(kept * 2**13, 1).any()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda c: stand_in_cases("triceps"), "expected cases of biceps, got those of triceps"),
        (lambda c: _with(c, attributes={"arm_checksum": "b"}), "expected cases of the arm a, got those of b"),
        (lambda c: _with(c, reference=c.body.reference[:-1]), "expected a body of 40 nodes, got 39"),
        (lambda c: _with(c, reference=c.body.reference + np.array([1.0, 0, 0])), "nodes are up to 1 mm elsewhere"),
    ],
)
def test_cases_of_another_body_are_refused(linear, change, message):
    with pytest.raises(InputError, match=message):
        check_same_body(linear, change(stand_in_cases()))


def _with(cases, reference=None, **other):
    body = cases.body if reference is None else type(cases.body)(reference, cases.body.skin, cases.body.cells)
    return type(cases)(**{**vars(cases), "body": body, **other})


def test_one_pass_takes_milliseconds(linear, mean):
    assert 0 < forward_milliseconds(linear, repeats=3) < 1000
    assert 0 < forward_milliseconds(mean, repeats=3) < 1000
