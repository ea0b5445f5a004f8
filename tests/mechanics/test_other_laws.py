"""An arm whose biceps is made of other laws, and of the same laws put together otherwise."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.anatomy.model import Arm
from myograph.materials.catalogue import LAWS
from myograph.materials.literature import LITERATURE
from myograph.mechanics.muscle import FiniteElementMuscle
from myograph.units import radians
from tests.materials.cases import MOONEY_RIVLIN, NEO_HOOKE, slope

ANGLE = radians(70.0)
BICEPS = built_in_arm().muscles["biceps"]


def _moments(activations=(0.0, 0.5), **changes):
    """Moments [N*mm] of the tiny biceps with its `tissue`, `belly` or `tendon` changed."""
    data = built_in_arm().model_dump(mode="json")
    for part, change in changes.items():
        data["muscles"]["biceps"][part] = change if "law" in change else data["muscles"]["biceps"][part] | change
    muscle = FiniteElementMuscle(Arm.model_validate(data), "biceps", "tiny")
    moments = []
    for activation in activations:
        state = muscle.solve(activation, ANGLE)
        assert np.isfinite(state.fields["cauchy_stress"]).all()
        moments.append(state.moment)
    return moments


def _law(name, **changes):
    return LITERATURE[name].model_dump(mode="json") | changes


@pytest.fixture(scope="module")
def built_in():
    return _moments()


SOFT_LIGAMENT = {"C1": 0.01, "C3": 0.01, "C4": 5.0, "C5": 0.5, "l_m": 1.5, "K": 100.0, "active_stress": 0.2}
CONTRACTING = {"contraction": "fibre", "active_stress": 0.2}
BELLIES = {
    "roehrle": (1.3, _law("roehrle muscle")),
    "heidlauf_roehrle": (1.2, _law("heidlauf_roehrle muscle")),
    "blemker": (1.3, _law("blemker muscle", isochoric_fibre=False, G1=5e-3, G2=5e-3)),
    "trans_iso_mooney_rivlin": (1.2, _law("trans_iso_mooney_rivlin tendon", isochoric_fibre=False, **SOFT_LIGAMENT)),
    "guccione": (1.1, _law("guccione active heart", bulk=50.0, T_a=0.2)),
    "neo_hooke": (1.1, NEO_HOOKE.model_dump(mode="json") | CONTRACTING | {"E": 0.12, "nu": 0.4998}),
    "mooney_rivlin": (1.1, MOONEY_RIVLIN.model_dump(mode="json") | CONTRACTING | {"c1": 0.02, "c2": 0.0, "K": 50.0}),
}


def _active_stress(belly, prestretch):
    """Nominal stress by activation [MPa] where the belly, once active, has shortened to 0.92 of its pre-stretch."""
    return slope(belly.active, np.array([0.92 * prestretch]))[0]


@pytest.mark.exhaustive
@pytest.mark.filterwarnings("ignore:overflow")  # of guccione's exponential, in a trial step that is cut back
@pytest.mark.parametrize("name", BELLIES)
def test_activation_adds_as_much_moment_to_a_belly_of_another_law_as_its_stress_promises(name, built_in):
    """With published parameters, or scaled to a muscle's; bundles pull with nominal stress times cross-section."""
    prestretch, data = BELLIES[name]
    belly = LAWS[name].model_validate(data)
    rest, active = _moments(tissue={"prestretch": prestretch}, belly=data)
    promised = _active_stress(belly, prestretch) / _active_stress(BICEPS.belly, BICEPS.tissue.prestretch)
    assert (active - rest) / (built_in[1] - built_in[0]) == pytest.approx(promised, rel=0.2)
    assert 0 < rest < built_in[0]


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    ("tendon", "bulk"),
    [
        (_law("roehrle tendon"), 100.0),
        (_law("blemker_tendon tendon", isochoric_fibre=False), 50.0),
        (_law("trans_iso_mooney_rivlin tendon", isochoric_fibre=False), 600.0),
    ],
    ids=["roehrle", "blemker_tendon", "trans_iso_mooney_rivlin"],
)
def test_a_tendon_of_another_law_hands_on_nearly_the_same_force(tendon, bulk):
    """Tendons are short and stiff: what they are made of changes the muscle's length by a per cent."""
    before, after = _moments(belly={"bulk": bulk}), _moments(tendon=tendon, belly={"bulk": bulk})
    assert after == pytest.approx(before, rel=0.1)
    assert np.abs(np.subtract(after, before)).min() > 20.0


@pytest.mark.parametrize("switch", ["bundles", "prestretch_matrix"])
def test_each_switch_of_the_tissue_changes_the_answer(switch, built_in):
    moments = _moments(activations=(0.0, 0.3), tissue={switch: False})
    assert abs(moments[0] / built_in[0] - 1) > 0.02
    assert 0.5 * built_in[0] < moments[0] < moments[1]
