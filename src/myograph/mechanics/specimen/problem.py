r"""The discrete specimen: energy and loads, their residual, their tangent.

    ∫ W(F, p) dV - ∫ t · u dA  stationary,   and on faces under follower pressure  + ∫ π cof(F) N · v dA

Unknowns: displacement of second order [mm], continuous pressure of first order [MPa]. Forces are measured in the
reference body.

Trap: a follower pressure on a face with free edges has no energy, and its tangent is not symmetric. The factorisation
reads one triangle of the matrix only; a few steps of GMRES around it answer for the other.
"""

import ngsolve as ngs
import numpy as np
from jaxtyping import Bool, Float
from ngsolve.krylovspace import GMRes

from myograph.errors import InputError
from myograph.materials.invariants import Invariants
from myograph.materials.jets import JETS, Jet
from myograph.mechanics.algebra import derivative
from myograph.mechanics.assembly import Assembly
from myograph.mechanics.elements import mixed_elements
from myograph.mechanics.skin_form import SkinForm
from myograph.mechanics.specimen.description import Load, Specimen, check_faces
from myograph.mechanics.specimen.mesh import CurvedMesh, curved_mesh

_AXES = "xyz"
_ORDER = 5
"""Polynomials that the rule of integration is exact for: three Gauss points along each edge of a hexahedron."""
_LINEAR_TOLERANCE = 1e-10
"""Residual of the linear equations over their right side, where they are solved by iteration."""
_SAME = 1e-9
"""Difference of prescribed values, over the largest of them, up to which they agree."""


class SpecimenProblem:
    """One specimen under one load, of which `share` (0 to 1) is applied.

    Raises InputError for unknown faces, for prescribed values that contradict each other, and where the supports leave
    a rigid motion.
    """

    def __init__(self, specimen: Specimen, load: Load) -> None:
        self.specimen, self.load = specimen, load
        self.body: CurvedMesh = curved_mesh(specimen.shape, specimen.element)
        check_faces(load, self.body.mesh.GetBoundaries())
        self.share = ngs.Parameter(0.0)
        held = ["|".join(names) for names in self._held_faces()]
        displacement = ngs.VectorH1(self.body.mesh, order=2, dirichletx=held[0], dirichlety=held[1], dirichletz=held[2])
        self.unknowns = displacement * ngs.H1(self.body.mesh, order=1)
        self.size = int(self.body.place.shape[1])
        self.free: Bool[np.ndarray, " unknowns"] = np.array(list(self.unknowns.FreeDofs()), dtype=bool)
        _require_support(self.body.vertices, ~self.free_vertices)
        self.prescribed = self._prescribed()
        self._scratch = ngs.GridFunction(self.unknowns)
        self.tissue = self._build_tissue()
        self._loads = self._build_loads()

    @property
    def free_vertices(self) -> Bool[np.ndarray, "vertices 3"]:
        """Which displacement components of the vertices are not prescribed."""
        vertices = len(self.body.vertices)
        return np.stack([self.free[k * self.size : k * self.size + vertices] for k in range(3)], axis=1)

    def face_unknowns(self, face: str) -> Bool[np.ndarray, " component"]:
        """Which unknowns of one component lie on the face; the first ones are values at vertices."""
        scalar = self.unknowns.components[0].components[0]
        return np.array(list(scalar.GetDofs(self.body.mesh.Boundaries(face))), dtype=bool)

    def residual(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Internal minus applied forces [N], fixed unknowns included, then the volume constraint [mm³]."""
        internal = self.tissue.residual(vector)
        return internal if self._loads is None else internal + derivative(self._loads.form, self._loaded(vector))

    def linear_step(
        self, vector: Float[np.ndarray, " unknowns"], increment: Float[np.ndarray, " unknowns"]
    ) -> Float[np.ndarray, " unknowns"]:
        """Newton's change of the unknowns; the prescribed increment enters here, so that the body follows it."""
        self.tissue.tangent(vector)
        if self._loads is not None:
            self._loads.add_tangent(self._loaded(vector))
        matrix = self.tissue.matrix
        moved, right = self._scratch.vec.CreateVector(), self._scratch.vec.CreateVector()
        moved.FV().NumPy()[:] = increment
        right.data = matrix * moved
        forces = right.FV().NumPy() + self.residual(vector)
        right.FV().NumPy()[:] = np.where(self.free, forces, 0.0)
        inverse = matrix.Inverse(self.unknowns.FreeDofs(), "sparsecholesky")
        if self.load.pressure:
            moved.data -= GMRes(matrix, right, inverse, maxsteps=50, reltol=_LINEAR_TOLERANCE, printrates=False)
        else:
            moved.data -= inverse * right
        return moved.FV().NumPy().copy()

    def _held_faces(self) -> list[list[str]]:
        """Names of the faces on which each component is prescribed."""
        if self.load.gradient is not None:
            return [list(self.body.mesh.GetBoundaries())] * 3
        planes = self.specimen.shape.planes
        held = [[face for face in self.specimen.symmetry if planes[face] == k] for k in range(3)]
        for face, components in self.load.displacement.items():
            for k, value in enumerate(components):
                if value is not None:
                    held[k].append(face)
        return held

    def _prescribed(self) -> Float[np.ndarray, " unknowns"]:
        """Unknowns of the whole prescribed displacement; zero elsewhere."""
        vector = np.zeros(self.unknowns.ndof)
        if self.load.gradient is not None:
            moved = (np.array(self.load.gradient) - np.eye(3)) @ self.body.place
            vector[: 3 * self.size] = moved.ravel()
            vector[self.free] = 0.0
            return vector
        values = np.full((3, self.size), np.nan)
        for face in self.specimen.symmetry:
            self._prescribe(values, self.specimen.shape.planes[face], face, 0.0)
        for face, components in self.load.displacement.items():
            for k, value in enumerate(components):
                if value is not None:
                    self._prescribe(values, k, face, value)
        vector[: 3 * self.size] = np.nan_to_num(values).ravel()
        return vector

    def _prescribe(self, values: Float[np.ndarray, "3 component"], k: int, face: str, value: float) -> None:
        """Write a constant, which is its values at vertices; the functions of edges, faces and cells vanish there."""
        on_face = self.face_unknowns(face)
        on_face[len(self.body.vertices) :] = False
        before = values[k, on_face]
        if (np.abs(before - value) > _SAME * max(1.0, abs(value))).any():
            other = float(before[np.abs(before - value) > 0][0])
            raise InputError(
                f"face {face}: expected one {_AXES[k]} displacement where faces meet, got {value:g} and {other:g} mm;"
                f" leave one of them free"
            )
        values[k, on_face] = value

    def _build_tissue(self) -> Assembly:
        """W at the applied share of the activation."""
        kind = ngs.HEX if self.specimen.element == "hexahedra" else ngs.TET
        elements = mixed_elements(self.body.mesh, ngs.IntegrationRule(kind, _ORDER))
        fibre = np.repeat(np.array(self.specimen.fibre, dtype=float)[:, None], elements.weights.size, axis=1)

        def density(at: Invariants, pressure: Jet, _: slice) -> Jet:
            return self.specimen.law.mixed_energy(at, pressure, self.share.Get() * self.load.activation, JETS)

        return Assembly(elements, fibre, density)

    def _build_loads(self) -> SkinForm | None:
        """Forces on faces; None without any."""
        if not self.load.traction and not self.load.pressure:
            return None
        (u, _), (v, _) = self.unknowns.TnT()
        form = ngs.BilinearForm(self.unknowns)
        for face, traction in self.load.traction.items():
            work = self.share * ngs.InnerProduct(ngs.CoefficientFunction(tuple(traction)), u)
            form += ngs.Variation(-work.Compile() * ngs.ds(face))
        for face, pressure in self.load.pressure.items():
            along_face = ngs.Id(3) + ngs.Grad(u).Trace()
            push = ngs.InnerProduct(ngs.Cof(along_face) * ngs.specialcf.normal(3), v)
            form += (self.share * pressure * push).Compile() * ngs.ds(face)
        return SkinForm(form, self.tissue.pattern)

    def _loaded(self, vector: Float[np.ndarray, " unknowns"]) -> ngs.BaseVector:
        self._scratch.vec.FV().NumPy()[:] = vector
        return self._scratch.vec


def _require_support(vertices: Float[np.ndarray, "vertices 3"], held: Bool[np.ndarray, "vertices 3"]) -> None:
    """Refuse supports that some translation or rotation does not feel."""
    place = (vertices - vertices.mean(axis=0)) / np.ptp(vertices)
    translations = np.broadcast_to(np.eye(3)[:, None, :], (3, *place.shape))
    rotations = np.stack([np.cross(axis, place) for axis in np.eye(3)])
    felt = np.concatenate([translations, rotations])[:, held]
    rank = int(np.linalg.matrix_rank(felt, tol=1e-6)) if felt.size else 0
    if rank < 6:
        raise InputError(
            f"supports: expected them to hold the specimen, but {6 - rank} of its 6 rigid motions are free; add planes"
            f" of symmetry or prescribed displacements"
        )
