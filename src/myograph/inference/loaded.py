"""A saved model ready to answer, by onnxruntime."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import onnxruntime
from jaxtyping import Float

from myograph.case import MUSCLES
from myograph.ensemble.pairs.question import Answer, Question
from myograph.errors import InputError
from myograph.inference.answers import answer_of, check_given
from myograph.inference.asking import (
    Activation,
    Asked,
    Numbers,
    Sensors,
    activation_rows,
    queried,
    question_of,
    sensor_nodes,
    sensor_positions,
)
from myograph.inference.body_file import ModelBody, body_of
from myograph.inference.feeds import WITHOUT_BATCH, feeds
from myograph.inference.model_file import BODY, CARD, NETWORK, ModelFile, read_file, read_model_file
from myograph.inference.question import check_question
from myograph.inference.session import open_session, run_session
from myograph.inference.shipped import find_model
from myograph.inference.verdict import inside
from myograph.inference.ways import scales_of, with_noise

PAIRS_AT_ONCE = 16


@dataclass(frozen=True)
class LoadedModel:
    """A `myograph.ensemble.pairs.predictor.Predictor` of one muscle, and two ways to ask it without pairs.

    Parameters
    ----------
    told
        What model.json says.
    body
        The body that it knows.
    session
        Its network.
    """

    told: ModelFile
    body: ModelBody
    session: onnxruntime.InferenceSession

    @property
    def name(self) -> str:
        """As it stands in tables."""
        return self.told.name

    @property
    def fields(self) -> tuple[str, ...]:
        """What it answers."""
        return self.told.signature.fields

    def predict(self, question: Question) -> Answer:
        """Answer a question about pairs, with a verdict whether each is within what training covered.

        Raises InputError for a question that is not finite, not in the model's convention, or not from its sensors;
        NotConvergedError where the network gives no numbers.
        """
        return self._answered(question, 0.0)

    def _answered(self, question: Question, sensor_noise: float) -> Answer:
        signature = self.told.signature
        check_question(question, signature)
        given = feeds(question, signature.inputs)
        parts = [
            run_session(self.session, _rows(given, first), signature.outputs)
            for first in range(0, max(question.size, 1), PAIRS_AT_ONCE)
        ]
        outputs = {name: np.concatenate([part[name] for part in parts]) for name in signature.outputs}
        check_given(outputs, question.size, len(question.query_nodes))
        verdict = inside(question, outputs, (signature, self.told.trained_range, self.body), sensor_noise)
        scales = scales_of(question, signature, self.told.half_width_90, self.told.half_width_90_from)
        return answer_of(outputs, with_noise(scales, signature, sensor_noise), verdict)

    def predict_activation(
        self, activation: Activation, hand_load: Numbers = 0.0, queries: Numbers | None = None
    ) -> Answer:
        """The muscle at these activations [-] of all five and this load [N]: at all nodes, or at those asked.

        One row of activations makes a batch of one; a row for each case, one of as many. Raises InputError for a model
        that answers from sensors only.
        """
        signature = self.told.signature
        if "activation" not in signature.inputs or (signature.takes_sensors and signature.least_sensors > 0):
            raise InputError(f"{self.name}: answers from sensors; expected them (predict_sensors), got activations")
        rows = activation_rows(activation)
        none = np.zeros(0, dtype=np.int64)
        load = _loads(hand_load, len(rows))
        asked = Asked(rows, load, none, np.zeros((len(rows), 0, 3)), queried(queries, self.body.nodes))
        return self.predict(question_of(asked, signature, self.body))

    def predict_sensors(
        self,
        sensors: Sensors,
        positions: Numbers,
        queries: Numbers | None = None,
        activation: Activation | None = None,
        hand_load: Numbers = 0.0,
        sensor_noise: float = 0.0,
    ) -> Answer:
        """The muscle whose sensors are now at `positions` [mm]: at all nodes, or at those asked.

        `sensors` are nodes, or places in the reference body [mm]; `positions` are (sensors, 3), or a block for each
        case; the initial state is the body at rest. Activations are needed where the model takes them too and cannot do
        without. `sensor_noise` is the standard deviation of a measured coordinate [mm]: half widths and the verdict
        allow for it. Raises InputError for a model that answers from activations only.
        """
        if not 0 <= sensor_noise < math.inf:
            raise InputError(f"sensor noise: expected a standard deviation in mm, got {sensor_noise!r}")
        signature = self.told.signature
        if not signature.takes_sensors:
            raise InputError(f"{self.name}: answers from activations; expected them (predict_activation), got sensors")
        if activation is not None and "activation" not in signature.inputs:
            raise InputError(f"{self.name}: answers from sensors alone; expected no activations beside them")
        nodes = sensor_nodes(sensors, self.body)
        now = sensor_positions(positions, nodes, self.body)
        if set(nodes.tolist()) == set(signature.sensors):
            nodes, now = _in_order(nodes, now, signature.sensors)
        if activation is None and "activation" in signature.inputs and not signature.unknown_activation:
            raise InputError(f"{self.name}: expected activations beside the sensors, got none")
        rows = np.full((len(now), len(MUSCLES)), np.nan) if activation is None else activation_rows(activation)
        if len(rows) != len(now):
            raise InputError(f"expected activations for {len(now)} cases, got {len(rows)}")
        asked = Asked(rows, _loads(hand_load, len(now)), nodes, now, queried(queries, self.body.nodes))
        return self._answered(question_of(asked, signature, self.body), sensor_noise)


def load(folder: Path | str, threads: int = 1) -> LoadedModel:
    """Read a saved model, or a shipped one by its name; all is checked, nothing unpickled, no other file opened.

    Raises InputError where it is missing, truncated, altered, of another schema, or does not fit together.
    """
    folder = find_model(folder) if isinstance(folder, str) else folder
    told = read_model_file(folder)
    body = body_of(read_file(folder, BODY, told.files[BODY]), str(folder / BODY))
    read_file(folder, CARD, told.files[CARD])
    missing = [name for name in told.signature.rest_fields if name not in body.rest]
    if missing:
        raise InputError(f"{folder / BODY}: expected the state at rest of {', '.join(missing)}, found none")
    if any(not 0 <= node < body.nodes for node in told.signature.sensors):
        raise InputError(f"{folder}: expected sensors among {body.nodes} nodes, got {list(told.signature.sensors)}")
    network = read_file(folder, NETWORK, told.files[NETWORK])
    return LoadedModel(told, body, open_session(network, told.signature, threads, str(folder / NETWORK)))


def _rows(given: Mapping[str, np.ndarray], first: int) -> dict[str, np.ndarray]:
    rows = slice(first, first + PAIRS_AT_ONCE)
    return {name: array if name in WITHOUT_BATCH else array[rows] for name, array in given.items()}


def _in_order(nodes: np.ndarray, now: np.ndarray, wanted: Sequence[int]) -> tuple[np.ndarray, np.ndarray]:
    """The sensors in the order of the training, for models that tell them apart by it."""
    order = np.argsort(nodes)[np.argsort(np.argsort(wanted))]
    return nodes[order], now[:, order]


def _loads(hand_load: Numbers, cases: int) -> Float[np.ndarray, " cases"]:
    loads = np.asarray(hand_load, dtype=np.float64)
    if not np.isfinite(loads).all() or loads.shape not in ((), (1,), (cases,)):
        raise InputError(f"load at the hand: expected newtons, one number or one for each case, got {hand_load!r}")
    return np.broadcast_to(loads, (cases,)).copy()
