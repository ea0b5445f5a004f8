"""Energy, residual and tangent of elements against NGSolve's own differentiation of the same energy."""

import ngsolve as ngs
import numpy as np
import pytest
from ngsolve.meshes import MakeStructured3DMesh

from myograph.materials.jets import JETS
from myograph.mechanics.algebra import Tangent, derivative
from myograph.mechanics.assembly import Assembly
from myograph.mechanics.elements import mixed_elements
from myograph.mechanics.pattern import Pattern
from tests.materials.cases import EXAMPLES, FIBRE
from tests.mechanics.ngsolve_functions import NGSOLVE, field_invariants

ACTIVATION = 0.7
AXIS = ngs.CoefficientFunction(tuple(map(float, FIBRE)))


class Block:
    """A bent, curved block of one kind of element, by both."""

    def __init__(self, hexes):
        self.mesh = MakeStructured3DMesh(hexes=hexes, nx=3, ny=1, nz=2)
        curve = ngs.GridFunction(ngs.VectorH1(self.mesh, order=2))
        curve.Set((0.05 * ngs.y * ngs.z, 0.04 * ngs.x**2, 0.03 * ngs.x * ngs.y))
        self.curve = curve
        self.mesh.SetDeformation(curve)
        self.rule = ngs.IntegrationRule(ngs.HEX if hexes else ngs.TET, 5)
        self.elements = mixed_elements(self.mesh, self.rule)
        self.space = ngs.VectorH1(self.mesh, order=2) * ngs.H1(self.mesh, order=1)
        self.vector = 0.02 * np.random.default_rng(2).normal(size=self.space.ndof)

    def ours(self, law):
        fibre = np.repeat(FIBRE[:, None], self.elements.weights.size, axis=1)
        return Assembly(self.elements, fibre, lambda at, p, _: law.mixed_energy(at, p, ACTIVATION, JETS))

    def theirs(self, law):
        """NGSolve's form, and the state."""
        (u, p), _ = self.space.TnT()
        at = field_invariants(ngs.Id(3) + ngs.Grad(u), AXIS)
        form = ngs.BilinearForm(self.space)
        rules = {self.rule_type: self.rule}
        form += ngs.Variation(law.mixed_energy(at, p, ngs.Parameter(ACTIVATION), NGSOLVE) * ngs.dx(intrules=rules))
        state = ngs.GridFunction(self.space)
        state.vec.FV().NumPy()[:] = self.vector
        return form, state.vec

    @property
    def rule_type(self):
        return ngs.HEX if len(self.elements.numbers[0]) == 27 else ngs.TET


@pytest.fixture(scope="module", params=[True, False], ids=["hexahedra", "tetrahedra"])
def block(request):
    return Block(request.param)


@pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES.keys())
def test_energy_residual_and_tangent_are_those_of_ngsolve(block, law):
    ours, (form, state) = block.ours(law), block.theirs(law)
    assert ours.energy(block.vector) == pytest.approx(form.Energy(state), rel=1e-11)
    residual = derivative(form, state)
    assert ours.residual(block.vector) == pytest.approx(residual, abs=1e-11 * np.abs(residual).max())
    ours.tangent(block.vector)
    form.AssembleLinearization(state)
    direction = np.random.default_rng(3).normal(size=block.space.ndof)
    found, expected = (_times(matrix, direction) for matrix in (ours.matrix, form.mat))
    assert found == pytest.approx(expected, abs=1e-10 * np.abs(expected).max())


def _times(matrix, vector):
    right, result = matrix.CreateColVector(), matrix.CreateColVector()
    right.FV().NumPy()[:] = vector
    result.data = matrix * right
    return result.FV().NumPy().copy()


def test_elements_fill_the_body_and_know_its_places(block):
    assert block.elements.weights.sum() == pytest.approx(ngs.Integrate(1, block.mesh, order=8), rel=1e-12)
    place = np.zeros((3, block.elements.size))
    place[:, : block.mesh.nv] = np.array([vertex.point for vertex in block.mesh.vertices]).T
    place += block.curve.vec.FV().NumPy().reshape(3, -1)
    points = block.mesh.MapToAllElements(block.rule, ngs.VOL)
    expected = np.asarray(ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z))(points))
    assert block.elements.interpolated(place) == pytest.approx(expected, abs=1e-13)


def test_blocks_of_elements_cover_each_once(block):
    parts = list(block.elements.blocks())
    assert [k for part in parts for k in range(part.start, part.stop)] == list(range(block.mesh.ne))


def test_a_pattern_holds_the_sum_of_element_matrices_and_takes_in_others(block):
    pattern = Pattern(block.elements)
    square = block.elements.numbers.shape[1] * 3 + block.elements.pressure_numbers.shape[1]
    pattern.fill(np.ones(block.mesh.ne * square**2))
    ones = np.ones(block.space.ndof)
    together = _times(pattern.matrix, ones)
    numbers, counts = np.unique(block.elements.all_numbers, return_counts=True)
    assert together[numbers] == pytest.approx(counts * square)
    face = ngs.BilinearForm(block.space)
    (u, _), (v, _) = block.space.TnT()
    face += ngs.InnerProduct(u, v) * ngs.ds
    face.Assemble()
    pattern.add(np.array(face.mat.AsVector()), pattern.places(face.mat))
    assert _times(pattern.matrix, ones) == pytest.approx(together + _times(face.mat, ones), abs=1e-12)


def test_an_element_inside_out_gives_no_number_and_no_warning(block, recwarn):
    turned = block.vector.copy()
    turned[: block.elements.size] -= 3 * np.pad(
        [vertex.point[0] for vertex in block.mesh.vertices], (0, block.elements.size - block.mesh.nv)
    )
    assert not np.isfinite(block.ours(EXAMPLES["mooney_rivlin"]).residual(turned)).all()
    assert not recwarn.list


def test_one_tangent_serves_again_and_again(block):
    """Factors are made anew in the order that was found once."""
    space = ngs.VectorH1(block.mesh, order=2, dirichlet=".*") * ngs.H1(block.mesh, order=1)
    body = block.ours(EXAMPLES["gauss"])
    body.tangent(0 * block.vector)
    tangent = Tangent(body.matrix, space.FreeDofs())
    body.tangent(block.vector)
    tangent.refactor()
    right = body.residual(block.vector)
    fresh = Tangent(body.matrix, space.FreeDofs()).solve(right)
    assert tangent.solve(right) == pytest.approx(fresh, abs=1e-9 * np.abs(fresh).max())
