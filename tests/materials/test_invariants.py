"""Invariants against tensors written out."""

import numpy as np
import pytest

from myograph.materials.invariants import Invariants, invariants
from tests.materials.cases import FAR, FIBRE


def _values(at):
    return [float(value) for value in (at.I1, at.I2, at.I4, at.I5, at.J)]


def test_of_principal_stretches_they_are_the_symmetric_functions():
    a, b, c = np.array([1.3, 0.9, 0.8]) ** 2
    at = invariants(np.sqrt(np.diag([a, b, c])), np.array([0.0, 1.0, 0.0]))
    assert _values(at) == pytest.approx([a + b + c, a * b + b * c + c * a, b, b * b, np.sqrt(a * b * c)])


def test_isochoric_ones_are_those_of_the_deformation_without_its_volume():
    J = np.linalg.det(FAR)
    assert _values(invariants(FAR, FIBRE).isochoric()) == pytest.approx(_values(invariants(J ** (-1 / 3) * FAR, FIBRE)))


def test_pre_stretched_ones_are_those_of_the_product_with_the_pre_stretch():
    l0 = 1.37
    G0 = l0**-0.5 * np.eye(3) + (l0 - l0**-0.5) * np.outer(FIBRE, FIBRE)
    assert np.linalg.det(G0) == pytest.approx(1.0)
    assert _values(invariants(FAR, FIBRE).prestretched(l0)) == pytest.approx(_values(invariants(FAR @ G0, FIBRE)))


def test_no_pre_stretch_changes_nothing():
    at = invariants(FAR, FIBRE)
    assert isinstance(at, Invariants)
    assert _values(at.prestretched(1.0)) == pytest.approx(_values(at))
