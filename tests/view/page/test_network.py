"""A network beside the modes of its muscle: its sensors in another mesh, what it is asked, what is refused."""

import json
from dataclasses import replace

import numpy as np
import pytest
import safetensors.numpy
import safetensors.torch

from myograph.anatomy.load import built_in_arm
from myograph.errors import InputError
from myograph.inference.loaded import load
from myograph.inference.model_file import WEIGHTS
from myograph.inference.shipped import models_folder
from myograph.learning.gen.rebuild import rebuild
from myograph.view.page import PageArm, filled_page, is_network, page_content, read_arm_models, read_network
from myograph.view.page.network import packed_network
from myograph.view.page.packing import Packer
from myograph.view.page.template import ENGINE, SCRIPTS, WITH_WORKER
from tests.view.page.arm import make_arm, save_network
from tests.view.page.test_content import unpacked

FRAME = f"<title>myograph</title>{SCRIPTS}@@MYOGRAPH_DATA@@|@@MYOGRAPH_NUMBERS@@{ENGINE}"
MIXED = np.array([0.3, 0.9, 0.6, 0.1, 0.2])
BY_NODES = {"inputs": ("sensor_position_initial", "sensor_nodes", "query_nodes")}


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    return make_arm(tmp_path_factory.mktemp("arm") / "arm")


@pytest.fixture(scope="module")
def saved(models, tmp_path_factory):
    folder = tmp_path_factory.mktemp("network") / "mean"
    save_network(folder, models)
    return folder


def test_it_answers_what_the_saved_model_answers(models, saved):
    network, model = read_network(saved, models), load(saved)
    muscle, sensors = models.muscles["biceps"], list(model.told.signature.sensors)
    nodes = np.unique(muscle.skin)[::7]
    now = muscle.at(MIXED, 4.0)["position"]
    answer = model.predict_sensors(sensors, now[sensors], queries=nodes)
    np.testing.assert_allclose(network.positions(MIXED, 4.0, nodes), answer.values["position"][0], atol=1e-3)
    assert answer.inside is not None
    assert answer.inside.all()


def test_points_are_named_by_the_models_convention(models, saved, tmp_path):
    save_network(tmp_path / "material", models, signature={"convention": "material"})
    nodes = np.array([0, 5])
    initial, material = (read_network(folder, models).still(nodes) for folder in (saved, tmp_path / "material"))
    muscle = models.muscles["biceps"]
    np.testing.assert_allclose(initial["query_places"][0], muscle.at(np.zeros(5))["position"][nodes], rtol=1e-6)
    np.testing.assert_allclose(material["query_places"][0], muscle.reference[nodes], rtol=1e-6)


def test_the_page_is_told_its_sensors_as_modes_and_where_they_were(models, saved):
    network, packer = read_network(saved, models), Packer()
    told = packed_network(network, np.arange(10), packer)
    text, muscle = packer.text(), models.muscles["biceps"]
    modes, mean = (unpacked(text, told["sensors"][name]) for name in ("modes", "mean"))
    place = muscle.place(MIXED, 0.0)
    found = mean + np.tensordot(muscle.fields["position"].amounts(place.x, place.u), modes, axes=1)
    np.testing.assert_allclose(
        found, muscle.at(MIXED)["position"][list(network.model.told.signature.sensors)], atol=1e-3
    )
    assert (unpacked(text, told["low"]) < found).all()
    assert (found < unpacked(text, told["high"])).all()
    assert told["nodes"] is None


def test_the_difference_is_a_field_and_what_runs_it_is_put_in(models, saved):
    with_network = page_content(PageArm(models, network=read_network(saved, models)))
    without = page_content(PageArm(models))
    assert set(with_network.fields) - set(without.fields) == {"difference"}
    assert any("from 4 sensors, placed as the modes say" in note for note in with_network.notes)
    choice = next(field for field in json.loads(with_network.data)["fields"] if field["key"] == "difference")
    assert (choice["unit"], choice["low"]) == ("mm", 0)
    page = filled_page(FRAME, with_network, "<runtime>")
    assert WITH_WORKER in page
    assert page.endswith("<runtime>")
    plain = filled_page(FRAME, without, "<runtime>")
    assert WITH_WORKER not in plain
    assert "<runtime>" not in plain


def test_nodes_of_the_shipped_graph_are_those_that_torch_builds():
    folder = models_folder() / "gen-biceps"
    if not folder.is_dir():
        pytest.skip("this installation has no graph element network")
    network = read_network(folder, read_arm_models(models_folder() / "arm", built_in_arm()))
    module = rebuild(network.model.told.config, {})
    module.load_state_dict(safetensors.torch.load((folder / WEIGHTS).read_bytes()))
    assert network.graph is not None
    np.testing.assert_allclose(network.graph, module.nodes_mm, atol=1e-4)


@pytest.mark.parametrize(
    ("other", "sentence"),
    [
        ({"signature": BY_NODES}, "a network that gives positions of any points.*got the method 'by_hand'"),
        ({"signature": {"sensors": ()}}, "names the sensors of its training, got none"),
        ({"arm": "another arm"}, r"a network of the arm a that .* was made with, got one of the arm another arm"),
        (
            {"method": "gen", "weights": safetensors.numpy.save({"a": np.zeros(3)})},
            "the nodes of a graph element network",
        ),
        ({"method": "gen", "weights": b"none"}, "the nodes of a graph element network"),
    ],
)
def test_what_cannot_be_asked_in_a_page_is_refused(models, tmp_path, monkeypatch, other, sentence):
    arm = other.pop("arm", None) if "arm" in other else None
    save_network(tmp_path / "network", models, **{key: value for key, value in other.items() if key != "signature"})
    model = load(tmp_path / "network")
    signature = model.told.signature.model_copy(update=other.get("signature", {}))
    origin = model.told.origin.model_copy(update={"arm_checksum": arm} if arm else {})
    told = model.told.model_copy(update={"signature": signature, "origin": origin})
    monkeypatch.setattr("myograph.view.page.network.load", lambda _: replace(model, told=told))
    with pytest.raises(InputError, match=sentence):
        read_network(tmp_path / "network", models)


def test_a_network_of_a_muscle_that_the_arm_has_not_is_refused(models, saved):
    without = replace(models, muscles={"triceps": models.muscles["triceps"]})
    with pytest.raises(InputError, match="expected a network of triceps, which arm has, got one of biceps"):
        read_network(saved, without)


def test_modes_are_no_such_network_and_a_folder_of_models_is_none(models, saved, tmp_path):
    assert is_network(saved)
    assert not is_network(make_folder(tmp_path))
    assert not is_network(tmp_path / "nothing")


def make_folder(tmp_path):
    make_arm(tmp_path / "arm")
    return tmp_path / "arm"
