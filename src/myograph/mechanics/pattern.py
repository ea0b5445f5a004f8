"""A sparse matrix whose places are fixed by the mesh, filled again and again from element matrices.

Element matrices come in the order in which they are multiplied out, so that nothing is transposed on the way:

    displacement  [cell, a, i, k, b]   function a of component i against function b of component k
    coupling      [cell, i, a, c]      function a of component i against pressure function c, and its transpose
    pressure      [cell, c, d]
"""

from typing import Any

import ngsolve as ngs
import numpy as np
import scipy.sparse as sparse
from jaxtyping import Float

from myograph.mechanics.elements import Elements

_SPARSE: Any = ngs.la.SparseMatrixd
"""Takes NumPy's arrays, which its declared types do not say."""


class Pattern:
    """Where the entries of element matrices go."""

    def __init__(self, elements: Elements) -> None:
        numbers, size = elements.all_numbers, elements.unknowns
        keys = numbers[:, :, None] * size + numbers[:, None, :]
        places, where = np.unique(_as_multiplied(keys, elements), return_inverse=True)
        self._size, self._keys = size, places
        rows, columns = np.divmod(places, size)
        self.matrix: ngs.BaseMatrix = _SPARSE.CreateFromCOO(rows, columns, np.zeros(len(places)), size, size)
        entries, shape = np.arange(where.size), (len(places), where.size)
        self._scatter = sparse.csr_array((np.ones(where.size), (where.ravel(), entries)), shape=shape)

    def fill(self, element_matrices: Float[np.ndarray, " entries"]) -> None:
        """Set the matrix to the sum of the element matrices, one after the other."""
        self._values[:] = self._scatter @ element_matrices

    def places(self, other: Any) -> np.ndarray:
        """Numbers of another sparse matrix's entries, whose places are some of these, among the entries here."""
        _, columns, starts = other.CSR()
        rows = np.repeat(np.arange(self._size), np.diff(np.asarray(starts).astype(np.int64)))
        return np.searchsorted(self._keys, rows * self._size + np.asarray(columns).astype(np.int64))

    def add(self, values: Float[np.ndarray, " other"], places: np.ndarray) -> None:
        """Add the entries of another matrix at these places."""
        self._values[places] += values

    @property
    def _values(self) -> np.ndarray:
        return self.matrix.AsVector().FV().NumPy()


def _as_multiplied(square: np.ndarray, elements: Elements) -> np.ndarray:
    """Square element matrices in the order of this file, flat."""
    functions = 3 * elements.numbers.shape[1]
    cells = len(square)
    blocks = square[:, :functions, :functions].reshape(cells, 3, -1, 3, functions // 3).transpose(0, 2, 1, 3, 4)
    upper, lower = square[:, :functions, functions:], square[:, functions:, :functions].swapaxes(1, 2)
    parts = (blocks, upper, lower, square[:, functions:, functions:])
    return np.concatenate([part.reshape(cells, -1) for part in parts], axis=1).ravel()
