"""The figures of a method over some pairs."""

from dataclasses import asdict, dataclass

import numpy as np
from jaxtyping import Float

from myograph.evaluation.metrics import NodeErrors, node_errors

TABLE = (
    "mean_mm",
    "rmse_mm",
    "p95_mm",
    "max_mm",
    "relative",
    "von_mises_mean_mpa",
    "von_mises_max_mpa",
    "coverage_90",
)
"""The figures that a program is told of."""


@dataclass(frozen=True)
class ErrorSummary:
    """Errors of a method under a protocol; None where the method does not answer what would be measured.

    Parameters
    ----------
    mean_mm, rmse_mm, p95_mm, max_mm
        Of positions [mm].
    relative
        Mean over the mean displacement [-].
    von_mises_mean_mpa, von_mises_max_mpa
        Of von Mises stress [MPa].
    von_mises_relative
        Mean over the mean von Mises stress [-].
    coverage_90, von_mises_coverage_90
        Share of errors within the method's 90 % intervals.
    inside
        Share of pairs that the method says to lie within what it was trained on.
    """

    mean_mm: float | None = None
    rmse_mm: float | None = None
    p95_mm: float | None = None
    max_mm: float | None = None
    relative: float | None = None
    von_mises_mean_mpa: float | None = None
    von_mises_max_mpa: float | None = None
    von_mises_relative: float | None = None
    coverage_90: float | None = None
    von_mises_coverage_90: float | None = None
    inside: float | None = None

    def figures(self) -> dict[str, float | None]:
        """The figures of `TABLE` by name."""
        return {name: value for name, value in asdict(self).items() if name in TABLE}

    def known_figures(self) -> dict[str, float]:
        """Those that are not None."""
        return {name: value for name, value in self.figures().items() if value is not None}


@dataclass(frozen=True)
class Evaluation:
    """Errors of a method over some pairs, in what it answers.

    Parameters
    ----------
    position, von_mises
        Errors [mm], [MPa]; None for a field that the method does not answer, or was not asked.
    inside
        Share of pairs that the method says to lie within what it was trained on, where it says so.
    """

    position: NodeErrors | None
    von_mises: NodeErrors | None = None
    inside: float | None = None

    def summary(self) -> ErrorSummary:
        """The figures; raises InputError where nothing moves, for then no error can be relative."""
        figures: dict[str, float | None] = {"inside": self.inside}
        if (position := self.position) is not None:
            figures |= {"mean_mm": position.mean, "rmse_mm": position.rmse, "p95_mm": position.p95}
            figures |= {"max_mm": position.largest, "relative": position.relative, "coverage_90": position.coverage_90}
        if (stress := self.von_mises) is not None:
            figures |= {"von_mises_mean_mpa": stress.mean, "von_mises_max_mpa": stress.largest}
            figures |= {"von_mises_relative": stress.relative, "von_mises_coverage_90": stress.coverage_90}
        return ErrorSummary(**figures)


def summarise(
    predicted: Float[np.ndarray, "batch nodes 3"],
    true: Float[np.ndarray, "true_batch true_nodes 3"],
    initial: Float[np.ndarray, "initial_batch initial_nodes 3"],
) -> ErrorSummary:
    """Errors of positions [mm] that are all at hand; the three shapes must be equal."""
    displacement = node_errors(initial, true)
    errors = NodeErrors(node_errors(predicted, true), float(displacement.mean(dtype=np.float64)))
    return Evaluation(errors).summary()
