"""An arm whose tables are made from formulas, not from finite elements."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.case import MUSCLES
from myograph.limb.table_arm import TableArm
from myograph.limb.tables.adaptive import built
from myograph.limb.tables.spec import TableSpec
from myograph.limb.tables.state import State

STRENGTH = {"brachioradialis": 5e3, "brachialis": 8e3, "biceps": 2e4, "anconeus": -1e3, "triceps": -2e4}
NODES = 12


def smooth(name):
    """Moment = strength (0.2 + activation) (2 - angle); positions shrink with activation."""

    def formula(reference, angle, activation):
        shrink = 1 - 0.1 * activation * angle
        fields = {
            "position": reference * shrink,
            "cauchy_stress": np.tile(activation * np.arange(1.0, 7), (NODES, 1)),
            "fibre_stretch": np.full(NODES, shrink),
            "pressure": np.zeros(NODES),
        }
        return STRENGTH[name] * (0.2 + activation) * (2 - angle if STRENGTH[name] > 0 else 1), fields

    return formula


class FormulaStates:
    """States of a muscle of twelve nodes from a formula; knows where it was asked, fails where it is told to."""

    def __init__(self, arm, name, formula=None, fails=lambda angle, activation: False):
        self.arm, self.name, self.preset = arm, name, "tiny"
        self.reference = np.random.default_rng(1).normal(size=(NODES, 3)) * 50
        self.skin = np.array([[0, 1, 2, 3]])
        self.formula, self.fails = formula or smooth(name), fails
        self.asked = []

    def __call__(self, points):
        self.asked += points.tolist()
        return [self.state(angle, activation) for angle, activation in points.tolist()]

    def state(self, angle, activation):
        if self.fails(angle, activation):
            return State(angle, activation, "an element turned inside out", seconds=1.0)
        moment, fields = self.formula(self.reference, angle, activation)
        sound = {"volume_change": 1e-4, "smallest_jacobian": 0.9, "penetration": -0.1}
        return State(angle, activation, "", moment, 3, seconds=1.0, fields=fields, vector=np.zeros(5), **sound)


def formula_table(arm, name):
    return built(FormulaStates(arm, name), TableSpec.regular(2))


@pytest.fixture
def formula_arm():
    arm = built_in_arm()
    return TableArm(arm, {name: formula_table(arm, name) for name in MUSCLES})


def with_tendon_area(arm, name, area):
    """The arm with another muscle."""
    tissue = arm.muscles[name].tissue.model_copy(update={"tendon_area": area})
    muscle = arm.muscles[name].model_copy(update={"tissue": tissue})
    return arm.model_copy(update={"muscles": {**arm.muscles, name: muscle}})
