"""PLAID: what its own package reads is what was written."""

import logging
import sys

import numpy as np
import pytest

pytest.importorskip("plaid", reason="PLAID is written by pyplaid")

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.errors import InputError, MissingPackageError
from myograph.export.plaid import write_plaid

_CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 5), (2, 6), (3, 7), (4, 5), (5, 6), (6, 7), (7, 4)]
_FACES = [(0, 1, 2, 3), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (4, 5, 6, 7)]
HEXA_27 = np.array(
    [np.mean([_CORNERS[c] for c in of], axis=0) for of in [*[(c,) for c in range(8)], *_EDGES, *_FACES, range(8)]]
)
"""Places of the nodes as the CGNS standard numbers them."""


@pytest.fixture(scope="module")
def samples(cases, tmp_path_factory):
    from plaid.storage import init_from_disk

    out = tmp_path_factory.mktemp("plaid") / "dataset"
    assert write_plaid(out, cases, [4, 5, 9]) == 3
    return init_from_disk(str(out))[0]


def test_every_design_is_a_split_and_every_case_a_sample(samples, cases):
    assert {name: len(split) for name, split in samples.items()} == {"factorial": 1, "off_grid": 2}
    sample = samples["off_grid"][1]
    assert sample.get_global("case") == 9
    assert sample.get_global("elbow_angle") == 2
    assert sample.get_global("activation_biceps") == cases.activation[2, 2]
    np.testing.assert_array_equal(sample.get_nodes(), cases.body.reference)
    every = np.arange(3)
    np.testing.assert_array_equal(sample.get_field("von_mises"), cases.values("von_mises", every)[2])
    np.testing.assert_array_equal(sample.get_field("cauchy_stress_yz"), cases.values("cauchy_stress", every)[2, :, 3])
    moved = cases.values("position", every)[2] - cases.body.reference
    np.testing.assert_array_equal(sample.get_field("displacement_z"), moved[:, 2])


def test_elements_are_numbered_as_the_cgns_standard_says(samples, cases):
    [(kind, cells)] = samples["factorial"][0].get_elements().items()
    assert kind == "HEXA_27"
    for k, cell in enumerate(cells):
        np.testing.assert_allclose(cases.body.reference[cell] / 10 - [k, 0, 0], HEXA_27)


def test_the_root_logger_stays_as_it_was(cases, tmp_path):
    before = logging.getLogger().handlers[:]
    for name in [name for name in sys.modules if name == "plaid"]:
        sys.modules.pop(name)
    write_plaid(tmp_path / "out", cases, range(3))
    assert logging.getLogger().handlers == before


def test_an_older_dataset_is_replaced_and_anything_else_is_not(cases, tmp_path):
    write_plaid(tmp_path / "out", cases, range(3))
    write_plaid(tmp_path / "out", cases, range(3))
    (tmp_path / "mine").mkdir()
    with pytest.raises(InputError, match="expected a new folder or a PLAID dataset"):
        write_plaid(tmp_path / "mine", cases, range(3))


def test_a_body_without_elements_is_refused(cases, tmp_path):
    none = np.zeros((0, 4), int)
    bare = cases_in_memory(
        "biceps", Body(cases.body.reference, none, none), np.zeros((1, 5)), ["x"], {"position": np.zeros((1, 45, 3))}
    )
    with pytest.raises(InputError, match="expected a body of elements, which PLAID needs"):
        write_plaid(tmp_path / "out", bare, [0])


def test_without_pyplaid_the_extra_is_named(cases, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "plaid", None)
    with pytest.raises(MissingPackageError, match=r"myograph\[plaid\]"):
        write_plaid(tmp_path / "out", cases, range(3))
