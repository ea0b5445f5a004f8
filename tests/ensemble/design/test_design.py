"""Designs of experiments: how many cases, where they lie, which of them stay when more are asked."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.stats import qmc

from myograph.case import MUSCLES, Case
from myograph.ensemble.design import Design, DesignSpec, factorial_cases, make_design
from myograph.ensemble.design import points as cube
from myograph.errors import InputError
from myograph.units import radians


def made(*specs):
    return make_design([DesignSpec(**spec) for spec in specs])


@pytest.mark.parametrize(("step", "count"), [(1.0, 32), (0.5, 243), (0.25, 3125), (1 / 3, 1024)])
def test_a_full_factorial_has_every_combination_once(step, count):
    design = made({"method": "factorial", "step": step})
    assert len(design.cases) == count
    levels = {a for case in design.cases for a in case.activations}
    assert sorted(levels) == pytest.approx(np.arange(0, 1 + step / 2, step))
    assert set(design.words) == {"factorial"}


def test_a_finer_factorial_holds_the_coarser_one():
    assert set(factorial_cases()) <= set(made({"step": 0.5}).cases) <= set(made({"step": 0.25}).cases)


@pytest.mark.parametrize("step", [0.3, 0.0, -1.0, 2.0, float("nan")])
def test_a_step_that_does_not_divide_one_is_refused(step):
    with pytest.raises(InputError, match="step: expected 1 over a whole number"):
        made({"step": step})


def test_tenths_are_multiples_of_a_tenth_and_different():
    values = cube.tenths(5, 2000, 3)
    assert len({tuple(row) for row in values.tolist()}) == 2000
    assert {float(value) for value in values.ravel()} == {k / 10 for k in range(11)}


def test_all_tenths_of_one_dimension_can_be_had_and_not_one_more():
    assert sorted(cube.tenths(1, 11, 0).ravel().tolist()) == [k / 10 for k in range(11)]
    with pytest.raises(InputError, match="at most the 11 multiples"):
        cube.tenths(1, 12, 0)


@pytest.mark.parametrize("method", ["tenths", "sobol"])
def test_more_points_begin_with_the_fewer(method):
    few, many = getattr(cube, method)(5, 37, 7), getattr(cube, method)(5, 500, 7)
    np.testing.assert_array_equal(many[:37], few)


def test_a_finer_sparse_grid_begins_with_the_coarser_and_has_the_known_sizes():
    grids = [cube.sparse_grid(5, level) for level in (1, 2, 3, 4, 5)]
    assert [len(grid) for grid in grids] == [1, 11, 71, 351, 1471]
    for coarse, fine in pairwise(grids):
        np.testing.assert_array_equal(fine[: len(coarse)], coarse)


def test_a_latin_hypercube_has_one_point_in_every_slice():
    slices = np.floor(cube.latin_hypercube(5, 40, 2) * 40)
    np.testing.assert_array_equal(np.sort(slices, axis=0), np.tile(np.arange(40.0)[:, None], 5))


def test_sobol_points_are_more_even_than_random_ones():
    random = np.random.default_rng(0).random((256, 5))
    assert qmc.discrepancy(cube.sobol(5, 256, 0)) < 0.2 * qmc.discrepancy(random)


@pytest.mark.parametrize("method", ["tenths", "sobol", "latin_hypercube"])
def test_the_same_seed_makes_the_same_cases_and_another_seed_others(method):
    first, again, other = (made({"method": method, "count": 20, "seed": seed}) for seed in (1, 1, 2))
    assert first == again
    assert first.cases != other.cases
    assert set(first.words) == {"off_grid"}


def test_loads_and_angles_are_further_dimensions():
    design = made({"step": 1.0, "hand_load_n": (0.0, 20.0), "elbow_angle_deg": (30.0, 120.0)})
    assert len(design.cases) == 2**7
    assert {case.hand_load for case in design.cases} == {0.0, 20.0}
    assert {case.elbow_angle for case in design.cases} == {radians(30.0), radians(120.0)}


def test_a_single_load_and_angle_hold_for_all_cases():
    design = made({"method": "sobol", "count": 8, "hand_load_n": 12.0, "elbow_angle_deg": 90.0})
    assert {(case.hand_load, case.elbow_angle) for case in design.cases} == {(12.0, radians(90.0))}


def test_243_factorial_and_1500_other_tenths_are_1743_different_cases():
    design = made({"step": 0.5}, {"method": "tenths", "count": 1500, "seed": 1})
    assert len(set(design.cases)) == len(design.cases) == 1743
    assert design.words.count("factorial") == 243


def test_a_case_of_an_earlier_part_is_left_out_of_a_later_one():
    design = made({"method": "factorial", "step": 0.5}, {"method": "sparse_grid", "level": 2})
    assert len(design.cases) == 243 + 10


def test_a_case_that_comes_twice_is_refused():
    case = Case((0.0,) * 5)
    with pytest.raises(InputError, match="every case once, got case 0 again as case 1"):
        Design((case, case), ("a", "b"))


@pytest.mark.parametrize(
    ("spec", "words"),
    [
        ({"method": "sobol"}, "expected 'count'"),
        ({"method": "sparse_grid"}, "expected 'level'"),
        ({"method": "list"}, "expected 'file'"),
        ({"method": "sobol", "count": 4, "step": 0.5}, "unknown option 'step'"),
        ({"hand_load_n": (5.0, 5.0)}, "low below high"),
        ({"hand_load_n": float("inf")}, "hand_load_n: expected finite"),
        ({"step": 0.01}, "at most 1,000,000 cases"),
        ({"method": "sparse_grid", "level": 9}, "level: expected at most 8"),
        ({"method": "tenths", "count": 2_000_000}, "at most 1,000,000 cases"),
    ],
)
def test_a_design_that_does_not_fit_its_method_is_refused(spec, words):
    with pytest.raises(InputError, match=words):
        made(spec)


HEADER = ",".join(MUSCLES)


def listed(tmp_path, text):
    (tmp_path / "cases.csv").write_text(text)
    return made({"method": "list", "file": tmp_path / "cases.csv"})


def test_a_list_is_taken_as_it_is(tmp_path):
    design = listed(tmp_path, f"{HEADER},hand_load_n,elbow_angle_deg,design\n0,0.1,0.2,0.3,1,5,90,mine\n1,1,1,1,1,,,\n")
    assert design.cases == (Case((0.0, 0.1, 0.2, 0.3, 1.0), 5.0, radians(90)), Case((1.0,) * 5))
    assert design.words == ("mine", "off_grid")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "expected the columns brachioradialis"),
        (f"{HEADER},bycep\n0,0,0,0,0,0\n", "expected the columns"),
        (f"{HEADER}\n", "at least one case, got none"),
        (f"{HEADER}\n0,0,0,0,1.5\n", "line 2: activation of triceps"),
        (f"{HEADER}\n0,0,0,0,nan\n", "line 2: activation of triceps"),
        (f"{HEADER}\n0,0,0,0\n", "line 2: expected 5 columns, got another number"),
        (f"{HEADER}\n0,0,0,0,1,0.5\n", "line 2: expected 5 columns, got another number"),
        (f"{HEADER},elbow_angle_deg\n0,0,0,0,1,nan\n", "line 2: elbow angle: expected a finite number or none"),
        (f"{HEADER},elbow_angle_deg\n0,0,0,0,1,1e999\n", "line 2: elbow angle: expected a finite number or none"),
        (f"{HEADER}\n0,0,0,0,much\n", "line 2"),
        (f"{HEADER}\n0,0,0,0,1\n1,0,0,0,1\n0,0,0,0,1\n", "line 4: expected every case once, got that of line 2"),
    ],
)
def test_a_list_with_a_mistake_is_refused_with_its_line(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        listed(tmp_path, text)


def test_a_list_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(InputError, match="not a readable CSV file"):
        made({"method": "list", "file": tmp_path / "none.csv"})
