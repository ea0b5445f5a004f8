"""Data of another program become the same store; what does not fit is refused and nothing is written."""

import sys

import numpy as np
import pytest

pytest.importorskip("meshio", reason="VTU files are written by meshio")
pytest.importorskip("h5py", reason="VTKHDF is written by h5py")

import h5py
import meshio

from myograph.ensemble.card.writing import CARD
from myograph.ensemble.importing.importing import import_store
from myograph.ensemble.simulators import make_bodies
from myograph.ensemble.store.checking import check_store
from myograph.ensemble.store.opening import open_muscle
from myograph.ensemble.store.plan import read_plan
from myograph.ensemble.store.reading import read_muscle
from myograph.errors import InputError, MissingPackageError
from myograph.export.steps import steps_of_cases
from myograph.export.vtkhdf import write_vtkhdf
from myograph.fields import VOIGT, von_mises
from myograph.mesh.vtk import to_vtk
from tests.export.conftest import box

BODY = box()
CASES, NODES = 4, len(BODY.reference)
ORDER = ("xx", "yy", "zz", "xy", "yz", "xz")
TABLE = """BIC,F,word,flexion,file
0.0,0,rest,30,a
0.5,0,grid,45,b
1.0,2.5,grid,60,c
0.25,0,,75,d
"""
MAPPING = """
name = "other program"
[cases]
file = "cases.csv"
columns = { biceps = "BIC", hand_load_n = "F", design = "word", elbow_angle_deg = "flexion" }
absent = 0.0
[muscles.biceps]
files = "biceps_{case:02d}.vtu"
reference = "rest.vtu"
[fields]
cauchy_stress = { array = "S", order = ["xx", "yy", "zz", "xy", "yz", "xz"] }
pressure = { array = "p" }
[units]
length_mm = 1000.0
stress_mpa = 1e-6
"""
DRAW = np.random.default_rng(8)
MOVED = DRAW.normal(size=(CASES, NODES, 3))
STRESS = DRAW.normal(size=(CASES, NODES, 6))
PRESSURE = DRAW.normal(size=(CASES, NODES))


def vtu(path, points, arrays):
    """In metres and pascals, nodes in VTK's order."""
    cells = [("hexahedron27", to_vtk(BODY.cells)), ("line", np.array([[0, 1]]))]
    meshio.Mesh(points / 1000, cells, point_data=arrays).write(path)


@pytest.fixture
def folder(tmp_path):
    """Files of another program, one for each case, and their mapping."""
    (tmp_path / "cases.csv").write_text(TABLE)
    (tmp_path / "mapping.toml").write_text(MAPPING)
    vtu(tmp_path / "rest.vtu", BODY.reference, {})
    columns = [VOIGT.index(name) for name in ORDER]
    for case in range(CASES):
        arrays = {"S": 1e6 * STRESS[case][:, columns], "p": 1e6 * PRESSURE[case][:, None], "u": MOVED[case] / 1000}
        vtu(tmp_path / f"biceps_{case:02d}.vtu", BODY.reference + MOVED[case], arrays)
    return tmp_path


def imported(folder, *changes):
    """The cases of the biceps of a new store, by a mapping with some of its words replaced."""
    text = (folder / "mapping.toml").read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "changed.toml").write_text(text)
    assert import_store(folder / "changed.toml", folder / "store", {"command": "a test"}) == CASES
    return read_muscle(folder / "store", "biceps")


def holds_what_the_other_program_said(cases, fields=("position", "cauchy_stress", "von_mises", "pressure")):
    every = np.arange(CASES)
    assert cases.fields == fields
    expected = {
        "position": BODY.reference + MOVED,
        "cauchy_stress": STRESS,
        "von_mises": von_mises(STRESS),
        "pressure": PRESSURE,
    }
    for name in fields:
        np.testing.assert_allclose(cases.values(name, every), expected[name], rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(cases.body.reference, BODY.reference, atol=1e-9)
    np.testing.assert_array_equal(cases.body.cells, BODY.cells)
    assert sorted(map(sorted, cases.body.skin.tolist())) == sorted(map(sorted, BODY.skin.tolist()))


def test_vtu_files_with_other_names_units_and_orders_become_a_store_that_can_be_learned(folder):
    cases = imported(folder)
    holds_what_the_other_program_said(cases)
    assert cases.activation[:, 2].tolist() == [0, 0.5, 1, 0.25]
    assert not cases.activation[:, [0, 1, 3, 4]].any()
    assert cases.hand_load.tolist() == [0, 0, 2.5, 0]
    np.testing.assert_allclose(np.degrees(cases.elbow_angle), [30, 45, 60, 75])
    assert cases.design == ("rest", "grid", "grid", "off_grid")


def test_the_store_passes_every_check_and_has_a_card(folder):
    imported(folder)
    plan = read_plan(folder / "store")
    assert not list(check_store(folder / "store", plan))
    assert plan.fields == ("position", "cauchy_stress", "von_mises", "pressure")
    assert np.isnan(open_muscle(folder / "store", "biceps")["moment"].values).all()
    text = (folder / "store" / CARD).read_text()
    assert text.startswith("# store\n")
    assert "imported as 'other program'" in text
    assert not [path for path in folder.iterdir() if path.name.startswith(".")]


def test_damage_to_imported_data_cannot_be_computed_again(folder):
    imported(folder)
    with pytest.raises(InputError, match="imported data cannot be computed again"):
        make_bodies(read_plan(folder / "store").simulator)


def test_displacements_need_no_reference(folder):
    changes = (
        ('reference = "rest.vtu"\n', ""),
        ("[fields]", '[fields]\nposition = { array = "u", displacement = true }'),
    )
    for case in range(CASES):
        vtu(folder / f"biceps_{case:02d}.vtu", BODY.reference, {"u": MOVED[case] / 1000, "p": 1e6 * PRESSURE[case]})
    stress = 'cauchy_stress = { array = "S", order = ["xx", "yy", "zz", "xy", "yz", "xz"] }\n'
    holds_what_the_other_program_said(imported(folder, *changes, (stress, "")), ("position", "pressure"))


def test_files_may_be_named_by_a_column_and_be_legacy_vtk(folder):
    for case, name in enumerate("abcd"):
        meshio.read(folder / f"biceps_{case:02d}.vtu").write(folder / f"{name}.vtk")
    holds_what_the_other_program_said(imported(folder, ("biceps_{case:02d}.vtu", "{file}.vtk")))


def full(stress):
    """3 x 3 matrices of Voigt components."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    return np.stack([np.stack(row, -1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], -2)


@pytest.mark.parametrize("together", [True, False])
def test_numpy_files_of_all_cases_or_of_one(folder, together):
    arrays = {"points": (BODY.reference + MOVED) / 1000, "S": 1e6 * full(STRESS), "p": 1e6 * PRESSURE}
    np.savez(folder / "rest.npz", points=BODY.reference / 1000, cells=to_vtk(BODY.cells))
    if together:
        np.savez(folder / "all.npz", **arrays)
    else:
        for case in range(CASES):
            np.savez(folder / f"c{case}.npz", **{name: values[case] for name, values in arrays.items()})
    files = "all.npz" if together else "c{case}.npz"
    holds_what_the_other_program_said(imported(folder, ("biceps_{case:02d}.vtu", files), ("rest.vtu", "rest.npz")))


def test_points_without_elements_are_a_store_too(folder):
    np.savez(folder / "rest.npz", points=BODY.reference / 1000)
    np.savez(folder / "all.npz", points=(BODY.reference + MOVED) / 1000, p=PRESSURE, S=STRESS)
    cases = imported(folder, ("biceps_{case:02d}.vtu", "all.npz"), ("rest.vtu", "rest.npz"))
    assert cases.body.cells.shape[0] == cases.body.skin.shape[0] == 0
    assert not list(check_store(folder / "store", read_plan(folder / "store")))


def test_what_is_exported_as_vtkhdf_comes_back_the_same(folder):
    first = imported(folder)
    write_vtkhdf(folder / "all.vtkhdf", {"biceps": first.body}, steps_of_cases(first))
    np.savez(folder / "rest.npz", points=first.body.reference, cells=to_vtk(first.body.cells))
    changes = (
        ("biceps_{case:02d}.vtu", "all.vtkhdf"), ("rest.vtu", "rest.npz"), ("1000.0", "1.0"), ("1e-6", "1.0"),
        ('"S"', '"cauchy_stress"'), ('"p"', '"pressure"'),
    )  # fmt: skip
    (folder / "store").rename(folder / "old")
    second = imported(folder, *changes)
    for name in first.fields:
        np.testing.assert_allclose(
            second.values(name, np.arange(CASES)), first.values(name, np.arange(CASES)), rtol=1e-6, atol=1e-7
        )


def spoil(folder, what):
    """Damage one thing; the words that must be said."""
    text, table = (folder / "mapping.toml").read_text(), (folder / "cases.csv").read_text()
    mapped = {
        "muscle": ("[muscles.biceps]", "[muscles.bicep]", "muscles: expected some of brachioradialis"),
        "key": ("pressure =", "presure =", "unknown key 'fields.presure'; did you mean 'pressure'?"),
        "order": ('"xy", "yz", "xz"]', '"xy", "yz", "yz"]', "order: expected xx, yy, zz, yz, xz, xy in some order"),
        "array": ('"p"', '"q"', "expected an array 'q' at the points, got S, p, u"),
        "column": ('"BIC"', '"BICEPS"', "got biceps = 'BICEPS'"),
        "name": ("{ biceps", "{ bicep", "got bicep = 'BIC'"),
        "absent": ("absent = 0.0", "", "expected a column for brachioradialis, brachialis, anconeus, triceps"),
        "files": ("{case:02d}", "{number}", "expected {case} or {COLUMN} of the table, got 'number'"),
        "braces": ("{case:02d}", "{case", "files 'biceps_{case.vtu'"),
        "none": ("biceps_{case:02d}", "nothing_{case}", "nothing_0.vtu: expected a file, found none there"),
        "together": ("biceps_{case:02d}", "biceps_00", "expected .npz or .vtkhdf for a file of all cases"),
        "suffix": ("rest.vtu", "cases.csv", "expected a file .vtu, .vtk, .vtkhdf or .npz, got '.csv'"),
        "reference": ('reference = "rest.vtu"', "", "expected 'reference', the file of the reference body"),
        "unit": ("1000.0", "0.0", "units.length_mm: Input should be greater than 0"),
        "bare": (
            '[muscles.biceps]\nfiles = "biceps_{case:02d}.vtu"\nreference = "rest.vtu"',
            "[muscles]",
            "got none",
        ),
    }
    tabled = {
        "range": ("1.0,2.5", "1.5,2.5", "line 4: activation of biceps: expected a number in [0, 1], got 1.5"),
        "word": ("0.5,0", "much,0", "line 3: could not convert string to float"),
        "angle": ("45,b", "nan,b", "line 3: elbow angle: expected a finite number or none, got nan"),
        "short": ("0.5,0,grid,45,b", "0.5,0,grid", "line 3: expected 5 columns"),
        "twice": ("1.0,2.5,grid,60", "0.5,0,grid,45", "expected every case once"),
        "empty": (TABLE[TABLE.index("\n") :], "\n", "expected at least one case, got none"),
    }
    if what in mapped:
        old, new, words = mapped[what]
        assert old in text
        (folder / "mapping.toml").write_text(text.replace(old, new))
    else:
        old, new, words = tabled[what]
        assert old in table
        (folder / "cases.csv").write_text(table.replace(old, new))
    return words


@pytest.mark.parametrize(
    "what",
    [
        "muscle",
        "key",
        "order",
        "array",
        "column",
        "name",
        "absent",
        "files",
        "braces",
        "none",
        "together",
        "suffix",
        "reference",
        "unit",
        "bare",
        "range",
        "word",
        "angle",
        "short",
        "twice",
        "empty",
    ],
)
def test_a_mapping_or_table_that_does_not_fit_is_refused_and_nothing_is_written(folder, what):
    words = spoil(folder, what)
    with pytest.raises(InputError) as refused:
        import_store(folder / "mapping.toml", folder / "store", {})
    assert words in str(refused.value)
    assert not (folder / "store").exists()


def with_last(folder, points=None, **arrays):
    """The file of the last case with other contents."""
    whole = {"S": STRESS[3], "p": PRESSURE[3], **arrays}
    vtu(folder / "biceps_03.vtu", BODY.reference if points is None else points, whole)


def other_elements(folder):
    cells = [("hexahedron27", to_vtk(BODY.cells[::-1]))]
    meshio.Mesh(BODY.reference, cells, point_data={"S": STRESS[3], "p": PRESSURE[3]}).write(folder / "biceps_03.vtu")


def wedges(folder):
    cells = [("wedge", np.arange(6)[None]), ("tetra", np.arange(4)[None])]
    meshio.Mesh(BODY.reference, cells).write(folder / "rest.vtu")


FILES = {
    "nan": (
        lambda f: with_last(f, p=np.where(np.arange(NODES) == 4, np.nan, 1.0)),
        "pressure: expected finite numbers, got 1",
    ),
    "huge": (lambda f: with_last(f, p=np.full(NODES, 1e60)), "biceps: pressure: expected finite numbers"),
    "stress": (lambda f: with_last(f, S=STRESS[3][:, :3]), "S: expected numbers of the shape (45, 6), got (45, 3)"),
    "infinite": (lambda f: with_last(f, points=BODY.reference * np.inf), "points: expected finite numbers"),
    "elements": (other_elements, "biceps_03.vtu: expected the elements of the reference body, got others"),
    "wedges": (wedges, "expected solid elements of one kind (tetra, hexahedron, tetra10"),
    "not vtu": (lambda f: (f / "rest.vtu").write_text("<VTK"), "rest.vtu: not a readable .vtu file"),
    "corners": (
        lambda f: meshio.Mesh(np.zeros((4, 3)), [("tetra", np.array([[0, 1, 2, 9]]))]).write(f / "rest.vtu"),
        "rest.vtu: cells: expected nodes from 0 to 3, got others",
    ),
    "point": (
        lambda f: meshio.Mesh(np.zeros((1, 3)), [("vertex", np.array([[0]]))]).write(f / "rest.vtu"),
        "points: expected places of three coordinates, got (1, 3)",
    ),
}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("what", FILES)
def test_files_that_do_not_fit_are_refused_and_nothing_is_written(folder, what):
    damage, words = FILES[what]
    damage(folder)
    with pytest.raises(InputError) as refused:
        import_store(folder / "mapping.toml", folder / "store", {})
    assert words in str(refused.value)
    assert not (folder / "store").exists()
    assert not [path for path in folder.iterdir() if path.name.startswith(".")]


def numpy_mapping(folder, reference="rest.npz", files="all.npz"):
    text = MAPPING.replace("biceps_{case:02d}.vtu", files).replace("rest.vtu", reference)
    (folder / "mapping.toml").write_text(text)


@pytest.mark.parametrize(
    ("arrays", "words"),
    [
        (
            {"points": MOVED[:2], "S": STRESS[:2], "p": PRESSURE[:2]},
            "expected a value for case 2 in every array, got fewer",
        ),
        ({"points": MOVED, "S": STRESS}, "expected an array 'p' at the points, got S"),
        (
            {"points": MOVED, "p": np.array([["much"] * NODES] * 4), "S": STRESS},
            "p: expected numbers of the shape (45,)",
        ),
        ({"S": STRESS, "p": PRESSURE}, "points: expected places of three coordinates, got none"),
        ({"points": MOVED, "p": np.array([{}] * 4), "S": STRESS}, "without pickled objects"),
    ],
)
def test_numpy_files_that_do_not_fit_are_refused(folder, arrays, words):
    np.savez(folder / "rest.npz", points=BODY.reference)
    np.savez(folder / "all.npz", **arrays)
    numpy_mapping(folder)
    with pytest.raises(InputError) as refused:
        import_store(folder / "mapping.toml", folder / "store", {})
    assert words in str(refused.value)


def test_elements_of_numpy_files_must_be_whole_numbers(folder):
    np.savez(folder / "rest.npz", points=BODY.reference, cells=np.zeros((2, 5), int))
    numpy_mapping(folder)
    with pytest.raises(InputError, match="cells: expected whole numbers, 4, 8, 10, 20 or 27 nodes each"):
        import_store(folder / "mapping.toml", folder / "store", {})


def hdf(folder, change):
    imported(folder)
    cases = read_muscle(folder / "store", "biceps")
    write_vtkhdf(folder / "all.vtkhdf", {"biceps": cases.body}, steps_of_cases(cases))
    with h5py.File(folder / "all.vtkhdf", "r+") as file:
        change(file["VTKHDF"])


def set_value(name, value):
    def change(root):
        root[name][...] = value

    return change


def set_kind(root):
    root.attrs["Type"] = np.bytes_("PolyData")


def set_steps(root):
    root["Steps"].attrs["NSteps"] = 2


def forget_points(root):
    del root["Points"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (set_kind, "expected one unstructured grid, got b'PolyData'"),
        (set_steps, "expected a step for case 2, got 2 steps"),
        (set_value("Steps/NumberOfParts", 2), "expected a grid in one part, got 2"),
        (forget_points, "not a readable VTKHDF file"),
        (set_value("Types", [29, 24]), r"expected elements of one kind, got VTK's types [24, 29]"),
    ],
)
def test_vtkhdf_files_that_do_not_fit_are_refused(folder, change, words):
    hdf(folder, change)
    numpy_mapping(folder, "rest.vtu", "all.vtkhdf")
    text = (folder / "mapping.toml").read_text()
    (folder / "mapping.toml").write_text(text.replace('"S"', '"cauchy_stress"').replace('"p"', '"pressure"'))
    with pytest.raises(InputError) as refused:
        import_store(folder / "mapping.toml", folder / "new", {})
    assert words in str(refused.value)


def test_a_folder_with_something_in_it_is_refused(folder):
    (folder / "store").mkdir()
    (folder / "store" / "thesis.txt").write_text("mine")
    with pytest.raises(InputError, match="expected a new folder, found something there"):
        import_store(folder / "mapping.toml", folder / "store", {})


@pytest.mark.parametrize(("package", "file"), [("meshio", "rest.vtu"), ("h5py", "rest.vtkhdf")])
def test_without_the_packages_the_extra_is_named(folder, monkeypatch, package, file):
    (folder / "rest.vtkhdf").write_bytes(b"")
    numpy_mapping(folder, file)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingPackageError, match=r"myograph\[export\]"):
        import_store(folder / "mapping.toml", folder / "store", {})
