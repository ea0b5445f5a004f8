"""Activations over time from CSV and from OpenSim's .sto; every mistake is named with file and line."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.limb.motion.activation_file import Activations, read_activations

MUSCLES = ("brachialis", "biceps", "triceps")
CSV = "time,triceps,biceps,brachialis\n0,0,0.5,0\n0.25,0.1,0.75,0.2\n1,1,0.5,0\n"
STO = (
    "activations\nversion=1\nnRows=3\nnColumns=4\ninDegrees=no\nendheader\n"
    "time\ttriceps\tbiceps\tbrachialis\n0\t0\t0.5\t0\n0.25\t0.1\t0.75\t0.2\n1\t1\t0.5\t0\n"
)


def _read(tmp_path, text, name="a.csv", renamed=None):
    path = tmp_path / name
    path.write_text(text)
    return read_activations(path, MUSCLES, renamed)


@pytest.mark.parametrize(
    ("text", "name"),
    [
        (CSV, "a.csv"),
        (STO, "a.sto"),
        (STO.replace("\t", "   "), "A.STO"),
        ("# made by hand\n" + CSV.replace("\n", "\r\n"), "a.csv"),
        ("\ufeff" + CSV.replace(",", " , ") + "\n\n", "a.csv"),
        (CSV.replace("time", '"Time"'), "a.csv"),
    ],
)
def test_csv_and_sto_give_the_same_in_the_order_of_the_limb(tmp_path, text, name):
    found = _read(tmp_path, text, name)
    assert found.muscles == MUSCLES
    assert found.times.tolist() == [0.0, 0.25, 1.0]
    assert found.values.tolist() == [[0.0, 0.5, 0.0], [0.2, 0.75, 0.1], [0.0, 0.5, 1.0]]
    assert found.notes == ()


def test_a_muscle_without_a_column_is_at_rest_and_noted(tmp_path):
    found = _read(tmp_path, "time,biceps\n0,0.1\n1,0.2\n")
    assert found.values[:, [0, 2]].tolist() == [[0, 0], [0, 0]]
    assert found.notes == ("no column for brachialis, triceps: taken as 0",)


def test_other_names_are_mapped_and_columns_left_out(tmp_path):
    text = CSV.replace("biceps", "/forceset/BIClong/activation").replace("brachialis", "deltoid")
    found = _read(tmp_path, text, renamed={"/forceset/BIClong/activation": "biceps", "deltoid": ""})
    assert found.values[:, 1].tolist() == [0.5, 0.75, 0.5]
    assert found.values[:, 0].tolist() == [0, 0, 0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", r"a.csv: expected a header 'time,brachialis,biceps,triceps' and rows, got an empty file"),
        ("t,biceps\n0,0\n1,0\n", "line 1: expected the first column to be 'time', got 't'"),
        ("time,bicep\n0,0\n1,0\n", "line 1: unknown muscle 'bicep': did you mean 'biceps'"),
        ("time,quadriceps_x\n0,0\n1,0\n", "line 1: unknown muscle 'quadriceps_x'"),
        ("time,biceps,biceps\n0,0,0\n1,0,0\n", "line 1: expected one column for biceps, got two"),
        ("time\n0\n1\n", "line 1: expected a column of a muscle"),
        ("time,biceps\n0,0\n", "expected at least 2 rows of numbers, got 1"),
        ("time,biceps\n0,0\n1,0.5\n1,0.6\n", r"line 4: expected a time after 1 s \(line 3\), got 1"),
        ("time,biceps\n0,0\n1,0.5\n0.5,0.6\n", r"line 4: expected a time after 1 s \(line 3\), got 0.5"),
        ("time,biceps\n0,0\n1,\n2,0\n", "line 3: biceps: expected a number, got ''"),
        ("time,biceps\n0,0\n1,NaN\n2,0\n", "line 3: biceps: expected a number, got 'NaN'"),
        ("time,biceps\n0,0\nsoon,0\n2,0\n", "line 3: time: expected a number, got 'soon'"),
        ("time,biceps\n0,0\n1,inf\n", "line 3: biceps: expected a number, got 'inf'"),
        ("time,biceps\n0,0\n\n1,1.01\n", r"line 4: biceps: expected an activation in \[0, 1\], got 1.01"),
        ("time,biceps\n0,-0.1\n1,0\n", r"line 2: biceps: expected an activation in \[0, 1\], got -0.1"),
        ("time,biceps\n0,0,0\n1,0\n", "line 2: expected 2 cells, got 3"),
    ],
)
def test_a_mistake_is_named_with_its_line(tmp_path, text, words):
    with pytest.raises(InputError, match=f"a.csv.*{words}|{words}"):
        _read(tmp_path, text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (STO.replace("endheader\n", ""), "a.sto: expected a line 'endheader'"),
        (STO.replace("nRows=3", "nRows=4"), "a.sto, line 3: expected 4 rows, got 3"),
        (STO.replace("0.75", "2"), r"a.sto, line 9: biceps: expected an activation in \[0, 1\], got 2"),
    ],
)
def test_a_mistake_in_an_sto_is_named_with_its_line(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        _read(tmp_path, text, "a.sto")


def test_a_map_of_a_column_that_is_not_there_and_a_file_that_is_not_there_are_refused(tmp_path):
    with pytest.raises(InputError, match="expected a column 'BIC', as the map says, got none"):
        _read(tmp_path, CSV, renamed={"BIC": "biceps"})
    with pytest.raises(InputError, match=r"none.csv: cannot be read as text"):
        read_activations(tmp_path / "none.csv", MUSCLES)
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(InputError, match=r"binary.csv: cannot be read as text"):
        read_activations(tmp_path / "binary.csv", MUSCLES)


def test_between_the_rows_activations_are_linear_and_beyond_them_they_stay():
    given = Activations(("a",), np.array([1.0, 2.0, 4.0]), np.array([[0.0], [1.0], [0.5]]))
    assert [given.at(t)[0] for t in (0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 9.0)] == [0, 0, 0.5, 1, 0.75, 0.5, 0.5]


def test_rows_between_keep_the_given_ones_and_lie_on_the_lines():
    given = Activations(("a",), np.array([1.0, 2.0, 2.05]), np.array([[0.0], [1.0], [0.5]]))
    fine = given.every(0.3)
    assert fine.times == pytest.approx([1.0, 1.25, 1.5, 1.75, 2.0, 2.05])
    assert fine.values[:, 0] == pytest.approx([given.at(t)[0] for t in fine.times])
    with pytest.raises(InputError, match="step: expected a time above 0 s, got 0"):
        given.every(0.0)
