"""The discrete muscle: total energy of displacement and pressure, its residual and its tangent.

Unknowns: quadratic displacement [mm], continuous linear pressure [MPa]: Q2–Q1 on hexahedra, P2–P1 on tetrahedra. The
origin's face is fixed; the insertion's face moves rigidly (mechanics/insertion.py).
"""

from dataclasses import dataclass

import ngsolve as ngs
import numpy as np
from jaxtyping import Float

from myograph.anatomy.model import Arm
from myograph.materials.invariants import Invariants
from myograph.materials.jets import JETS, Jet
from myograph.mechanics.algebra import Tangent, as_array, derivative
from myograph.mechanics.assembly import Assembly
from myograph.mechanics.contact import Skin, Turn, fixed_energy, turning_energy
from myograph.mechanics.elements import mixed_elements
from myograph.mechanics.insertion import Insertion
from myograph.mechanics.law import MuscleLaw
from myograph.mechanics.layout import LAYOUTS
from myograph.mechanics.site import Site
from myograph.mechanics.skin_form import SkinForm
from myograph.mechanics.space import NodalSpace, nodal_space
from myograph.mesh.muscle_mesh import MuscleMesh


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
    """

    def __init__(self, arm: Arm, name: str, mesh: MuscleMesh) -> None:
        self.arm, self.name, self.mesh = arm, name, mesh
        self.muscle, self.hinge = arm.muscles[name], arm.hinge.frame()
        self.insertion = Insertion(self.muscle, self.hinge, mesh)
        self.space = nodal_space(mesh)
        self.controls = Knobs(ngs.Parameter(0.0), ngs.Parameter(0.0), Turn(ngs.Parameter(1.0), ngs.Parameter(0.0)))
        self.unknowns = _unknown_space(self.space)
        self._scratch = ngs.GridFunction(self.unknowns)
        self.free = as_array(self.unknowns.FreeDofs())
        self._factored: Tangent | None = None
        self.site = Site(arm, name, self.space)
        self._build_energies()

    @property
    def vector_size(self) -> int:
        """Number of unknowns."""
        return int(self.unknowns.ndof)

    @property
    def law(self) -> MuscleLaw:
        """The law at the present activation and ramp."""
        return MuscleLaw(self.muscle, self.controls.activation.Get(), self.controls.ramp.Get(), JETS)

    def _build_energies(self) -> None:
        """The tissue, and what keeps it out of the bones."""
        rule = LAYOUTS[self.mesh.element.kind].rule
        at_points = self.site.at(rule)

        def density(at: Invariants, pressure: Jet, points: slice) -> Jet:
            return self.law.energy(at, pressure, at_points.place(points))

        self.tissue = Assembly(mixed_elements(self.space.mesh, rule), at_points.fibre, density)
        trial, _ = self.unknowns.TnT()
        place = ngs.CoefficientFunction((ngs.x, ngs.y, ngs.z)) + trial[0]
        points = Skin(place, self.space.field(self.mesh.along), self.site.area)
        fixed = fixed_energy(self.arm, self.muscle.contact, points)
        turning = turning_energy(self.arm, self.muscle.contact, points, self.controls.turn)
        self._contacts = [form for form in (self._on_skin(fixed), self._on_skin(turning)) if form is not None]
        self._turning = None if turning is None else self._contacts[-1]

    def _on_skin(self, energy: ngs.CoefficientFunction | None) -> SkinForm | None:
        """An energy per area of skin, ramped up with the pre-stretch."""
        if energy is None:
            return None
        skin = ngs.ds("skin", intrules={kind: ngs.IntegrationRule(kind, 8) for kind in (ngs.QUAD, ngs.TRIG)})
        form = ngs.BilinearForm(self.unknowns)
        form += ngs.Variation((self.controls.ramp * energy).Compile() * skin)
        return SkinForm(form, self.tissue.pattern)

    def energy(self, vector: Float[np.ndarray, " unknowns"]) -> float:
        """Total energy [N mm]."""
        state = self._load(vector)
        return self.tissue.energy(vector) + sum(contact.form.Energy(state) for contact in self._contacts)

    def residual(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Derivative of the energy over all unknowns, fixed ones included: force [N], volume [mm³]."""
        state = self._load(vector)
        return sum((derivative(contact.form, state) for contact in self._contacts), self.tissue.residual(vector))

    def tangent(self, vector: Float[np.ndarray, " unknowns"]) -> Tangent:
        """Second derivative of the energy, factored; good until the next one is asked for."""
        self.assemble(vector)
        if self._factored is None:
            self._factored = Tangent(self.tissue.matrix, self.unknowns.FreeDofs())
        else:
            self._factored.refactor()
        return self._factored

    def assemble(self, vector: Float[np.ndarray, " unknowns"]) -> None:
        """Make the matrix of the tangent, not its factors."""
        self.tissue.tangent(vector)
        for contact in self._contacts:
            contact.add_tangent(self._load(vector))

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
            moment += float(derivative(self._turning.form, self._load(vector)) @ self._vector_unknowns(around))
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
