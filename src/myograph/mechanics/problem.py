"""The discrete muscle: total energy of displacement and pressure, its residual, its tangent, and its fields.

Unknowns: Q2 displacement [mm], continuous Q1 pressure [MPa]. The origin's face is fixed; the insertion's face moves
rigidly: its centre with the forearm, its orientation with the line of action (a face that turned with the forearm
would clamp the tendon in bending).
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np
from jaxtyping import Bool, Float
from ngsolve.comp import IntegrationRuleSpace

from myograph.anatomy.body import end_turn
from myograph.anatomy.model import Arm
from myograph.mechanics.compiler import compiled
from myograph.mechanics.contact import Turn, band_energy, fixed_contact_energy
from myograph.mechanics.fibres import fibre_direction
from myograph.mechanics.law import MuscleLaw, Site
from myograph.mechanics.space import NodalSpace, nodal_space
from myograph.mesh.hexahedra import HexMesh
from myograph.mesh.tissue import tendon_share


@dataclass(frozen=True)
class Knobs:
    """What changes between solves: activation, ramp of the pre-stretch, flexion of the forearm."""

    activation: ngs.Parameter
    ramp: ngs.Parameter
    turn: Turn


class MuscleProblem:
    """Energy of one muscle on one mesh.

    Parameters
    ----------
    arm, name
        The muscle and where it lives.
    hexahedra
        Its mesh in the reference pose.
    native
        Translate the energy to machine code by the C++ compiler: worth its quarter of a minute on large meshes.
    """

    def __init__(self, arm: Arm, name: str, hexahedra: HexMesh, *, native: bool = False) -> None:
        self.arm, self.name, self.hexahedra = arm, name, hexahedra
        self.muscle, self.hinge = arm.muscles[name], arm.hinge.frame()
        self.space = nodal_space(hexahedra)
        self.controls = Knobs(ngs.Parameter(0.0), ngs.Parameter(0.0), Turn(ngs.Parameter(1.0), ngs.Parameter(0.0)))
        self.unknowns = _unknown_space(self.space)
        self._scratch = ngs.GridFunction(self.unknowns)
        self.free = _as_array(self.unknowns.FreeDofs())
        self.law = MuscleLaw(
            self.muscle.fibre, self.muscle.tendons, self.muscle.matrix, self.controls.activation, self.controls.ramp
        )
        self.site = self._material_site()
        self._build_forms(native)

    @property
    def vector_size(self) -> int:
        """Number of unknowns."""
        return int(self.unknowns.ndof)

    def _material_site(self) -> Site:
        """Fibre, fraction and area between the nodes too.

        Quadratics overshoot there: the fraction is clamped, the area interpolated by its logarithm.
        """
        fraction = self.space.field(1 - tendon_share(self.arm, self.name, self.hexahedra))
        clamped = ngs.IfPos(fraction, ngs.IfPos(fraction - 1, 1.0, fraction), 0.0)
        return Site(fibre_direction(self.space), clamped, ngs.exp(self.space.field(np.log(self.hexahedra.area))))

    def _build_forms(self, native: bool) -> None:
        (u, p), _ = self.unknowns.TnT()
        rule_space = IntegrationRuleSpace(self.space.mesh, order=2)
        site = _at_integration_points(self.site, rule_space)
        volume = ngs.dx(intrules=rule_space.GetIntegrationRules())
        skin = ngs.ds("skin", intrules={ngs.QUAD: ngs.IntegrationRule(ngs.QUAD, 8)})
        self._energy = ngs.BilinearForm(self.unknowns)
        self._energy += ngs.Variation(compiled(self.law.energy(ngs.Id(3) + ngs.Grad(u), p, site), native) * volume)
        place = ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z)) + u
        along, area = self.space.field(self.hexahedra.along), self.site.area
        fixed = fixed_contact_energy(self.arm, self.muscle.contact, place, along, area)
        if fixed is not None:
            self._energy += ngs.Variation(fixed.Compile() * skin)
        self._bands: ngs.BilinearForm | None = None
        for band in self.muscle.contact.bands:
            energy = band_energy(self.arm, band, place, along, self.controls.turn).Compile()
            self._energy += ngs.Variation(energy * skin)
            self._bands = self._bands or ngs.BilinearForm(self.unknowns)
            self._bands += ngs.Variation(energy * skin)

    def energy(self, vector: Float[np.ndarray, " unknowns"]) -> float:
        """Total energy [N mm]."""
        return float(self._energy.Energy(self._load(vector)))

    def residual(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Derivative of the energy over all unknowns, fixed ones included: force [N], volume [mm³]."""
        return _applied(self._energy, self._load(vector))

    def tangent(self, vector: Float[np.ndarray, " unknowns"]) -> "Tangent":
        """Second derivative of the energy, factored."""
        self._energy.AssembleLinearization(self._load(vector))
        return Tangent(self._energy.mat, self.unknowns.FreeDofs())

    def boundary_values(self, flexion: float) -> Float[np.ndarray, " unknowns"]:
        """Unknowns of the prescribed displacement at a flexion [rad] from the reference pose; zero elsewhere."""
        return self._boundary_unknowns(self._insertion_places(flexion) - self._insertion_places(0.0))

    def moment(self, vector: Float[np.ndarray, " unknowns"], flexion: float) -> float:
        """Moment about the hinge [N*mm], minus the derivative of the energy over the flexion; positive flexes.

        By virtual work: the reaction on the moved face, and what the bands, which turn too, take.
        """
        step = 1e-4
        rate = (self._insertion_places(flexion + step) - self._insertion_places(flexion - step)) / (2 * step)
        moment = -float(self.residual(vector) @ self._boundary_unknowns(rate))
        if self._bands is not None:
            around = np.cross(-self.hinge.axis, self.positions(vector) - self.hinge.point)
            moment += float(_applied(self._bands, self._load(vector)) @ self._vector_unknowns(around))
        return moment

    def positions(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, "nodes 3"]:
        """Where the nodes are [mm]."""
        size = self.space.scalar.ndof
        moved = [self.space.to_nodes @ vector[k * size : (k + 1) * size] for k in range(3)]
        return self.hexahedra.points + np.stack(moved, axis=1)

    def _insertion_places(self, flexion: float) -> Float[np.ndarray, "face 3"]:
        face = self.hexahedra.points[self.hexahedra.end_nodes("insertion")]
        centre = face.mean(axis=0)
        turn = self.hinge.rotation(end_turn(self.muscle, self.hinge, flexion))
        return self.hinge.flex(centre, flexion) + (face - centre) @ turn.T

    def _boundary_unknowns(self, moved: Float[np.ndarray, "face 3"]) -> Float[np.ndarray, " unknowns"]:
        nodal = np.zeros_like(self.hexahedra.points)
        nodal[self.hexahedra.end_nodes("insertion")] = moved
        vector = self._vector_unknowns(nodal)
        vector[self.free] = 0.0
        return vector

    def _vector_unknowns(self, nodal: Float[np.ndarray, "nodes 3"]) -> Float[np.ndarray, " unknowns"]:
        vector = np.zeros(self.vector_size)
        vector[: 3 * self.space.scalar.ndof] = (self.space.to_unknowns @ nodal).T.ravel()
        return vector

    def _load(self, vector: Float[np.ndarray, " unknowns"]) -> ngs.BaseVector:
        self._scratch.vec.FV().NumPy()[:] = vector
        return self._scratch.vec


class Tangent:
    """A factored tangent: LDLᵀ without pivoting, sound because the matrix is quasi-definite."""

    def __init__(self, matrix: ngs.BaseMatrix, free: ngs.BitArray) -> None:
        self._matrix = matrix
        self._inverse = matrix.Inverse(free, "sparsecholesky")

    def solve(self, right: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Solution on the free unknowns, zero on the fixed ones."""
        return _through(self._inverse, right)

    def times(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Product with the tangent."""
        return _through(self._matrix, vector)


def _as_array(bits: ngs.BitArray) -> Bool[np.ndarray, " unknowns"]:
    return np.array([bits[k] for k in range(len(bits))], dtype=bool)


def _unknown_space(space: NodalSpace) -> ngs.FESpace:
    displacement = ngs.VectorH1(space.mesh, order=2, dirichlet="origin|insertion")
    return displacement * ngs.H1(space.mesh, order=1)


def _at_integration_points(site: Site, rule_space: IntegrationRuleSpace) -> Site:
    """The site's fields looked up at the integration points instead of computed there for every derivative."""

    def stored(function: ngs.CoefficientFunction) -> ngs.GridFunction:
        values = ngs.GridFunction(rule_space)
        values.Interpolate(function)
        return values

    fibre = ngs.CoefficientFunction(tuple(stored(site.fibre[k]) for k in range(3)))
    return Site(fibre, stored(site.fraction), stored(site.area))


def _applied(form: ngs.BilinearForm, vector: ngs.BaseVector) -> np.ndarray:
    result = vector.CreateVector()
    form.Apply(vector, result)
    return result.FV().NumPy().copy()


def _through(matrix: ngs.BaseMatrix, vector: np.ndarray) -> np.ndarray:
    right, result = matrix.CreateColVector(), matrix.CreateColVector()
    right.FV().NumPy()[:] = vector
    result.data = matrix * right
    return result.FV().NumPy().copy()
