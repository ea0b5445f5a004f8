"""A torch model that is saved answers alike in torch, in onnxruntime, and when it is loaded to go on training."""

import re
from pathlib import Path

import numpy as np
import onnx
import pytest
import torch
from safetensors.torch import save
from torch import nn

from myograph.config import Model
from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError, NotConvergedError
from myograph.inference.held_out import factorial_checksum
from myograph.inference.loaded import load
from myograph.inference.model_file import CARD, MODEL_FILE, NETWORK, WEIGHTS
from myograph.inference.signature import Signature
from myograph.inference.writing import write_model
from myograph.learning import methods, onnx_export, onnx_parity
from myograph.learning.saveable import Saveable
from myograph.learning.saving import Training, load_torch, save_model
from myograph.learning.torch_predictor import TorchPredictor
from tests.inference.stand_in import SENSORS, stand_in_cases

PAIRS = np.array([[0, 5], [9, 35], [17, 1]])


OPSET = 20


class Widths(Model):
    """Width of the hidden layer."""

    hidden: int = 8


class Mixed(nn.Module):
    """Answers from sensors and activations: the mean way, and a perceptron of the place, the way and the activation."""

    def __init__(self, config):
        super().__init__()
        self.layers = nn.Sequential(nn.Linear(11, config.hidden), nn.Tanh(), nn.Linear(config.hidden, 3))
        self.register_buffer("unit", torch.tensor(100.0))

    def forward(self, activation, sensor_position_initial, sensor_position_target, query_places):
        moved = sensor_position_target - sensor_position_initial
        mean = moved.mean(dim=1, keepdim=True)
        known = torch.cat([mean / self.unit, activation[:, None]], dim=-1).expand(-1, query_places.shape[1], -1)
        position = query_places + mean + self.layers(torch.cat([query_places / self.unit, known], dim=-1))
        residual = torch.linalg.vector_norm(moved - mean, dim=-1).amax(dim=1)
        return position, torch.linalg.vector_norm(position - query_places, dim=-1) / self.unit, residual


def rebuild(config, shapes):
    assert shapes["layers.0.weight"] == (config["hidden"], 11)
    return Mixed(Widths(**config))


SIGNATURE = Signature(
    inputs=("activation", "sensor_position_initial", "sensor_position_target", "query_places"),
    outputs=("position", "von_mises", "sensor_residual"),
    sensors=SENSORS,
    any_sensors=True,
    least_sensors=2,
)


def mixed(module=None, **other):
    torch.manual_seed(3)
    signature = SIGNATURE.model_copy(update=other)
    return TorchPredictor("mixed", "mixed", module or Mixed(Widths()), signature, Widths(), pairs_at_once=2)


def training():
    cases = stand_in_cases()
    return Training(
        cases,
        split_pairs(cases, "strict"),
        command="pytest",
        metrics={"strict": {"mean_mm": 0.125}},
        half_width_90={"position": 0.5},
        residual_mm=8.0,
        limits=("Made for tests.",),
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mixed") / "model"
    save_model(mixed(), training(), folder, opset=OPSET)
    return folder


def question(pairs=PAIRS, sensors=SENSORS):
    return PairSampler(stand_in_cases(), np.array(sensors)).batch(pairs).question


def test_a_torch_predictor_can_predict_and_be_saved():
    assert isinstance(mixed(), Predictor)
    assert isinstance(mixed(), Saveable)
    assert mixed().parameters == 11 * 8 + 8 + 8 * 3 + 3


@pytest.mark.parametrize("pairs", [PAIRS, PAIRS[:1]])
@pytest.mark.parametrize("sensors", [SENSORS, (1, 30), tuple(range(12))])
def test_torch_and_onnxruntime_answer_alike(folder, pairs, sensors):
    asked = question(pairs, sensors)
    ours, theirs = mixed().predict(asked), load(folder).predict(asked)
    for field in ("position", "von_mises"):
        np.testing.assert_allclose(theirs.values[field], ours.values[field], rtol=1e-5, atol=1e-4)


def test_a_loaded_torch_model_has_the_same_weights_and_can_be_trained(folder):
    loaded = load_torch(folder, rebuild)
    before = loaded.predict(question()).values["position"]
    np.testing.assert_array_equal(before, mixed().predict(question()).values["position"])
    optimiser = torch.optim.SGD(loaded.module.parameters(), lr=1e-3)
    loaded.module(*(torch.ones(1, *shape) for shape in ((5,), (2, 3), (2, 3), (4, 3))))[0].sum().backward()
    optimiser.step()
    assert np.abs(loaded.predict(question()).values["position"] - before).max() > 0


def test_what_is_saved_says_where_it_comes_from(folder):
    told = load(folder).told
    assert (told.name, told.method, told.muscle, told.config) == ("mixed", "mixed", "biceps", {"hidden": 8})
    assert (told.origin.protocol, told.origin.cases, told.origin.dataset) == ("strict", 25, stand_in_cases().checksum)
    assert told.parity <= 1e-5
    assert told.metrics == {"strict": {"mean_mm": 0.125}}
    assert told.trained_range.residual_mm == 8.0
    assert told.origin.versions["torch"] == torch.__version__


def test_the_card_says_what_it_is_and_is_not(folder):
    card = (folder / CARD).read_text()
    for word in ("# mixed: biceps", "4 sensors", "strict", "| 0.125 |", "Made for tests.", "inside = False", "MIT"):
        assert word in card


def test_nothing_of_the_machine_is_in_the_network(folder):
    data = (folder / NETWORK).read_bytes()
    assert str(Path(__file__).parent).encode() not in data
    assert b"torch/nn" not in data


def test_what_only_the_network_names_is_numbered(folder):
    graph = onnx.load(folder / NETWORK).graph
    kept = {item.name for part in (graph.input, graph.output, graph.initializer) for item in part}
    assert all(re.fullmatch(r"v\d+", name) for node in graph.node for name in node.output if name not in kept)
    assert not any(node.name for node in graph.node)


def test_a_network_with_a_graph_in_a_graph_keeps_its_names():
    inner = onnx.helper.make_graph([], "inner", [], [])
    outer = onnx.helper.make_node("If", ["a"], ["b"], "branch", then_branch=inner, else_branch=inner)
    graph = onnx.helper.make_graph([outer], "outer", [], [])
    onnx_export._shorten(graph)
    assert graph.node[0].name == "branch"


def test_the_body_at_rest_is_the_case_with_the_least_activation(folder):
    body, cases = load(folder).body, stand_in_cases()
    taught = training().split.train.cases
    least = taught[np.linalg.norm(cases.activation[taught], axis=1).argmin()]
    np.testing.assert_allclose(body.rest["position"], cases.values("position", np.array([least]))[0], atol=2**-11)
    position = cases.values("position", taught)
    assert (body.low <= position.min(axis=0)).all()
    assert (body.high >= position.max(axis=0)).all()
    np.testing.assert_allclose(body.high, position.max(axis=0), atol=2**-6)


def test_the_operator_set_is_the_chosen_one(folder):
    network = onnx.load_model_from_string((folder / NETWORK).read_bytes())
    assert load(folder).told.opset == OPSET
    assert {item.domain: item.version for item in network.opset_import}[""] == OPSET


def test_an_operator_set_that_torch_does_not_reach_is_refused(tmp_path, monkeypatch):
    """Torch warns, where it cannot convert a network, and gives that of its own operator set."""
    exported = torch.onnx.export
    monkeypatch.setattr(
        torch.onnx, "export", lambda *given, **asked: exported(*given, **{**asked, "opset_version": 18})
    )
    with pytest.raises(InputError, match=r"mixed: opset: expected one that torch can write .* got 20: it would be 18"):
        save_model(mixed(), training(), tmp_path / "model", opset=20)
    assert not (tmp_path / "model").exists()


def test_the_list_that_the_split_was_drawn_from_is_told(folder):
    assert load(folder).told.origin.factorial == factorial_checksum(stand_in_cases())


def test_a_network_that_answers_otherwise_is_not_saved(tmp_path, folder, monkeypatch):
    network = (folder / NETWORK).read_bytes()
    monkeypatch.setattr(onnx_export, "_network", lambda *_: network)
    other = mixed()
    with torch.no_grad():
        other.module.layers[2].bias += 1.0  # mm
    with pytest.raises(NotConvergedError, match="expected onnxruntime to answer like torch"):
        save_model(other, training(), tmp_path / "model")
    assert list(tmp_path.iterdir()) == []


def test_numbers_that_are_none_are_no_parity():
    nothing = np.full((2, 2), np.nan, np.float32)
    assert onnx_parity._difference(np.ones((2, 2), np.float32), nothing) == np.inf
    assert onnx_parity._difference(np.ones((2, 2)), np.ones((2, 1))) == np.inf
    assert onnx_parity._difference(nothing, nothing) == 0


def test_modules_that_fix_the_number_of_pairs_are_refused(tmp_path):
    class OnePair(Mixed):
        def forward(self, *arguments):
            position, stress, residual = super().forward(*arguments)
            return position.reshape(2, 7, 3), stress, residual

    with pytest.raises(InputError, match=r"a free number of pairs|any number of pairs"):
        save_model(mixed(OnePair(Widths())), training(), tmp_path / "model")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / "thesis.txt").write_text("years of work")
    with pytest.raises(InputError, match="expected a saved model or nothing"):
        save_model(mixed(), training(), tmp_path)


def test_weights_that_do_not_fit_are_refused(folder, tmp_path):
    told = load(folder).told
    files = {name: (folder / name).read_bytes() for name in told.files}
    for weights, message in ((b"none", "not a file of weights"), (save({"x": torch.zeros(1)}), "does not fit")):
        write_model(told, {**files, WEIGHTS: weights}, tmp_path / "model")
        with pytest.raises(InputError, match=message):
            load_torch(tmp_path / "model", lambda config, shapes: Mixed(Widths(**config)))


@pytest.mark.parametrize("problem", [MemoryError(), KeyError("a.b"), RuntimeError("negative dimension"), ValueError()])
def test_a_configuration_that_no_module_can_have_is_refused(folder, problem):
    def build(config, shapes):
        raise problem

    with pytest.raises(InputError, match=r"does not fit what model\.json says"):
        load_torch(folder, build)


def test_altered_weights_are_refused(folder, tmp_path):
    told = load(folder).told
    write_model(told, {name: (folder / name).read_bytes() for name in told.files}, tmp_path / "model")
    data = (tmp_path / "model" / WEIGHTS).read_bytes()
    (tmp_path / "model" / WEIGHTS).write_bytes(data[:-1] + bytes([data[-1] ^ 1]))
    with pytest.raises(InputError, match=r"weights.safetensors: expected SHA-256"):
        load_torch(tmp_path / "model", rebuild)


def test_a_method_that_nobody_knows_is_refused(folder):
    with pytest.raises(InputError, match="method 'mixed': expected one of"):
        load_torch(folder)


def test_a_known_method_is_rebuilt_by_its_own_function(folder, monkeypatch):
    monkeypatch.setitem(methods.REBUILD, "mixed", f"{__name__}:rebuild")
    assert load_torch(folder).config.model_dump() == {"hidden": 8}


@pytest.mark.parametrize("method", methods.REBUILD)
def test_every_method_of_the_table_has_its_function(method):
    assert callable(methods.rebuild_of(method))


@pytest.mark.parametrize(
    ("other", "message"),
    [
        ({"inputs": ("shoe_size",)}, "unknown input 'shoe_size'"),
        ({"outputs": ("taste",)}, "unknown output 'taste'"),
    ],
)
def test_names_that_nobody_knows_are_refused(other, message):
    with pytest.raises(InputError, match=message):
        mixed(**other)


def test_a_torch_predictor_checks_what_it_is_asked():
    with pytest.raises(InputError, match="expected at least 2 sensors"):
        mixed().predict(question(sensors=(1,)))
    with pytest.raises(InputError, match="expected at least one pair"):
        mixed().outputs(question(PAIRS[:0]))
    with pytest.raises(InputError, match="expected a question that tells von_mises"):
        mixed(inputs=("activation", "sensor_von_mises_target")).predict(question())


def test_prediction_leaves_the_module_in_its_mode():
    model = mixed()
    for training_mode in (True, False):
        model.module.train(training_mode)
        model.predict(question())
        assert model.module.training is training_mode


def test_a_model_without_onnx_names_the_extra(tmp_path, monkeypatch):
    def missing(*_, **__):
        raise ModuleNotFoundError("No module named 'onnxscript'", name="onnxscript")

    monkeypatch.setattr(torch.onnx, "export", missing)
    with pytest.raises(InputError, match=r"myograph\[train\]"):
        save_model(mixed(), training(), tmp_path / "model")


def test_only_a_saved_model_is_loaded(tmp_path):
    with pytest.raises(InputError, match=f"found no {MODEL_FILE} there"):
        load_torch(tmp_path)
