"""How the inputs of a model are taken out of a Question: the one table, for torch and onnxruntime alike."""

import re
from collections.abc import Callable, Iterable

import numpy as np

from myograph.ensemble.pairs.question import FieldValues, Question
from myograph.errors import InputError
from myograph.fields import FIELDS

PARTS: dict[str, Callable[[Question], np.ndarray]] = {
    "activation": lambda question: question.activation,
    "hand_load": lambda question: question.hand_load,
    "sensor_places": lambda question: question.sensor_places,
    "query_places": lambda question: question.query_places,
    "sensor_nodes": lambda question: question.sensor_nodes,
    "query_nodes": lambda question: question.query_nodes,
}
FIELD_PARTS: dict[str, Callable[[Question], FieldValues]] = {
    "sensor_{}_initial": lambda question: question.sensor_initial,
    "sensor_{}_target": lambda question: question.sensor_target,
    "query_{}_initial": lambda question: question.query_initial,
}
WITHOUT_BATCH = ("sensor_nodes", "query_nodes")
"""Inputs that are the same for all pairs: int64; all others are float32 with the batch first."""


def feeds(question: Question, inputs: Iterable[str]) -> dict[str, np.ndarray]:
    """Input name -> array; raises InputError for a field that the question does not tell."""
    return {name: _array(name, _part(question, name)) for name in inputs}


def check_inputs(inputs: Iterable[str]) -> None:
    """Raise InputError for a name that is no part of a question."""
    for name in inputs:
        _source(name)


def _array(name: str, part: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(part, dtype=np.int64 if name in WITHOUT_BATCH else np.float32)


def _part(question: Question, name: str) -> np.ndarray:
    part, field = _source(name)
    if field is None:
        return PARTS[part](question)
    values = FIELD_PARTS[part](question)
    if field not in values:
        raise InputError(f"'{name}': expected a question that tells {field}, got one of {', '.join(values)}")
    return values[field]


def _source(name: str) -> tuple[str, str | None]:
    if name in PARTS:
        return name, None
    for part in FIELD_PARTS:
        match = re.fullmatch(part.format("(.+)"), name)
        if match and match[1] in FIELDS:
            return part, match[1]
    known = ", ".join([*PARTS, *(part.format("FIELD") for part in FIELD_PARTS)])
    raise InputError(f"unknown input '{name}': expected one of {known}, with FIELD one of {', '.join(FIELDS)}")
