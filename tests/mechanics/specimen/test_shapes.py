"""Meshes of specimens: volumes, closed surfaces, named faces."""

from math import pi

import pytest

pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")

import ngsolve as ngs

from myograph.errors import InputError
from myograph.mechanics.specimen import Box, Panel, ThickCylinder, ThickSphere
from myograph.mechanics.specimen.mesh import curved_mesh

COOK = ((0.0, 0.0), (48.0, 44.0), (48.0, 60.0), (0.0, 44.0))
SHAPES = [
    (Box((2.0, 1.0, 3.0), (2, 3, 4)), 6.0, 1e-12),
    (Box((2.0, 1.0, 3.0), (3, 3, 3), distortion=0.39), 6.0, 1e-12),
    (Panel(COOK, thickness=2.0, cells=(3, 4)), 48 * (44 + 16), 1e-12),
    (ThickCylinder(1.0, 2.0, 0.5, (3, 6, 1)), pi / 4 * 3 * 0.5, 2e-5),
    (ThickSphere(1.0, 2.0, (3, 3)), pi / 6 * 7, 3e-4),
]


@pytest.mark.parametrize(("shape", "volume", "tolerance"), SHAPES)
@pytest.mark.parametrize("element", ["hexahedra", "tetrahedra"])
def test_the_volume_is_right_and_the_named_faces_close_it(shape, volume, tolerance, element):
    """∫ dV = V, and by the divergence theorem ∫ X · N / 3 dA over the named faces is the same: normals point out."""
    mesh = curved_mesh(shape, element).mesh
    place = ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z))
    outward = ngs.InnerProduct(place, ngs.specialcf.normal(3)) / 3
    inside = ngs.Integrate(ngs.CoefficientFunction(1.0), mesh, order=6)
    around = sum(ngs.Integrate(outward * ngs.ds(face, bonus_intorder=4), mesh) for face in mesh.GetBoundaries())
    assert inside == pytest.approx(volume, rel=tolerance)
    assert around == pytest.approx(inside, rel=1e-12)


@pytest.mark.parametrize(("shape", "volume", "tolerance"), SHAPES)
def test_planes_lie_across_their_axis(shape, volume, tolerance):
    mesh = curved_mesh(shape, "hexahedra").mesh
    normal = ngs.specialcf.normal(3)
    for face, axis in shape.planes.items():
        area = ngs.Integrate(ngs.CoefficientFunction(1.0) * ngs.ds(face), mesh)
        assert abs(ngs.Integrate(normal[axis] * ngs.ds(face), mesh)) == pytest.approx(area, rel=1e-12)


def test_halving_the_cells_brings_a_curved_shape_closer_by_the_fourth_order():
    errors = []
    for cells in (2, 4):
        mesh = curved_mesh(ThickSphere(1.0, 2.0, (cells, cells)), "hexahedra").mesh
        errors.append(abs(ngs.Integrate(ngs.CoefficientFunction(1.0), mesh, order=6) / (pi / 6 * 7) - 1))
    assert errors[0] / errors[1] == pytest.approx(16, rel=0.2)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (
            lambda: Box(size=(1.0, -1.0, 1.0)),
            r"size of the box: expected positive numbers of mm, got \(1.0, -1.0, 1.0\)",
        ),
        (lambda: Box(size=(1.0, float("nan"), 1.0)), "size of the box"),
        (lambda: Box(cells=(1, 0, 1)), "cells of the box: expected whole numbers from 1 on"),
        (lambda: Box(distortion=0.5), r"distortion of the box: expected a number in \[0, 0.4\), got 0.5"),
        (lambda: Panel(COOK, thickness=0.0), "thickness of the panel"),
        (lambda: Panel(COOK, cells=(1, 0)), "cells of the panel"),
        (lambda: Panel(COOK[::-1]), "corners of the panel: expected four, convex, counter-clockwise"),
        (lambda: ThickCylinder(2.0, 1.0), "radii of the cylinder: expected inner < outer, got 2 and 1"),
        (lambda: ThickCylinder(-1.0, 1.0), "radii of the cylinder: expected positive"),
        (lambda: ThickCylinder(1.0, 2.0, length=0.0), "length of the cylinder"),
        (lambda: ThickCylinder(1.0, 2.0, cells=(0, 1, 1)), "cells of the cylinder"),
        (lambda: ThickSphere(1.0, 1.0), "radii of the sphere: expected inner < outer"),
        (lambda: ThickSphere(1.0, 2.0, cells=(0, 1)), "cells of the sphere"),
    ],
)
def test_a_shape_that_cannot_be_is_refused(make, words):
    with pytest.raises(InputError, match=words):
        make()
