"""Simulators by name: the arm from its tables, and what is refused."""

import dataclasses

import numpy as np
import pytest

from myograph.case import MUSCLES, Case
from myograph.ensemble.simulators import describe_simulator, made_anew, make_bodies, make_simulator
from myograph.errors import InputError
from myograph.limb.direct_arm import DirectArm
from myograph.limb.tables.table_file import load_table, save_table, table_path
from tests.ensemble import synthetic
from tests.ensemble.tabulated import save_tables, spec


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    return save_tables(tmp_path_factory.mktemp("tables"))


def test_the_arm_from_its_tables_answers_on_its_bodies(tables):
    simulator, bodies = make_simulator(spec(tables)), make_bodies(spec(tables))
    solution = simulator(Case((0.5,) * 5, elbow_angle=1.0))
    for name, body in bodies.items():
        grown = 1 + 0.05 * np.sin(1.0)
        np.testing.assert_allclose(solution.fields[name]["position"], body.reference * grown, atol=0.05)
        assert body.skin.max() < len(body.reference)
        assert body.cells.max() == len(body.reference) - 1


def test_a_table_arm_does_not_remember_and_is_never_made_anew(tables):
    simulator = make_simulator(spec(tables))
    assert not spec(tables).remembers
    assert made_anew(simulator, spec(tables)) is simulator


def test_one_that_remembers_forgets_and_one_that_cannot_is_made_anew():
    remembering = synthetic.spec(synthetic.REMEMBERING)
    simulator = make_simulator(remembering)
    simulator(Case((1.0,) * 5))
    assert made_anew(simulator, remembering) is simulator
    assert simulator.before == 0.0
    plain = make_simulator(synthetic.spec())
    assert made_anew(plain, synthetic.spec()) is not plain


def test_what_answers_depend_on_has_no_place_in_it(tables):
    assert describe_simulator(spec(tables)) == describe_simulator(spec(str(tables) + "/."))
    assert describe_simulator(spec(tables)) != describe_simulator(spec(tables, gravity=False))
    assert set(describe_simulator(spec(tables))["tables"]) == set(MUSCLES)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"tables": None}, "expected a folder of tables"),
        ({"tables": "nowhere"}, "nowhere"),
        ({"preset": "quick"}, "expected a table of this arm of preset 'quick'"),
        ({"kind": "thing"}, "expected 'table', 'direct' or 'package.module:function', got 'thing'"),
        ({"kind": "os:getcwd"}, "simulator 'os:getcwd': TypeError"),
        ({"kind": "builtins:repr"}, "expected a callable with 'bodies', got str"),
    ],
)
def test_a_simulator_that_cannot_be_made_is_refused(tables, changes, words):
    with pytest.raises(InputError, match=words):
        make_simulator(spec(tables, **changes))


def test_tables_of_another_arm_are_refused(tables, tmp_path):
    for name in MUSCLES:
        other = dataclasses.replace(load_table(table_path(tables, name)), key="of another arm")
        save_table(other, table_path(tmp_path, name))
    with pytest.raises(InputError, match="got one of another arm or version"):
        make_simulator(spec(tmp_path))


def test_finite_elements_seek_equilibria_from_those_of_tables_where_there_are_some(tables, monkeypatch):
    made = {}

    class Spy(DirectArm):
        def __init__(self, *_, guess=None, **__):
            made["guess"] = guess

    monkeypatch.setattr("myograph.limb.direct_arm.DirectArm", Spy)
    make_simulator(spec(tables, kind="direct", preset="quick", tables=None))
    assert made["guess"] is None
    make_simulator(spec(tables, kind="direct", preset="quick"))
    case = Case((0.2, 0.4, 0.1, 0.9, 0.6))
    assert made["guess"](case) == make_simulator(spec(tables))(case).elbow_angle


def test_answers_of_finite_elements_depend_on_the_tables_they_start_from(tables):
    alone = describe_simulator(spec(tables, kind="direct", tables=None))
    helped = describe_simulator(spec(tables, kind="direct"))
    assert alone["tables"] == {}
    assert helped["tables"] == describe_simulator(spec(tables))["tables"]
