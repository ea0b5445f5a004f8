"""VTKHDF: what VTK itself reads is what was written, at every time."""

import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("h5py", reason="VTKHDF is written by h5py")

import h5py

from myograph.case import MUSCLES, Case, Solution
from myograph.ensemble.importing.vtkhdf import read_vtkhdf
from myograph.ensemble.spec import Body
from myograph.errors import InputError, MissingPackageError
from myograph.export.grid import grid_of
from myograph.export.steps import Step, steps_of_cases, steps_of_solutions
from myograph.export.vtkhdf import write_vtkhdf
from myograph.fields import VOIGT
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.vtk import KINDS

READ = """
import sys
import numpy as np
import pyvista
from vtkmodules import vtkCommonDataModel as cells
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

reader = vtkHDFReader()
reader.SetFileName(sys.argv[1])
reader.UpdateInformation()
times = reader.GetOutputInformation(0).Get(pipeline.TIME_STEPS())
found = {"times": times}
for k, time in enumerate(times):
    reader.UpdateTimeStep(time)
    grid = pyvista.wrap(reader.GetOutputDataObject(0))
    found[f"points{k}"] = grid.points
    found[f"volume{k}"] = grid.compute_cell_sizes()["Volume"].sum()
    found[f"muscle{k}"] = grid.cell_data["muscle"]
    found |= {f"{name}{k}": grid.point_data[name] for name in grid.point_data}
    found |= {f"{name}{k}": grid.field_data[name] for name in grid.field_data}
found["plain"] = pyvista.read(sys.argv[1]).n_points
for name in ("vtkTetra", "vtkHexahedron", "vtkQuadraticTetra", "vtkQuadraticHexahedron", "vtkTriQuadraticHexahedron"):
    cell = getattr(cells, name)()
    nodes = cell.GetNumberOfPoints()
    found[f"places{nodes}"] = np.reshape(cell.GetParametricCoords()[: 3 * nodes], (nodes, 3))
    found[f"type{nodes}"] = cell.GetCellType()
np.savez(sys.argv[2], **found)
"""


@pytest.fixture(scope="module")
def two_muscles(cases, tmp_path_factory):
    """Two muscles, the second one 100 mm further, at the times 0.5, 1 and 7 s."""
    beside = Body(cases.body.reference + 100, cases.body.skin, cases.body.cells)
    steps = [
        Step(
            time, {"biceps": one.fields["biceps"], "triceps": {**one.fields["biceps"], "position": moved}}, one.numbers
        )
        for time, one in zip((0.5, 1.0, 7.0), steps_of_cases(cases), strict=True)
        for moved in [one.fields["biceps"]["position"] + 100]
    ]
    path = tmp_path_factory.mktemp("vtkhdf") / "two.vtkhdf"
    assert write_vtkhdf(path, {"biceps": cases.body, "triceps": beside}, steps) == 3
    return path


@pytest.fixture(scope="module")
def read_by_vtk(two_muscles):
    """In a process of its own."""
    pytest.importorskip("vtkmodules", reason="VTK reads the file")
    out = two_muscles.with_suffix(".npz")
    done = subprocess.run([sys.executable, "-c", READ, two_muscles, out], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    with np.load(out, allow_pickle=False) as found:
        return dict(found)


def test_vtk_reads_times_moving_points_and_fields_as_they_were(read_by_vtk, cases):
    assert read_by_vtk["times"].tolist() == [0.5, 1.0, 7.0]
    every = np.arange(3)
    for k in range(3):
        position = cases.values("position", every)[k]
        np.testing.assert_allclose(read_by_vtk[f"points{k}"], np.vstack([position, position + 100]), rtol=1e-6)
        np.testing.assert_allclose(read_by_vtk[f"reference_position{k}"][:45], cases.body.reference)
        moved = position - cases.body.reference
        np.testing.assert_allclose(read_by_vtk[f"displacement{k}"], np.vstack([moved, moved]), atol=1e-5)
        for name in ("von_mises", "pressure"):
            np.testing.assert_allclose(read_by_vtk[f"{name}{k}"][45:], cases.values(name, every)[k], rtol=1e-6)
        np.testing.assert_allclose(read_by_vtk[f"activation{k}"].ravel(), cases.activation[k])
        assert read_by_vtk[f"elbow_angle{k}"].tolist() == [k]
        assert read_by_vtk[f"muscle{k}"].tolist() == [0, 0, 1, 1]
    assert read_by_vtk["plain"] == 90


def test_stress_is_in_the_order_that_paraview_names(read_by_vtk, cases):
    stress = cases.values("cauchy_stress", np.arange(3))[1]
    for column, name in enumerate(("xx", "yy", "zz", "xy", "yz", "xz")):
        np.testing.assert_allclose(read_by_vtk["cauchy_stress1"][:45, column], stress[:, VOIGT.index(name)], rtol=1e-6)


def test_vtk_sees_elements_that_fill_the_body(read_by_vtk, cases):
    for k, activation in enumerate(cases.activation[:, 2]):
        one, shifted = 2000 * (1 + activation) ** 3, 2000 * (1 + activation) ** 3
        assert read_by_vtk[f"volume{k}"] == pytest.approx(one + shifted, rel=1e-5)


@pytest.mark.parametrize("nodes", KINDS)
def test_nodes_are_numbered_as_vtk_numbers_them(read_by_vtk, nodes):
    assert read_by_vtk[f"type{nodes}"] == KINDS[nodes].vtk
    if nodes == 27:
        np.testing.assert_allclose(HEX27.nodes[list(KINDS[27].order)] / 2 + 0.5, read_by_vtk["places27"])
    for facet in KINDS[nodes].facets:
        places = read_by_vtk[f"places{nodes}"] if nodes != 27 else HEX27.nodes / 2 + 0.5
        a, b, c = places[list(facet)][list(KINDS[nodes].facet_quads[0][:3])]
        assert np.dot(np.cross(b - a, c - a), a - places.mean(axis=0)) > 0


def test_units_stand_beside_the_numbers(two_muscles):
    with h5py.File(two_muscles) as file:
        units = {name: data.attrs["units"] for name, data in file["VTKHDF/PointData"].items()}
        assert units["displacement"] == "mm"
        assert units["cauchy_stress"] == "MPa"
        assert list(file["VTKHDF/CellData/muscle"].attrs["meanings"]) == ["biceps", "triceps"]


def test_a_prediction_or_a_movement_is_written_from_solutions(cases, tmp_path):
    position = cases.values("position", np.arange(3))
    solutions = [
        Solution(Case((0.1,) * 5, 3.0), 1.5, {}, {name: {"position": p} for name in MUSCLES}, "x") for p in position
    ]
    bodies = dict.fromkeys(MUSCLES, cases.body)
    assert write_vtkhdf(tmp_path / "move.vtkhdf", bodies, steps_of_solutions([0.0, 0.1, 0.2], solutions)) == 3
    points, arrays, cells = read_vtkhdf(tmp_path / "move.vtkhdf", 2)
    np.testing.assert_allclose(points, np.vstack([position[2]] * 5), rtol=1e-6)
    assert set(arrays) == {"displacement", "reference_position"}
    assert cells.shape == (10, 27)


def test_bodies_without_elements_are_drawn_by_their_skin_or_their_points(cases):
    none = np.zeros((0, 4), int)
    skin = grid_of({"biceps": Body(cases.body.reference, np.array([[0, 1, 2, 3], [4, 5, 6, 6]]), none)})
    assert skin.types.tolist() == [9, 5]
    assert skin.offsets.tolist() == [0, 4, 7]
    assert grid_of({"biceps": Body(cases.body.reference, none, none)}).types.tolist() == [1] * 45
    with pytest.raises(InputError, match="the body of at least one muscle, got none"):
        grid_of({})


def steps_that_do_not_fit(cases):
    good = list(steps_of_cases(cases))
    short = {"biceps": {**good[1].fields["biceps"], "pressure": np.zeros(3)}}
    less = {"biceps": {"position": good[1].fields["biceps"]["position"]}}
    return {
        "none": ([], "expected at least one step, got none"),
        "shape": ([good[0], Step(1, short, good[1].numbers)], r"pressure: expected the shape \(45,\), got \(3,\)"),
        "fields": ([good[0], Step(1, less, good[1].numbers)], "time 1: expected the fields cauchy_stress, position"),
        "muscle": ([Step(0, {"triceps": {}}, {})], "expected the fields position of biceps"),
        "numbers": ([good[0], Step(1, good[1].fields, {})], "time 1: expected the numbers"),
    }


@pytest.mark.parametrize("what", ["none", "shape", "fields", "muscle", "numbers"])
def test_steps_that_do_not_fit_are_refused_and_nothing_is_left(cases, tmp_path, what):
    steps, words = steps_that_do_not_fit(cases)[what]
    with pytest.raises(InputError, match=words):
        write_vtkhdf(tmp_path / "x.vtkhdf", {"biceps": cases.body}, steps)
    assert not list(tmp_path.iterdir())


def test_another_file_is_not_replaced_but_an_older_export_is(cases, tmp_path):
    path = tmp_path / "x.vtkhdf"
    path.write_text("my thesis")
    with pytest.raises(InputError, match="expected a new file or one of the same kind"):
        write_vtkhdf(path, {"biceps": cases.body}, steps_of_cases(cases))
    assert path.read_text() == "my thesis"
    path.unlink()
    write_vtkhdf(path, {"biceps": cases.body}, list(steps_of_cases(cases))[:1])
    assert write_vtkhdf(path, {"biceps": cases.body}, steps_of_cases(cases, [5, 7, 9])) == 3
    with h5py.File(path) as file:
        assert file["VTKHDF/Steps/Values"][:].tolist() == [5, 7, 9]
    with pytest.raises(InputError, match="something else"):
        write_vtkhdf(tmp_path, {"biceps": cases.body}, steps_of_cases(cases))


def test_without_h5py_the_extra_is_named(cases, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[export\]"):
        write_vtkhdf(tmp_path / "x.vtkhdf", {"biceps": cases.body}, [])
