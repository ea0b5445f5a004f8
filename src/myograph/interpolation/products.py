r"""The functions of a sparse grid: products of functions of one variable.

φ_j(x) = Π_k b_{l_jk, i_jk}(x_k). In each dimension every different (l, i) is evaluated once; the products are gathered
from these short tables.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from myograph.errors import InputError
from myograph.interpolation.basis import Basis
from myograph.interpolation.grid import SparseGrid


class GridFunctions:
    """All functions of a grid and a basis.

    Raises InputError for a grid with boundary points and a basis without boundary functions.
    """

    def __init__(self, grid: SparseGrid, basis: Basis) -> None:
        if grid.boundary and not basis.boundary:
            raise InputError(
                f"expected a grid without boundary points for the basis '{basis.name}', got one with; "
                "use SparseGrid.regular(..., boundary=False)"
            )
        self.number, self.dimension = grid.levels.shape
        self._tables, self._places = [], []
        for k in range(self.dimension):
            pairs = np.stack([grid.levels[:, k], grid.indices[:, k]], axis=1)
            different, places = np.unique(pairs, axis=0, return_inverse=True)
            self._tables.append(basis.functions(different[:, 0], different[:, 1]))
            self._places.append(places.reshape(-1))

    def derivatives(
        self, x: Float[np.ndarray, "points dimension"], orders: Sequence[tuple[int, ...]]
    ) -> list[Float[np.ndarray, "points functions"]]:
        """Partial derivatives of all functions at points of the unit cube, one array for each tuple of orders."""
        tables = [
            {order: table(x[:, k], order).take(places, axis=1) for order in {one[k] for one in orders}}
            for k, (table, places) in enumerate(zip(self._tables, self._places, strict=True))
        ]
        results = []
        for one in orders:
            result = tables[0][one[0]]
            for k in range(1, self.dimension):
                result = result * tables[k][one[k]]
            results.append(result)
        return results

    def values(self, x: Float[np.ndarray, "points dimension"]) -> Float[np.ndarray, "points functions"]:
        """Values of all functions at points of the unit cube; a single point takes a short way."""
        if len(x) != 1:
            return self.derivatives(x, [(0,) * self.dimension])[0]
        result = np.ones(self.number)
        for place, table, places in zip(x[0].tolist(), self._tables, self._places, strict=True):
            result *= table.at(place)[places]
        return result[None]
