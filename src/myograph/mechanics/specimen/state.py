"""What a solved specimen tells: displacement, deformation gradient, Cauchy stress, reactions, and how it was found."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from myograph.errors import InputError
from myograph.mechanics.specimen.problem import SpecimenProblem

_SAME_PLACE = 1e-6
"""Distance over the body's size up to which a point is a vertex."""


@dataclass(frozen=True)
class LoadStep:
    """Newton's history of one load step.

    Parameters
    ----------
    share
        Share of the load at its end, up to 1.
    residuals
        Norm of the free forces before each correction [N].
    corrections
        Largest change of the displacement by each correction, over the body's size [-].
    """

    share: float
    residuals: tuple[float, ...]
    corrections: tuple[float, ...]


@dataclass(frozen=True)
class Samples:
    """Values at the integration points, and the volume of the reference body [mm³] that each stands for."""

    points: Float[np.ndarray, "points 3"]
    weights: Float[np.ndarray, " points"]
    displacement: Float[np.ndarray, "points 3"]
    F: Float[np.ndarray, "points 3 3"]
    cauchy_stress: Float[np.ndarray, "points 3 3"]


@dataclass(frozen=True)
class SpecimenState:
    """A specimen in equilibrium.

    Parameters
    ----------
    vertices
        Vertices of the mesh in the reference body [mm].
    displacement
        Of the vertices [mm].
    free
        Which of its components are not prescribed.
    samples
        Fields at the integration points.
    reactions
        Face -> force that the supports exert through it [N], in the components that are prescribed there.
    history
        One entry per load step.
    """

    vertices: Float[np.ndarray, "vertices 3"]
    displacement: Float[np.ndarray, "vertices 3"]
    free: Bool[np.ndarray, "vertices 3"]
    samples: Samples
    reactions: Mapping[str, Float[np.ndarray, " 3"]]
    history: tuple[LoadStep, ...]

    @property
    def mean_gradient(self) -> Float[np.ndarray, "3 3"]:
        """Mean of F over the reference volume [-]."""
        return np.average(self.samples.F, axis=0, weights=self.samples.weights)

    @property
    def mean_stretches(self) -> Float[np.ndarray, " 3"]:
        """Lengths of the mean F's columns: how much x, y and z edges have grown [-]."""
        return np.linalg.norm(self.mean_gradient, axis=0)

    @property
    def mean_stress(self) -> Float[np.ndarray, "3 3"]:
        """Mean of the Cauchy stress over the deformed volume [MPa]."""
        deformed = self.samples.weights * np.linalg.det(self.samples.F)
        return np.average(self.samples.cauchy_stress, axis=0, weights=deformed)

    @property
    def free_norm(self) -> float:
        """Euclidean norm of the free displacement components of all vertices [mm].

        FEBio's figure for its test problems of one trilinear element, on a specimen of one cell.
        """
        return float(np.linalg.norm(self.displacement[self.free]))

    def displacement_at(self, point: tuple[float, float, float]) -> Float[np.ndarray, " 3"]:
        """Displacement [mm] of a vertex, given by its place in the reference body [mm].

        Raises InputError where there is none, naming the nearest.
        """
        distances = np.linalg.norm(self.vertices - np.array(point, dtype=float), axis=1)
        nearest = int(distances.argmin())
        if distances[nearest] > _SAME_PLACE * np.ptp(self.vertices):
            raise InputError(
                f"point {point!r}: expected a vertex of the mesh, the nearest is"
                f" {tuple(float(x) for x in self.vertices[nearest].round(6))}; choose other cells or another point"
            )
        return self.displacement[nearest]


def read_state(
    problem: SpecimenProblem, vector: Float[np.ndarray, " unknowns"], history: tuple[LoadStep, ...]
) -> SpecimenState:
    """State of the problem's unknowns at its present share of the load."""
    vertices = problem.body.vertices
    return SpecimenState(
        vertices=vertices,
        displacement=_by_component(problem, vector)[:, : len(vertices)].T.copy(),
        free=problem.free_vertices,
        samples=_samples(problem, vector),
        reactions=_reactions(problem, vector),
        history=history,
    )


def smallest_volume_ratio(problem: SpecimenProblem, vector: Float[np.ndarray, " unknowns"]) -> float:
    """Smallest J = det F over the integration points."""
    return float(np.linalg.det(problem.tissue.deformation_gradient(vector)).min())


def _samples(problem: SpecimenProblem, vector: Float[np.ndarray, " unknowns"]) -> Samples:
    elements = problem.tissue.elements
    place, displacement = (
        elements.interpolated(components) for components in (problem.body.place, _by_component(problem, vector))
    )
    F, stress = problem.tissue.deformation_gradient(vector), problem.tissue.cauchy_stress(vector)
    return Samples(place, elements.weights.ravel(), displacement, F, stress)


def _reactions(problem: SpecimenProblem, vector: Float[np.ndarray, " unknowns"]) -> dict[str, np.ndarray]:
    """Residual of the held vertices: their functions sum to one, those of edges, faces and cells vanish at them."""
    forces = np.where(problem.free, 0.0, problem.residual(vector))
    by_vertex = _by_component(problem, forces)[:, : len(problem.body.vertices)]
    faces = problem.body.mesh.GetBoundaries()
    return {face: by_vertex[:, problem.face_unknowns(face)[: by_vertex.shape[1]]].sum(axis=1) for face in faces}


def _by_component(problem: SpecimenProblem, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, "3 component"]:
    return vector[: 3 * problem.size].reshape(3, -1)
