"""A muscle's table between its states: values, derivatives, failures."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError, NotConvergedError
from myograph.fields import von_mises
from myograph.limb.moment import MuscleMoment
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.table import TOLERANCES
from tests.limb.conftest import NODES, FormulaStates, formula_table

NODE = np.arange(NODES)


def wavy(reference, angle, activation):
    """Every node goes its own way: as many modes as states."""
    shift = np.sin(angle * (1 + NODE / 5) + activation * NODE)[:, None]
    fields = {
        "position": reference + 3 * shift * np.array([1.0, -0.5, 0.2]),
        "cauchy_stress": shift * np.arange(1.0, 7) + activation,
        "fibre_stretch": 1 + 0.1 * shift[:, 0],
        "pressure": -shift[:, 0] * activation,
    }
    return 1e4 * np.sin(2 * angle) * np.exp(activation), fields


@pytest.fixture(scope="module")
def wavy_table():
    return built(FormulaStates(built_in_arm(), "biceps", wavy), TableSpec.regular(3))


def test_states_come_back_to_the_tolerances_of_the_compression(wavy_table):
    for angle, activation in wavy_table.points.tolist():
        moment, fields = wavy(wavy_table.reference, angle, activation)
        found = wavy_table.at(angle, activation)
        for name, tolerance in TOLERANCES.items():
            assert np.abs(found[name] - fields[name]).max() <= tolerance * (1 + 1e-6), name
        assert wavy_table.moment(np.array([angle]), activation)[0] == pytest.approx(moment, abs=1e-6)
    assert wavy_table.size == 49


def test_few_modes_suffice_where_all_nodes_move_together():
    table = formula_table(built_in_arm(), "biceps")
    assert {name: len(modes.vectors) for name, modes in table.modes.items()} == {
        "position": 1, "cauchy_stress": 1, "fibre_stretch": 1, "pressure": 0,
    }  # fmt: skip


def test_the_gradient_of_the_moment_is_its_derivative(wavy_table):
    angle, activation, step = 1.1, 0.37, 1e-5
    value, by_angle, by_activation = wavy_table.moment_gradient(angle, activation)

    def moment(angle, activation):
        return float(wavy_table.moment(np.array([angle]), activation)[0])

    assert value == pytest.approx(moment(angle, activation), rel=1e-12)
    slopes = (
        (moment(angle + step, activation) - moment(angle - step, activation)) / (2 * step),
        (moment(angle, activation + step) - moment(angle, activation - step)) / (2 * step),
    )
    assert (by_angle, by_activation) == pytest.approx(slopes, rel=1e-6)


def test_one_field_is_the_same_as_among_all(wavy_table):
    fields = wavy_table.at(0.9, 0.4)
    for name, values in fields.items():
        assert np.array_equal(wavy_table.field(name, 0.9, 0.4), values)
    assert fields["von_mises"] == pytest.approx(von_mises(fields["cauchy_stress"]))
    assert isinstance(wavy_table, MuscleMoment)


def test_outside_the_box_there_is_no_answer(wavy_table):
    with pytest.raises(InputError, match=r"expected coordinate 1 from 0 to 1, got 1\.1"):
        wavy_table.at(0.9, 1.1)
    with pytest.raises(InputError):
        wavy_table.moment(np.array([3.0]), 0.5)


def test_a_failed_state_is_kept_with_its_reason_and_the_table_does_not_pretend():
    states = FormulaStates(built_in_arm(), "biceps", fails=lambda angle, activation: angle > 2.5 and activation == 0.0)
    table = built(states, TableSpec.regular(2))
    assert table.failures == 1
    assert set(table.record.failures) == {"", "an element turned inside out"}
    for use in (table.require_complete, lambda: table.at(1.0, 0.5), lambda: table.moment(np.array([1.0]), 0.5)):
        with pytest.raises(NotConvergedError, match=r"biceps: 1 of 21 states failed, at .*150\.0°, 0\); the first: an"):
            use()
