"""One muscle in many cases: what is refused, what the checksum sees, what travels."""

import pickle

import numpy as np
import pytest

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.errors import InputError
from tests.ensemble.pairs.made_up import NODES, body, made_up


def arrays():
    draw = np.random.default_rng(0)
    return draw.uniform(size=(4, 5)), ["factorial"] * 4, {"position": draw.normal(size=(4, NODES, 3))}


def test_a_field_is_read_in_the_order_asked():
    activation, design, fields = arrays()
    cases = cases_in_memory("biceps", body(), activation, design, fields)
    np.testing.assert_array_equal(cases.values("position", np.array([2, 0, 2])), fields["position"][[2, 0, 2]])
    assert (len(cases), cases.nodes) == (4, NODES)


def test_cases_are_found_by_the_word_of_their_design():
    cases = made_up(factorial=6, off_grid=3, support=2)
    assert cases.named("off_grid").tolist() == [0, 1, 2]
    assert cases.named("off_grid", "support").tolist() == [0, 1, 2, 9, 10]
    assert cases.named("nothing").tolist() == []


def test_a_field_or_a_case_that_is_not_there_is_an_input_error():
    cases = made_up()
    with pytest.raises(InputError, match="one of the fields position, cauchy_stress, von_mises, got 'pressure'"):
        cases.values("pressure", np.array([0]))
    for number in (-1, 9):
        with pytest.raises(InputError, match="expected cases from 0 to 8"):
            cases.values("position", np.array([0, number]))


def test_arrays_that_do_not_fit_are_input_errors():
    activation, design, fields = arrays()
    with pytest.raises(InputError, match="a design word for each of 4 cases, got 3"):
        cases_in_memory("biceps", body(), activation, design[:3], fields)
    with pytest.raises(InputError, match=r"position: expected 4 cases of 20 nodes, got \(4, 19\)"):
        cases_in_memory("biceps", body(), activation, design, {"position": fields["position"][:, :19]})


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_input_errors(bad):
    activation, design, fields = arrays()
    fields["position"][1, 2, 0] = bad
    with pytest.raises(InputError, match="position: expected finite numbers"):
        cases_in_memory("biceps", body(), activation, design, fields)
    activation, design, fields = arrays()
    activation[3, 3] = bad
    with pytest.raises(InputError, match="activation: expected finite numbers"):
        cases_in_memory("biceps", body(), activation, design, fields)


def test_the_checksum_sees_any_change_of_what_learning_reads():
    def checksum(change=lambda activation, fields: None, place=body(), design=None):  # noqa: B008
        activation, words, fields = arrays()
        change(activation, fields)
        return cases_in_memory("biceps", place, activation, design or words, fields).checksum

    def moves(activation, fields):
        fields["position"][3, 7, 1] += 1e-9

    def activates(activation, fields):
        activation[3, 1] += 1e-9

    found = [checksum(), checksum(moves), checksum(activates), checksum(place=body(seed=6))]
    found.append(checksum(design=["factorial"] * 3 + ["off_grid"]))
    assert len(set(found)) == len(found)
    assert checksum() == found[0]


def test_cases_in_memory_travel_to_another_process():
    cases = made_up()
    there = pickle.loads(pickle.dumps(cases))
    np.testing.assert_array_equal(there.values("position", np.arange(9)), cases.values("position", np.arange(9)))
