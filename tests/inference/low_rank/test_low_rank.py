"""Plain arrays answer as the torch module that they were saved from; what does not fit is refused."""

import hashlib
import json

import numpy as np
import pytest
import safetensors.numpy
import torch

from myograph.case import MUSCLES
from myograph.errors import InputError
from myograph.fields import von_mises
from myograph.inference.low_rank import RANGE, read_low_rank, read_low_rank_arm
from myograph.inference.model_file import WEIGHTS, model_text, read_model_file
from tests.inference.low_rank.stand_in import ENDS, body_of, module_of, save_arm, save_modes

ASKED = np.random.default_rng(0).uniform(size=(6, 5))
LOADS = np.linspace(0, 20, 6)


@pytest.fixture(scope="module")
def body():
    return body_of("biceps")


@pytest.fixture(scope="module", params=["activation", "both"])
def pair(request, tmp_path_factory, body):
    """A torch module, and the plain arrays of its saved model."""
    module = module_of("biceps", body, request.param)
    folder = tmp_path_factory.mktemp("modes") / "model"
    save_modes(folder, module=module, body=body)
    return module, read_low_rank(folder)


def asked_of(module, activation, load):
    parts = {
        "activation": torch.tensor(activation, dtype=torch.float32)[None],
        "hand_load": torch.tensor([load], dtype=torch.float32),
        "sensor_position_target": torch.zeros(1, 0, 3),
        "sensor_nodes": torch.zeros(0, dtype=torch.int64),
        "query_nodes": torch.arange(module.built.nodes),
    }
    with torch.no_grad():
        answers = module(*(parts[name] for name in module.inputs))
    return {name: answer[0].double().numpy() for name, answer in zip(module.outputs, answers, strict=True)}


def test_fields_and_deviations_are_those_of_the_torch_module(pair):
    module, muscle = pair
    for activation, load in zip(ASKED, LOADS, strict=True):
        wanted, found = asked_of(module, activation, load), muscle.at(activation, load)
        deviations = muscle.deviations(muscle.place(activation, load))
        for name in ("position", "cauchy_stress", "fibre_stretch"):
            shape = wanted[name].shape
            assert found[name].shape == shape
            np.testing.assert_allclose(found[name], wanted[name], atol=1e-5 * np.abs(wanted[name]).max())
        for name, deviation in deviations.items():
            np.testing.assert_allclose(deviation, wanted[f"{name}_deviation"], rtol=1e-3)
        np.testing.assert_allclose(found["von_mises"], von_mises(found["cauchy_stress"]))


def test_the_elbow_angle_lies_on_the_line_between_both_ends(pair):
    _, muscle = pair
    low, high = ENDS
    x = muscle.place(ASKED[0]).x
    assert muscle.elbow_angle(ASKED[0]) == pytest.approx(low + (high - low) * (x + RANGE) / (2 * RANGE))


def test_inside_is_what_training_covered(pair):
    _, muscle = pair
    assert muscle.inside(np.array([1.0, 1, 1, 1, 0.5]), 20.0)
    assert not muscle.inside(np.array([1.0, 1, 1, 1, 0.6]), 20.0)
    assert not muscle.inside(np.zeros(5), 21.0)


@pytest.mark.parametrize(
    ("activation", "load", "words"),
    [
        (np.zeros(4), 0.0, "expected 5 activations"),
        (np.array([0, 0, 1.5, 0, 0]), 0.0, "activation of biceps"),
        (np.zeros(5), np.nan, "load at the hand"),
    ],
)
def test_questions_that_cannot_be_are_refused(pair, activation, load, words):
    with pytest.raises(InputError, match=words):
        pair[1].at(activation, load)


def test_an_arm_is_read_in_the_order_of_its_muscles_and_one_model_is_an_arm_of_one(tmp_path):
    arm = read_low_rank_arm(save_arm(tmp_path / "arm", ("triceps", "biceps")))
    assert list(arm) == ["biceps", "triceps"]
    assert [arm[name].own for name in arm] == [MUSCLES.index(name) for name in arm]
    assert arm["biceps"].elbow_angle(ASKED[0]) == arm["triceps"].elbow_angle(ASKED[0])
    assert list(read_low_rank_arm(tmp_path / "arm" / "triceps")) == ["triceps"]


def test_muscles_of_different_networks_and_two_of_one_muscle_are_refused(tmp_path, body):
    save_modes(tmp_path / "a", body=body)
    save_modes(tmp_path / "b", "triceps", body=body, module=module_of("triceps", body, network=1))
    with pytest.raises(InputError, match="got another one of triceps than of biceps"):
        read_low_rank_arm(tmp_path)
    save_modes(tmp_path / "b", body=body)
    with pytest.raises(InputError, match="got two of biceps"):
        read_low_rank_arm(tmp_path)


def test_a_model_that_does_not_tell_the_angle_has_none(tmp_path, body):
    module = module_of("biceps", body)
    module.angle_range.fill_(torch.nan)
    save_modes(tmp_path / "m", body=body, module=module)
    assert read_low_rank(tmp_path / "m").elbow_angle(ASKED[0]) is None


def test_other_methods_and_models_that_read_sensors_only_are_refused(tmp_path, body):
    save_modes(tmp_path / "m", body=body, method="gen")
    with pytest.raises(InputError, match=r"expected neural modes .* got the method 'gen'"):
        read_low_rank(tmp_path / "m")
    save_modes(tmp_path / "s", body=body, module=module_of("biceps", body, "sensors"))
    with pytest.raises(InputError, match="answers from activations, got one that reads sensors"):
        read_low_rank(tmp_path / "s")
    with pytest.raises(InputError, match=r"found no model\.json there"):
        read_low_rank_arm(tmp_path / "nothing")


def test_altered_weights_and_another_schema_are_refused(tmp_path, body):
    save_modes(tmp_path / "m", body=body)
    weights = tmp_path / "m" / WEIGHTS
    data = bytearray(weights.read_bytes())
    data[-1] ^= 1
    weights.write_bytes(bytes(data))
    with pytest.raises(InputError, match="it was altered"):
        read_low_rank(tmp_path / "m")
    told = json.loads(model_text(read_model_file(tmp_path / "m")).replace('"schema_version": 1', '"schema_version": 2'))
    told["sha256"] = hashlib.sha256(json.dumps(told["model"], sort_keys=True).encode()).hexdigest()
    (tmp_path / "m" / "model.json").write_text(json.dumps(told))
    with pytest.raises(InputError, match="expected schema version 1, got 2"):
        read_low_rank(tmp_path / "m")


def weights_that_do_not_fit(module):
    state = {name: tensor.numpy() for name, tensor in module.state_dict().items()}
    without = {name: array for name, array in state.items() if name != "angle.first"}
    short = {**state, "fields.position.weights": state["fields.position.weights"][:3]}
    infinite = {**state, "fields.position.mean": state["fields.position.mean"] + np.inf}
    return {
        "absent": (safetensors.numpy.save(without), "expected 'angle.first' of the shape"),
        "short": (safetensors.numpy.save(short), r"'fields.position.weights' of the shape \(20, 5\), got \(3, 5\)"),
        "infinite": (safetensors.numpy.save(infinite), "finite numbers in 'fields.position.mean'"),
        "no file": (b"none", "not a file of weights"),
    }


@pytest.mark.parametrize("what", ["absent", "short", "infinite", "no file"])
def test_weights_that_do_not_fit_are_refused(tmp_path, body, what, monkeypatch):
    module = module_of("biceps", body)
    data, words = weights_that_do_not_fit(module)[what]
    monkeypatch.setattr(safetensors.torch, "save", lambda state: data)
    save_modes(tmp_path / "m", body=body, module=module)
    with pytest.raises(InputError, match=words):
        read_low_rank(tmp_path / "m")
