"""An energy on the skin beside the tissue: NGSolve differentiates it, its tangent goes into the tissue's matrix."""

import ngsolve as ngs
import numpy as np

from myograph.mechanics.pattern import Pattern


class SkinForm:
    """The form, and where the entries of its matrix go."""

    def __init__(self, form: ngs.BilinearForm, pattern: Pattern) -> None:
        self.form, self._pattern = form, pattern
        self._places: np.ndarray | None = None

    def add_tangent(self, state: ngs.BaseVector) -> None:
        """Add the second derivative at a state."""
        self.form.AssembleLinearization(state)
        if self._places is None:
            self._places = self._pattern.places(self.form.mat)
        self._pattern.add(self.form.mat.AsVector().FV().NumPy(), self._places)
