"""The discrete muscle: total energy of displacement and pressure, its residual, its tangent, and its fields.

Unknowns: quadratic displacement [mm], continuous linear pressure [MPa]: Q2–Q1 on hexahedra, P2–P1 on tetrahedra. The
origin's face is fixed; the insertion's face moves rigidly (mechanics/insertion.py).
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np
from jaxtyping import Float
from ngsolve.comp import IntegrationRuleSpace

from myograph.anatomy.model import Arm
from myograph.mechanics.algebra import Tangent, as_array, derivative
from myograph.mechanics.compiler import compiled
from myograph.mechanics.contact import Skin, Turn, fixed_energy, turning_energy
from myograph.mechanics.fibres import fibre_direction
from myograph.mechanics.insertion import Insertion
from myograph.mechanics.law import MuscleLaw, Site
from myograph.mechanics.layout import LAYOUTS
from myograph.mechanics.space import NodalSpace, nodal_space
from myograph.mesh.muscle_mesh import MuscleMesh
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
    mesh
        Its mesh in the reference pose.
    native
        Translate the energy to machine code by the C++ compiler: worth its quarter of a minute on large meshes.
    """

    def __init__(self, arm: Arm, name: str, mesh: MuscleMesh, *, native: bool = False) -> None:
        self.arm, self.name, self.mesh = arm, name, mesh
        self.muscle, self.hinge = arm.muscles[name], arm.hinge.frame()
        self.insertion = Insertion(self.muscle, self.hinge, mesh)
        self.space = nodal_space(mesh)
        self.controls = Knobs(ngs.Parameter(0.0), ngs.Parameter(0.0), Turn(ngs.Parameter(1.0), ngs.Parameter(0.0)))
        self.unknowns = _unknown_space(self.space)
        self._scratch = ngs.GridFunction(self.unknowns)
        self.free = as_array(self.unknowns.FreeDofs())
        self._factored: Tangent | None = None
        self.law = MuscleLaw(self.muscle, self.controls.activation, self.controls.ramp)
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
        fraction = self.space.field(1 - tendon_share(self.arm, self.name, self.mesh))
        clamped = ngs.IfPos(fraction, ngs.IfPos(fraction - 1, 1.0, fraction), 0.0)
        return Site(fibre_direction(self.space), clamped, ngs.exp(self.space.field(np.log(self.mesh.area))))

    def _build_forms(self, native: bool) -> None:
        (u, p), _ = self.unknowns.TnT()
        rule_space = IntegrationRuleSpace(self.space.mesh, order=LAYOUTS[self.mesh.element.kind].rule)
        site = _at_integration_points(self.site, rule_space)
        volume = ngs.dx(intrules=rule_space.GetIntegrationRules())
        skin = ngs.ds("skin", intrules={kind: ngs.IntegrationRule(kind, 8) for kind in (ngs.QUAD, ngs.TRIG)})
        self._energy = ngs.BilinearForm(self.unknowns)
        self._energy += ngs.Variation(compiled(self.law.energy(ngs.Id(3) + ngs.Grad(u), p, site), native) * volume)
        place = ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z)) + u
        points = Skin(place, self.space.field(self.mesh.along), self.site.area)
        ramp, fixed = self.controls.ramp, fixed_energy(self.arm, self.muscle.contact, points)
        if fixed is not None:
            self._energy += ngs.Variation((ramp * fixed).Compile() * skin)
        turning = turning_energy(self.arm, self.muscle.contact, points, self.controls.turn)
        self._turning: ngs.BilinearForm | None = None
        if turning is not None:
            turning = (ramp * turning).Compile()
            self._energy += ngs.Variation(turning * skin)
            self._turning = ngs.BilinearForm(self.unknowns)
            self._turning += ngs.Variation(turning * skin)

    def energy(self, vector: Float[np.ndarray, " unknowns"]) -> float:
        """Total energy [N mm]."""
        return float(self._energy.Energy(self._load(vector)))

    def residual(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Derivative of the energy over all unknowns, fixed ones included: force [N], volume [mm³]."""
        return derivative(self._energy, self._load(vector))

    def tangent(self, vector: Float[np.ndarray, " unknowns"]) -> Tangent:
        """Second derivative of the energy, factored; good until the next one is asked for."""
        self._energy.AssembleLinearization(self._load(vector))
        if self._factored is None:
            self._factored = Tangent(self._energy.mat, self.unknowns.FreeDofs())
        else:
            self._factored.refactor()
        return self._factored

    def boundary_values(self, flexion: float) -> Float[np.ndarray, " unknowns"]:
        """Unknowns of the prescribed displacement at a flexion [rad] from the reference pose; zero elsewhere."""
        return self._boundary_unknowns(self.insertion.displacement(flexion))

    def moment(self, vector: Float[np.ndarray, " unknowns"], flexion: float) -> float:
        """Moment about the hinge [N*mm], minus the derivative of the energy over the flexion; positive flexes.

        By virtual work: the reaction on the moved face, and what the forearm's bones and bands, which turn too, take.
        """
        moment = -float(self.residual(vector) @ self._boundary_unknowns(self.insertion.rate(flexion)))
        if self._turning is not None:
            around = np.cross(-self.hinge.axis, self.positions(vector) - self.hinge.point)
            moment += float(derivative(self._turning, self._load(vector)) @ self._vector_unknowns(around))
        return moment

    def positions(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, "nodes 3"]:
        """Where the nodes are [mm]."""
        size = self.space.scalar.ndof
        moved = [self.space.to_nodes @ vector[k * size : (k + 1) * size] for k in range(3)]
        return self.mesh.points + np.stack(moved, axis=1)

    def _boundary_unknowns(self, nodal: Float[np.ndarray, "nodes 3"]) -> Float[np.ndarray, " unknowns"]:
        """Unknowns of a displacement of the held faces, zero at the free ones."""
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
