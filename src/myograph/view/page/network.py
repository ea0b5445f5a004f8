"""A network that can be asked anywhere, such as a graph element network, beside the modes of its muscle.

The modes say where the network's sensors are; the network answers at the nodes that the page draws. Its points are
named by the arm's own state at rest (convention 'initial') or by the reference body ('material'), so that the network
may know another mesh of the same muscle than the arm does: sensors are pieces of tissue.
"""

import base64
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import safetensors
import safetensors.numpy
from jaxtyping import Float, Int

from myograph.errors import InputError
from myograph.inference.loaded import LoadedModel, load
from myograph.inference.low_rank import LowRankMuscle
from myograph.inference.low_rank.field import LowRankField
from myograph.inference.low_rank.reading import METHOD
from myograph.inference.model_file import MODEL_FILE, NETWORK, WEIGHTS, read_file, read_model_file
from myograph.inference.session import run_session
from myograph.inference.verdict import MEASURED, WIDENED
from myograph.mesh.between import between
from myograph.view.page.packing import Packer
from myograph.view.page.source import ArmModels

STILL = ("sensor_places", "sensor_position_initial", "query_places", "query_position_initial")
ASKED = ("sensor_position_target", "activation", "hand_load")
"""Inputs that stay, and those that a question changes."""
GRAPH = "gen"


@dataclass(frozen=True)
class PageNetwork:
    """A network in the body of an arm's muscle.

    Parameters
    ----------
    model, data
        The saved model, and the bytes of its network.
    muscle
        Modes of the same muscle.
    sensors
        Weights of the arm's nodes for each sensor.
    rest
        Positions of the arm's nodes at rest [mm]: the initial state.
    graph
        Learned nodes of a graph element network, in the space of its places [mm]; None for another kind.
    """

    model: LoadedModel
    data: bytes
    muscle: LowRankMuscle
    sensors: Float[np.ndarray, "sensors nodes"]
    rest: Float[np.ndarray, "nodes 3"]
    graph: Float[np.ndarray, "graph_nodes 3"] | None

    def still(self, nodes: Int[np.ndarray, " some"]) -> dict[str, Float[np.ndarray, "1 _ 3"]]:
        """What it is told in every question about these nodes."""
        initial = self.model.told.signature.convention == "initial"
        places = self.rest if initial else self.muscle.reference
        every = {
            "sensor_places": self.sensors @ places,
            "sensor_position_initial": self.sensors @ self.rest,
            "query_places": places[nodes],
            "query_position_initial": self.rest[nodes],
        }
        return {
            name: every[name][None].astype(np.float32) for name in self.model.told.signature.inputs if name in every
        }

    def positions(
        self, activation: Float[np.ndarray, " muscles"], hand_load: float, nodes: Int[np.ndarray, " some"]
    ) -> Float[np.ndarray, "some 3"]:
        """Positions of these nodes [mm] as the network says, from sensors as the modes say."""
        told = self.model.told.signature
        now = self.muscle.at(activation, hand_load)["position"]
        asked = {
            "sensor_position_target": (self.sensors @ now)[None],
            "activation": activation[None],
            "hand_load": np.array([hand_load]),
        }
        changing = {name: asked[name].astype(np.float32) for name in told.inputs if name in asked}
        found = run_session(self.model.session, {**self.still(nodes), **changing}, told.outputs)
        return found["position"][0].astype(np.float64)


def is_network(folder: Path) -> bool:
    """Whether a folder holds a single saved model that is no neural modes."""
    return (folder / MODEL_FILE).is_file() and read_model_file(folder).method != METHOD


def read_network(folder: Path, arm: ArmModels) -> PageNetwork:
    """A saved network, to be asked where the nodes of this arm's muscle are.

    Raises InputError for a damaged model, one that cannot be asked anywhere, one that wants to know more than a page
    knows, one of a muscle or of an arm that this is not.
    """
    model = load(folder)
    _check(folder, model, arm)
    told, muscle = model.told, arm.muscles[model.told.muscle]
    trained = muscle.trained_range
    rest = muscle.at(np.array(trained.activation_low), trained.hand_load[0])["position"]
    places = model.body.body.reference[list(told.signature.sensors)].astype(np.float64)
    try:
        sensors = between(muscle.reference, muscle.cells, places).matrix(len(muscle.reference))
    except InputError as problem:
        raise InputError(f"{folder}: its sensors in the {told.muscle} of {arm.name}: {problem}") from None
    data = read_file(folder, NETWORK, told.files[NETWORK])
    return PageNetwork(model, data, muscle, sensors, rest, _graph_nodes(folder, model))


def packed_network(network: PageNetwork, nodes: Int[np.ndarray, " some"], packer: Packer) -> dict[str, Any]:
    """What the page is told of it; `nodes` are those that the page has of the muscle."""
    told = network.model.told
    low, high = _boxes(network)
    return {
        "name": told.name,
        "muscle": told.muscle,
        "inputs": list(told.signature.inputs),
        "model": base64.b64encode(network.data).decode("ascii"),
        "still": {name: packer.reals(values[0]) for name, values in network.still(nodes).items()},
        "sensors": _packed_sensors(network, packer),
        "low": packer.reals(low),
        "high": packer.reals(high),
        "nodes": None if network.graph is None else packer.reals(network.graph),
    }


def _check(folder: Path, model: LoadedModel, arm: ArmModels) -> None:
    told = model.told
    signature = told.signature
    foreign = [name for name in signature.inputs if name not in (*STILL, *ASKED)]
    anywhere = any(name.startswith("query_") for name in signature.inputs)
    if foreign or not anywhere or "position" not in signature.outputs:
        raise InputError(
            f"{folder}: expected neural modes that answer from activations, or a network that gives positions of "
            f"any points and reads no more than {', '.join((*STILL, *ASKED))}; got the method '{told.method}', which "
            f"reads {', '.join(signature.inputs)} and gives {', '.join(signature.outputs)}"
        )
    if signature.takes_sensors and not signature.sensors:
        raise InputError(f"{folder}: expected a model that names the sensors of its training, got none")
    if told.muscle not in arm.muscles:
        known = ", ".join(arm.muscles)
        raise InputError(f"{folder}: expected a network of {known}, which {arm.name} has, got one of {told.muscle}")
    arms = told.origin.arm_checksum, arm.told[told.muscle].origin.arm_checksum
    if all(arms) and arms[0] != arms[1]:
        raise InputError(
            f"{folder}: expected a network of the arm {arms[1][:12]} that {arm.name} was made with, got one of the arm "
            f"{arms[0][:12]}; give neural modes of that arm and this network: myograph view MODES --network {folder}"
        )


def _graph_nodes(folder: Path, model: LoadedModel) -> Float[np.ndarray, "graph_nodes 3"] | None:
    """Nodes of the graph [mm]: in the box times its length, from its lowest corner."""
    if model.told.method != GRAPH:
        return None
    data = read_file(folder, WEIGHTS, model.told.files[WEIGHTS])
    try:
        weights: Mapping[str, np.ndarray] = safetensors.numpy.load(data)
        nodes = weights["network.nodes"] * weights["length"] + weights["lowest"]
    except (safetensors.SafetensorError, KeyError, ValueError) as problem:
        raise InputError(f"{folder / WEIGHTS}: expected the nodes of a graph element network: {problem}") from None
    if nodes.ndim != 2 or nodes.shape[1] != 3 or not np.isfinite(nodes).all():
        raise InputError(f"{folder / WEIGHTS}: expected finite nodes of three coordinates, got shape {nodes.shape}")
    return nodes.astype(np.float64)


def _boxes(network: PageNetwork) -> tuple[np.ndarray, np.ndarray]:
    """Where each sensor was in training: widened as in `myograph.inference.verdict`, and by how far it is elsewhere at
    rest in the arm's mesh than in the network's.
    """
    body = network.model.body
    nodes = list(network.model.told.signature.sensors)
    low, high = body.low[nodes].astype(np.float64), body.high[nodes].astype(np.float64)
    length = float(np.linalg.norm(np.ptp(body.rest["position"], axis=0)))
    other = np.linalg.norm(network.sensors @ network.rest - body.rest["position"][nodes], axis=-1, keepdims=True)
    slack = WIDENED * np.linalg.norm(high - low, axis=-1, keepdims=True) + MEASURED * length + other
    return low - slack, high + slack


def _packed_sensors(network: PageNetwork, packer: Packer) -> dict[str, Any]:
    """Positions of the sensors as a field of their own: those of the muscle, at other points."""
    field: LowRankField = network.muscle.fields["position"]
    return {
        "components": field.components,
        "degrees": list(field.degrees),
        "mean": packer.reals(network.sensors @ field.mean),
        "modes": packer.reals(np.einsum("sn,knc->ksc", network.sensors, field.modes)),
        "weights": packer.doubles(field.weights),
        "misfit": packer.reals(np.zeros(len(network.sensors))),
        "factor": None,
    }
