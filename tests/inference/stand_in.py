"""A muscle of forty nodes that stretches by formulas, and two saved models of it whose networks are written by hand."""

import itertools

import numpy as np
import onnx.parser

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.fields import FIELDS
from myograph.inference.body_file import ModelBody, body_bytes
from myograph.inference.model_file import BODY, CARD, NETWORK, WEIGHTS, ModelFile, Origin, TrainedRange
from myograph.inference.signature import Signature
from myograph.inference.writing import write_model

SENSORS = (0, 13, 27, 39)
LENGTH = 100.0  # mm
HEAD = '<ir_version: 8, opset_import: ["" : 18]>'

# position = X (1 + stretch a) + shift a;  von Mises = |position - X| / 100;  muscles that nobody knows of rest
FROM_ACTIVATION = (
    HEAD
    + """
model (float[B,5] activation, float[B,Q,3] query_places) => (float[B,Q,3] position, float[B,Q] von_mises)
<float[5,3] stretch = {0,0,0, 0,0,0, -0.2,0.2,0, 0,0,0, 0.1,-0.1,0},
 float[5,3] shift = {0,10,0, 0,0,5, 0,0,0, 0,0,0, 0,0,0},
 float one = {1.0}, float zero = {0.0}, float modulus = {0.01}, int64[1] points = {1}, int64[1] axis = {2}>
{
    unknown = IsNaN(activation)
    known = Where(unknown, zero, activation)
    scale = MatMul(known, stretch)
    scales = Unsqueeze(scale, points)
    factors = Add(scales, one)
    way = MatMul(known, shift)
    ways = Unsqueeze(way, points)
    stretched = Mul(query_places, factors)
    position = Add(stretched, ways)
    moved = Sub(position, query_places)
    distance = ReduceL2<keepdims=0>(moved, axis)
    von_mises = Mul(distance, modulus)
}
"""
)
# every point moves as the sensors do on average; the residual is the largest way of a sensor from that
FROM_SENSORS = (
    HEAD
    + """
model (float[B,N,3] sensor_position_initial, float[B,N,3] sensor_position_target, float[B,Q,3] query_places)
 => (float[B,Q,3] position, float[B,Q] position_deviation, float[B] sensor_residual)
<int64[1] points = {1}, int64[1] axis = {2}, float one = {1.0}, int64[1] row = {1}>
{
    moved = Sub(sensor_position_target, sensor_position_initial)
    mean = ReduceMean<keepdims=1>(moved, points)
    position = Add(query_places, mean)
    apart = Sub(moved, mean)
    distance = ReduceL2<keepdims=0>(apart, axis)
    sensor_residual = ReduceMax<keepdims=0>(distance, points)
    column = Unsqueeze(sensor_residual, row)
    zeros = ReduceSum<keepdims=0>(query_places, axis)
    nothing = Sub(zeros, zeros)
    ones = Add(nothing, one)
    position_deviation = Mul(ones, column)
}
"""
)


def grid():
    """Nodes (40, 3) [mm] of a rod of 10 x 2 x 2, and its hexahedra."""
    nodes = np.array(list(itertools.product(np.linspace(0, LENGTH, 10), (0.0, 10.0), (0.0, 10.0))))
    return nodes, 4 * np.arange(9)[:, None] + np.array([[0, 4, 6, 2, 1, 5, 7, 3]])


def place(activation):
    """Positions [mm] (cases, nodes, 3): what FROM_ACTIVATION says."""
    nodes, _ = grid()
    shorter = 1 - 0.2 * activation[:, 2] + 0.1 * activation[:, 4]
    moved = np.stack([0 * shorter, 10 * activation[:, 0], 5 * activation[:, 1]], axis=-1)
    return np.stack([shorter, 2 - shorter, 0 * shorter + 1], axis=-1)[:, None] * nodes + moved[:, None]


def stand_in_cases(muscle="biceps", error=0.0):
    """32 corners and 8 between, of one muscle; `error` [mm] is added to all x."""
    corners = np.array(list(itertools.product((0.0, 1.0), repeat=5)))
    activation = np.concatenate([corners, np.random.default_rng(5).uniform(size=(8, 5))])
    nodes, cells = grid()
    position = place(activation)
    stress = np.linalg.norm(position - nodes, axis=-1) * 1e-2
    body = Body(nodes, cells[:, :4], cells)
    fields = {"position": position + np.array([error, 0, 0]), "von_mises": stress}
    return cases_in_memory(muscle, body, activation, ["factorial"] * 32 + ["off_grid"] * 8, fields)


def stand_in_body():
    """The body, and where its nodes were."""
    cases = stand_in_cases()
    position = cases.values("position", np.arange(32))
    return ModelBody(cases.body, position.min(axis=0), position.max(axis=0), {"position": position[0]})


def network(text):
    """The bytes of a network that is written by hand."""
    return onnx.parser.parse_model(text).SerializeToString()


def told(name, signature, **other):
    """What model.json says."""
    ranges = TrainedRange(activation_low=(0.0,) * 5, activation_high=(1.0,) * 4 + (0.5,), hand_load=(0.0, 20.0))
    origin = Origin(
        dataset="d",
        arm_checksum="a",
        preset="tiny",
        simulator="formulas",
        protocol="strict",
        split_seed=0,
        cases=25,
        seed=0,
        command="by hand",
        seconds=0.0,
        versions={},
    )
    said = {
        "name": name,
        "method": "by_hand",
        "muscle": "biceps",
        "signature": signature,
        "fields": {field: FIELDS[field].unit for field in signature.fields},
        "config": {},
        "parameters": 30,
        "opset": 18,
        "parity": 0.0,
        "metrics": {},
        "half_width_90": {},
        "trained_range": ranges,
        "origin": origin,
        "limits": (),
        "files": {},
    }
    return ModelFile(**{**said, **other})


LINEAR = Signature(inputs=("activation", "query_places"), outputs=("position", "von_mises"), convention="material")
MEAN = Signature(
    inputs=("sensor_position_initial", "sensor_position_target", "query_places"),
    outputs=("position", "position_deviation", "sensor_residual"),
    sensors=SENSORS,
    any_sensors=True,
    least_sensors=2,
)


def files(text):
    """The files beside model.json."""
    return {NETWORK: network(text), BODY: body_bytes(stand_in_body()), WEIGHTS: b"none", CARD: b"# by hand\n"}


def save_linear(folder, **other):
    """The exact model, from activations."""
    said = {"half_width_90": {"position": 0.25}, **other}
    return write_model(told("linear", LINEAR, **said), files(FROM_ACTIVATION), folder)


def save_mean(folder, **other):
    """A rough model, from any two sensors and more."""
    ranges = told("mean", MEAN).trained_range.model_copy(update={"residual_mm": 8.0})
    said = {"half_width_90": {"position": 1.5}, "trained_range": ranges, **other}
    return write_model(told("mean", MEAN, **said), files(FROM_SENSORS), folder)
