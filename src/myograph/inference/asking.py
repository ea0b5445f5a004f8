"""A Question made of what a person has: activations, or measured sensors.

The initial state is the body at rest: the training case with the least activation.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from myograph.case import MUSCLES, Case, check_muscle
from myograph.ensemble.pairs.question import FieldValues, Question
from myograph.errors import InputError
from myograph.inference.body_file import ModelBody
from myograph.inference.signature import Signature

Numbers = float | Sequence[Any] | np.ndarray
Activation = Mapping[str, Numbers] | Numbers
"""By name (one number, or one for each case), in the order of `myograph.MUSCLES`, or a row for each case [-]."""
Sensors = Numbers
"""Nodes, or places in the reference body (sensors, 3) [mm]."""


@dataclass(frozen=True)
class Asked:
    """Activations (cases, muscles), loads [N], sensors and where these are now (cases, sensors, 3) [mm], queries."""

    activation: np.ndarray
    hand_load: np.ndarray
    sensors: np.ndarray
    positions: np.ndarray
    queries: np.ndarray


def question_of(asked: Asked, signature: Signature, body: ModelBody) -> Question:
    """The question about the body at rest as the initial state."""
    size = len(asked.activation)
    places = body.rest["position"] if signature.convention == "initial" else body.body.reference

    def repeated(values: np.ndarray) -> np.ndarray:
        return np.broadcast_to(values, (size, *values.shape))

    def rest(nodes: np.ndarray) -> FieldValues:
        return {name: repeated(values[nodes]) for name, values in body.rest.items()}

    return Question(
        signature.convention,
        asked.activation,
        asked.hand_load,
        asked.sensors,
        asked.queries,
        repeated(places[asked.sensors]),
        repeated(places[asked.queries]),
        rest(asked.sensors),
        {"position": asked.positions},
        rest(asked.queries),
    )


def activation_rows(activation: Activation) -> Float[np.ndarray, "cases muscles"]:
    """A row for each case; raises InputError for unknown or missing muscles, and for what is not in [0, 1]."""
    if isinstance(activation, Mapping):
        for name in activation:
            check_muscle(name)
        missing = [name for name in MUSCLES if name not in activation]
        if missing:
            raise InputError(f"activation: expected all of {', '.join(MUSCLES)}, got none of {', '.join(missing)}")
    try:
        if isinstance(activation, Mapping):
            activation = np.stack(np.broadcast_arrays(*(activation[name] for name in MUSCLES)), axis=-1)
        rows = np.atleast_2d(np.asarray(activation, dtype=np.float64))
    except (TypeError, ValueError):
        raise InputError(f"activation: expected numbers, got {activation!r}") from None
    if rows.ndim != 2 or not len(rows):
        raise InputError(f"activation: expected rows of {len(MUSCLES)} numbers, got shape {rows.shape}")
    return np.array([Case(tuple(row)).activations for row in rows.tolist()])


def queried(queries: Numbers | None, nodes: int) -> Int[np.ndarray, " queries"]:
    """These nodes, or all; raises InputError for nodes that the body does not have."""
    if queries is None:
        return np.arange(nodes)
    found = np.asarray(queries, dtype=np.int64).reshape(-1)
    if not len(found) or not 0 <= found.min() <= found.max() < nodes:
        raise InputError(f"queries: expected nodes from 0 to {nodes - 1}, got {found.tolist()}")
    return found


def sensor_nodes(sensors: Sensors, body: ModelBody) -> Int[np.ndarray, " sensors"]:
    """The nodes, or those at the places; raises InputError for a sensor that is on none of the body's nodes, or twice.

    A place belongs to the nearest node where that is nearer than half the way from a node to its next one.
    """
    given = np.asarray(sensors)
    if given.ndim == 2 and given.shape[1] == 3 and len(given):
        nodes = _nearest(given.astype(np.float64), body)
    elif given.ndim == 1 and given.dtype.kind in "iu":
        nodes = given.astype(np.int64)
        if not len(nodes) or not 0 <= nodes.min() <= nodes.max() < body.nodes:
            raise InputError(f"sensors: expected nodes from 0 to {body.nodes - 1}, got {nodes.tolist()}")
    else:
        raise InputError(f"sensors: expected node numbers or places of three coordinates, got shape {given.shape}")
    if len(np.unique(nodes)) < len(nodes):
        raise InputError(f"sensors: expected every node once, got {nodes.tolist()}; leave out the copies")
    return nodes


def sensor_positions(
    positions: Numbers, sensors: Int[np.ndarray, " sensors"], body: ModelBody
) -> Float[np.ndarray, "cases sensors 3"]:
    """A row for each case; raises InputError for other shapes, NaN, and what is nowhere near the muscle.

    Near is within the length of the resting body of where the node was in training.
    """
    found = np.asarray(positions, dtype=np.float64)
    found = found[None] if found.ndim == 2 else found
    if found.ndim != 3 or found.shape[1:] != (len(sensors), 3):
        raise InputError(f"positions: expected {len(sensors)} sensors of three coordinates, got shape {found.shape}")
    if not np.isfinite(found).all():
        raise InputError("positions: expected finite numbers of mm, got NaN or infinity")
    length = float(np.linalg.norm(np.ptp(body.rest["position"], axis=0)))
    beyond = np.maximum(body.low[sensors] - found, found - body.high[sensors]).clip(min=0)
    worst = np.linalg.norm(beyond, axis=-1).max(axis=0)
    if worst.max() > length:
        raise InputError(
            f"positions: expected sensors within {length:.0f} mm of where they were in training, got node "
            f"{sensors[worst.argmax()]} {worst.max():.0f} mm away; are these mm, in the arm's frame?"
        )
    return found


def _nearest(places: Float[np.ndarray, "sensors 3"], body: ModelBody) -> Int[np.ndarray, " sensors"]:
    if not np.isfinite(places).all():
        raise InputError("sensors: expected finite places in mm, got NaN or infinity")
    tree = KDTree(body.body.reference)
    reach = 0.5 * float(np.median(tree.query(body.body.reference, k=2)[0][:, 1]))
    distance, nodes = (np.atleast_1d(found) for found in tree.query(places))
    if distance.max() > reach:
        worst = int(distance.argmax())
        raise InputError(
            f"sensors: expected places on nodes of the reference body (within {reach:.2g} mm), got "
            f"{places[worst].tolist()}, {distance[worst]:.3g} mm from node {nodes[worst]}: outside it?"
        )
    return nodes
