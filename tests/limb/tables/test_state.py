"""States on disk: whole, of the right muscle, or not there."""

import numpy as np
import pytest

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.limb.tables.state import StateStore, state_key
from tests.limb.conftest import NODES, FormulaStates, with_tendon_area

PLACE = (1.0, 0.5)


@pytest.fixture
def store(tmp_path):
    return StateStore(tmp_path / "states", "key")


@pytest.fixture
def state():
    return FormulaStates(built_in_arm(), "biceps").state(*PLACE)


def test_a_state_comes_back_as_it_was(store, state):
    store.put(state)
    back = store.get(*PLACE, NODES)
    assert back is not None
    assert (back.moment, back.newton_steps, back.penetration) == (state.moment, 3, -0.1)
    for name, values in state.fields.items():
        assert np.array_equal(back.fields[name], values)
    assert [path.suffix for path in store.folder.iterdir()] == [".npz"]


def test_what_is_not_there_is_none(store):
    assert store.get(*PLACE, NODES) is None


@pytest.mark.parametrize("keep", [0, 10, 1000])
def test_a_damaged_state_counts_as_not_there(store, state, keep):
    store.put(state)
    path = next(store.folder.iterdir())
    path.write_bytes(path.read_bytes()[:keep])
    assert store.get(*PLACE, NODES) is None


def test_a_state_of_another_muscle_mesh_or_place_counts_as_not_there(store, state):
    store.put(state)
    assert StateStore(store.folder, "other").get(*PLACE, NODES) is None
    assert store.get(*PLACE, NODES + 1) is None
    path = next(store.folder.iterdir())
    path.rename(path.with_name(f"{1.1:.9f}-{0.5:.9f}.npz"))
    assert store.get(1.1, 0.5, NODES) is None


def test_a_state_with_a_number_that_is_none_counts_as_not_there(store, state):
    state.fields["position"][3, 1] = np.nan
    store.put(state)
    assert store.get(*PLACE, NODES) is None


def test_leftovers_of_an_interrupted_writer_are_swept_and_states_stay(store, state):
    store.put(state)
    (store.folder / ".1.0-0.5.npz-x7").write_bytes(b"half")
    store.sweep()
    assert len(list(store.folder.iterdir())) == 1
    assert store.get(*PLACE, NODES) is not None


def test_a_folder_that_cannot_be_written_is_refused(tmp_path, state):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InputError, match="cannot be written"):
        StateStore(tmp_path / "file" / "x", "key").put(state)


def test_the_key_follows_arm_muscle_and_preset():
    arm = built_in_arm()
    other = with_tendon_area(arm, "biceps", 41.0)
    keys = {
        state_key(arm, "biceps", "tiny"),
        state_key(arm, "triceps", "tiny"),
        state_key(arm, "biceps", "quick"),
        state_key(other, "biceps", "tiny"),
    }
    assert len(keys) == 4


def test_the_key_does_not_follow_what_the_muscle_does_not_see():
    """Another muscle, what is lifted, how fast it moves, how well it was calibrated."""
    arm = built_in_arm()
    heavier = arm.model_copy(update={"load": arm.load.model_copy(update={"forearm_mass": 2.0}), "name": "heavier"})
    assert state_key(heavier, "biceps", "tiny") == state_key(arm, "biceps", "tiny")
    assert state_key(with_tendon_area(arm, "triceps", 41.0), "biceps", "tiny") == state_key(arm, "biceps", "tiny")
