"""The way to the muscle at rest: no element is left crushed where a shorter step leads elsewhere."""

import pytest

from myograph.anatomy.load import built_in_arm
from myograph.mechanics import continuation
from myograph.mechanics.continuation import Controls, Solved, at_rest, reach, set_controls, unloaded
from myograph.mechanics.newton import smallest_volume_ratio
from myograph.mechanics.problem import MuscleProblem
from myograph.mesh.presets import preset_mesh

RESTING = Controls(1.0, 0.0, 0.0)


def test_the_anconeus_rests_with_no_element_crushed():
    """Which first step crushes an element of it is a matter of rounding; the answer is not."""
    arm = built_in_arm()
    problem = MuscleProblem(arm, "anconeus", preset_mesh(arm, "anconeus", "quick"))
    state = at_rest(problem)
    assert smallest_volume_ratio(problem, state.vector) > 0.5
    shorter = reach(problem, unloaded(problem), RESTING, first_share=1 / 32)
    assert problem.energy(state.vector) == pytest.approx(problem.energy(shorter.vector), rel=1e-6)


def test_where_all_ways_crush_an_element_the_least_energy_is_the_answer(biceps, solved, monkeypatch):
    ways = {1 / 8: 3.0, 1 / 16: 1.0, 1 / 32: 2.0}
    monkeypatch.setattr(
        continuation, "reach", lambda problem, start, target, share: Solved(target, start.vector + ways[share], 1)
    )
    monkeypatch.setattr(continuation, "smallest_volume_ratio", lambda problem, vector: 0.01)
    monkeypatch.setattr(type(biceps), "energy", lambda self, vector: float(vector[0]))
    assert at_rest(biceps).vector[0] == 1.0
    monkeypatch.undo()
    set_controls(biceps, solved.controls)
