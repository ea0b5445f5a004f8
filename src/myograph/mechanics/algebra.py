"""Between NGSolve's vectors and matrices and NumPy's arrays."""

import ngsolve as ngs
import numpy as np
from jaxtyping import Bool, Float


class Tangent:
    """A factored tangent: LDLᵀ without pivoting, sound because the matrix is quasi-definite.

    One object serves all tangents of a form: the order of elimination is found once, the factors are made anew.
    """

    def __init__(self, matrix: ngs.BaseMatrix, free: ngs.BitArray) -> None:
        self._matrix = matrix
        self._inverse = matrix.Inverse(free, "sparsecholesky")

    def refactor(self) -> None:
        """Factor the matrix as it is now."""
        self._inverse.Update()

    def solve(self, right: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Solution on the free unknowns, zero on the fixed ones."""
        return _through(self._inverse, right)

    def times(self, vector: Float[np.ndarray, " unknowns"]) -> Float[np.ndarray, " unknowns"]:
        """Product with the tangent."""
        return _through(self._matrix, vector)


def as_array(bits: ngs.BitArray) -> Bool[np.ndarray, " unknowns"]:
    """Bits as an array of booleans."""
    return np.array([bits[k] for k in range(len(bits))], dtype=bool)


def derivative(form: ngs.BilinearForm, vector: ngs.BaseVector) -> Float[np.ndarray, " unknowns"]:
    """Derivative of a form's energy over all unknowns."""
    result = vector.CreateVector()
    form.Apply(vector, result)
    return result.FV().NumPy().copy()


def _through(matrix: ngs.BaseMatrix, vector: np.ndarray) -> np.ndarray:
    right, result = matrix.CreateColVector(), matrix.CreateColVector()
    right.FV().NumPy()[:] = vector
    result.data = matrix * right
    return result.FV().NumPy().copy()
