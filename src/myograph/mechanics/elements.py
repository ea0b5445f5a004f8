"""The elements of a mixed space as plain arrays: shape functions at integration points, volumes, numbers of unknowns.

Unknowns are those of NGSolve's spaces: displacement of order 2, one component after the other, then pressure of order
1. On these spaces all elements of a mesh have the same functions of the local coordinates.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import ngsolve as ngs
import numpy as np
from jaxtyping import Float, Int

_BLOCK = 3456
"""Integration points that are worked on at once: few enough to stay in the processor's cache."""


@dataclass(frozen=True, eq=False)
class Elements:
    """All elements of a mesh.

    Parameters
    ----------
    numbers, pressure_numbers
        Of every element's functions: of one displacement component, and of the pressure.
    size, pressures
        How many there are of one component, and of the pressure.
    weights
        Volume of the reference body that each integration point stands for [mm³].
    values
        Of the displacement's functions at the integration points.
    gradients
        Their derivatives there, over the reference body [1/mm].
    shapes
        Values of the pressure's functions there.
    """

    numbers: Int[np.ndarray, "cells functions"]
    pressure_numbers: Int[np.ndarray, "cells corners"]
    size: int
    pressures: int
    weights: Float[np.ndarray, "cells quad"]
    values: Float[np.ndarray, "quad functions"]
    gradients: Float[np.ndarray, "cells quad 3 functions"]
    shapes: Float[np.ndarray, "quad corners"]

    @property
    def unknowns(self) -> int:
        """Number of all unknowns."""
        return 3 * self.size + self.pressures

    def blocks(self) -> Iterator[slice]:
        """The elements, some at a time."""
        step = max(1, _BLOCK // self.weights.shape[1])
        for start in range(0, len(self.numbers), step):
            yield slice(start, min(start + step, len(self.numbers)))

    def points(self, block: slice) -> slice:
        """Numbers of the integration points of a block of elements."""
        quad = self.weights.shape[1]
        return slice(block.start * quad, block.stop * quad)

    def deformation_gradient(
        self, vector: Float[np.ndarray, " unknowns"], block: slice
    ) -> Float[np.ndarray, "3 3 points"]:
        """F = 1 + grad u at the integration points of a block."""
        components = vector[: 3 * self.size].reshape(3, -1)
        local = components[:, self.numbers[block]].transpose(1, 2, 0)
        cells, quad, _, functions = self.gradients[block].shape
        gradient = self.gradients[block].reshape(cells, quad * 3, functions) @ local
        return np.eye(3)[:, :, None] + np.ascontiguousarray(gradient.reshape(-1, 3, 3).T)

    def interpolated(self, components: Float[np.ndarray, "3 size"]) -> Float[np.ndarray, "points 3"]:
        """A vector field at all integration points from its unknowns."""
        return np.einsum("qf,kcf->cqk", self.values, components[:, self.numbers]).reshape(-1, 3)

    def pressure(self, vector: Float[np.ndarray, " unknowns"], block: slice) -> Float[np.ndarray, " points"]:
        """Pressure [MPa] at the integration points of a block."""
        return (vector[3 * self.size + self.pressure_numbers[block]] @ self.shapes.T).ravel()

    @cached_property
    def all_numbers(self) -> Int[np.ndarray, "cells element_unknowns"]:
        """Numbers of all unknowns of every element: x, y, z components, then pressure."""
        components = [self.numbers + k * self.size for k in range(3)]
        return np.concatenate([*components, self.pressure_numbers + 3 * self.size], axis=1)


def mixed_elements(mesh: ngs.Mesh, rule: ngs.IntegrationRule) -> Elements:
    """Elements of all of one kind on a mesh, curved or not, with this rule of integration on each."""
    displacement, pressure = ngs.H1(mesh, order=2), ngs.H1(mesh, order=1)
    points = mesh.MapToAllElements(rule, ngs.VOL)
    places = np.array([point.point for point in rule])
    jacobians = np.asarray(ngs.specialcf.JacobianMatrix(3)(points)).reshape(mesh.ne, len(places), 3, 3)
    local = _local_gradients(mesh, displacement, places)
    gradients = np.einsum("qfa,cqax->cqxf", local, np.linalg.inv(jacobians))
    return Elements(
        _numbers(displacement),
        _numbers(pressure),
        int(displacement.ndof),
        int(pressure.ndof),
        np.abs(np.linalg.det(jacobians)) * np.array(rule.weights),
        _values(displacement, places),
        np.ascontiguousarray(gradients),
        _values(pressure, places),
    )


def _values(space: ngs.H1, places: np.ndarray) -> Float[np.ndarray, "quad functions"]:
    return np.array([np.asarray(_first(space).CalcShape(*place)) for place in places.tolist()])


def _local_gradients(mesh: ngs.Mesh, space: ngs.H1, places: np.ndarray) -> Float[np.ndarray, "quad functions 3"]:
    """Derivatives of the functions over the local coordinates, from the first element's over space."""
    trafo = mesh.GetTrafo(ngs.ElementId(ngs.VOL, 0))
    mapped = [trafo(*place) for place in places.tolist()]
    return np.array([np.asarray(_first(space).CalcDShape(point)) @ np.asarray(point.jacobi) for point in mapped])


def _first(space: ngs.H1) -> ngs.fem.ScalarFE:
    return space.GetFE(ngs.ElementId(ngs.VOL, 0))


def _numbers(space: ngs.H1) -> Int[np.ndarray, "cells functions"]:
    return np.array([space.GetDofNrs(ngs.ElementId(ngs.VOL, k)) for k in range(space.mesh.ne)])
