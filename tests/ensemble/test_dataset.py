"""The labelled dataset: gathered, stored, read, refused."""

import numpy as np
import pytest

from myograph.case import MUSCLES, Solution
from myograph.ensemble.dataset import NODE_FIELDS, dataset_from_solutions, load_dataset, save_dataset
from myograph.ensemble.design import factorial_cases, off_grid_cases
from myograph.errors import InputError
from myograph.fields import FIELDS, von_mises

NODES = 7


def _solution(case, seed):
    random = np.random.default_rng(seed)
    fields = {
        name: random.normal(size=(NODES, *([len(c)] if (c := FIELDS[name].components) else []))) for name in NODE_FIELDS
    }
    return Solution(case, 1.0 + 0.01 * seed, dict.fromkeys(MUSCLES, 0.0), {"biceps": fields}, "table")


@pytest.fixture
def dataset():
    cases = [*factorial_cases(), *off_grid_cases(4, seed=1)]
    solutions = [_solution(case, k) for k, case in enumerate(cases)]
    body = (np.zeros((NODES, 3)), np.array([[0, 1, 2, 3]]))
    words = ["factorial"] * 32 + ["off_grid"] * 4
    return dataset_from_solutions(solutions, words, "biceps", body, {"preset": "tiny"})


def test_the_factorial_design_is_every_corner_once():
    corners = {case.activations for case in factorial_cases()}
    assert len(corners) == 32
    assert {value for corner in corners for value in corner} == {0.0, 1.0}


def test_off_grid_cases_are_inside_the_cube_and_follow_their_seed():
    first, again, other = off_grid_cases(20, 3), off_grid_cases(20, 3), off_grid_cases(20, 4)
    values = np.array([case.activations for case in first])
    assert first == again
    assert first != other
    assert ((values > 0) & (values < 1)).all()
    assert np.sort(np.floor(values * 20), axis=0) == pytest.approx(np.tile(np.arange(20)[:, None], 5))


def test_no_off_grid_cases_are_refused():
    with pytest.raises(InputError, match="expected at least 1, got 0"):
        off_grid_cases(0, 1)


def test_a_dataset_comes_back_as_it_was_written_without_leftovers(dataset, tmp_path):
    save_dataset(dataset, tmp_path / "biceps.zarr")
    save_dataset(dataset, tmp_path / "biceps.zarr")
    assert load_dataset(tmp_path / "biceps.zarr").identical(dataset)
    assert [path.name for path in tmp_path.iterdir()] == ["biceps.zarr"]


def test_variables_carry_their_units(dataset):
    assert dataset["position"].attrs["units"] == "mm"
    assert dataset["cauchy_stress"].dims == ("cases", "nodes", "voigt")
    assert list(dataset["muscles"].values) == list(MUSCLES)


def test_a_missing_damaged_or_foreign_dataset_is_refused(dataset, tmp_path):
    with pytest.raises(InputError, match="found none"):
        load_dataset(tmp_path / "none.zarr")
    (tmp_path / "broken.zarr").mkdir()
    with pytest.raises(InputError, match="not a readable dataset"):
        load_dataset(tmp_path / "broken.zarr")
    save_dataset(dataset.assign_attrs(schema=99), tmp_path / "new.zarr")
    with pytest.raises(InputError, match="expected dataset schema 1, got 99"):
        load_dataset(tmp_path / "new.zarr")


def test_a_place_that_cannot_be_written_is_refused(dataset, tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InputError, match="cannot be written"):
        save_dataset(dataset, tmp_path / "file" / "biceps.zarr")


@pytest.mark.parametrize("pressure", [0.0, 5.0])
def test_von_mises_ignores_pressure_and_knows_pure_shear_and_tension(pressure):
    tension = [2.0 + pressure, pressure, pressure, 0, 0, 0]
    shear = [pressure, pressure, pressure, 0, 0, 1.5]
    assert von_mises(np.array([tension, shear])) == pytest.approx([2.0, 1.5 * np.sqrt(3)])
