"""Volumes of predicted shapes."""

import numpy as np
import pytest

from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.learning.modes.volume import fixed_nodes, volume_ratios
from myograph.mesh.hexahedra import HEX27
from myograph.mesh.tetrahedra import TET10

SKIN = np.zeros((0, 4), dtype=np.int64)


def bent(element):
    """One element, curved."""
    x, y, z = element.nodes.T
    return Body(np.stack([3 * x + 0.2 * y**2, 2 * y, 4 * z + 0.3 * x * (y + z)], axis=1), SKIN, np.arange(len(x))[None])


@pytest.mark.parametrize("element", [HEX27, TET10])
def test_an_affine_map_changes_all_volumes_by_its_determinant(element):
    body, affine = bent(element), np.array([[1.1, 0.2, 0.0], [0.0, 0.9, 0.1], [0.3, 0.0, 1.2]])
    ratios = volume_ratios(body, (body.reference @ affine.T + 5)[None])
    wanted = np.linalg.det(affine)
    assert [ratios.mean, ratios.least, ratios.largest] == pytest.approx([wanted] * 3)
    assert ratios.deviation == pytest.approx(0, abs=1e-12)
    assert ratios.negative == 0


def test_the_change_of_volume_is_counted_both_ways():
    body = bent(HEX27)
    ratios = volume_ratios(body, np.stack([body.reference * size for size in ([1, 1, 1.1], [1, 1, 0.7])]))
    assert (ratios.change, ratios.largest_change) == pytest.approx((0.2, 0.3))


def test_a_mirrored_body_is_turned_over():
    body = bent(HEX27)
    assert volume_ratios(body, (body.reference * [1, 1, -1])[None]).negative == 1


def test_positions_of_another_body_are_refused():
    with pytest.raises(InputError, match="expected 27 nodes"):
        volume_ratios(bent(HEX27), np.zeros((1, 8, 3)))


def test_elements_that_are_not_known_are_refused():
    body = bent(HEX27)
    for cells in (np.arange(8)[None], np.zeros((0, 8), dtype=np.int64)):
        with pytest.raises(InputError, match="expected 27 or 10 nodes each"):
            volume_ratios(Body(body.reference, SKIN, cells), body.reference[None])


def test_nodes_that_never_move_are_the_fixed_ones():
    positions = np.zeros((3, 4, 3))
    positions[1, 2] = [0, 0, 0.1]
    positions[2, 3] = [0, 5e-4, 0]
    assert fixed_nodes(positions).tolist() == [0, 1, 3]
