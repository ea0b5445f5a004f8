"""What a page is asked to show."""

from collections.abc import Sequence
from dataclasses import dataclass

from myograph.limb.motion.activation_file import Activations
from myograph.view.page.network import PageNetwork
from myograph.view.page.solving import SolveTime
from myograph.view.page.source import ArmModels
from myograph.view.page.truth import TruthCase

MOST_TIMES = 5000
"""Rows of a movement that a page keeps."""


@dataclass(frozen=True)
class PageArm:
    """What a page is made of; what beside the models is there where it is known.

    Parameters
    ----------
    models
        Neural modes of the muscles.
    truth
        Cases to compare with.
    movement, movement_name
        Activations over time.
    network
        Asked beside the modes of its muscle.
    solve
        How long a solver takes for a case, where the truth does not tell.
    """

    models: ArmModels
    truth: Sequence[TruthCase] = ()
    movement: Activations | None = None
    movement_name: str = ""
    network: PageNetwork | None = None
    solve: SolveTime | None = None

    @property
    def solve_time(self) -> SolveTime | None:
        """Of the truth, else of the cases that come with the package."""
        return next((case.solve for case in self.truth if case.solve is not None), self.solve)
