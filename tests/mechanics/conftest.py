"""A small muscle problem, and controls that bring it into a generic state."""

import numpy as np
import pytest

pytest.importorskip("ngsolve", reason="the mechanics need NGSolve")

import ngsolve as ngs

from myograph.anatomy.load import built_in_arm
from myograph.mechanics.continuation import Controls, at_rest, reach, set_controls
from myograph.mechanics.layout import LAYOUTS
from myograph.mechanics.problem import MuscleProblem
from myograph.mesh.presets import RESOLUTIONS, muscle_mesh


def problem_of(name):
    arm = built_in_arm()
    return MuscleProblem(arm, name, muscle_mesh(arm, name, RESOLUTIONS["tiny"]))


def recovered(space, function):
    """A function at the nodes, as fields are."""
    points = space.mesh.MapToAllElements(LAYOUTS[space.muscle.element.kind].recovery, ngs.VOL)
    values = np.asarray(function(points), dtype=float)
    return space.recovered(values.reshape(len(values), -1))


@pytest.fixture(scope="session")
def biceps():
    return problem_of("biceps")


@pytest.fixture(scope="session")
def solved(biceps):
    """The biceps half active and a little flexed, in equilibrium."""
    state = reach(biceps, at_rest(biceps), Controls(1.0, 0.5, 0.2))
    set_controls(biceps, state.controls)
    return state
