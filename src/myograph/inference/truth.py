"""Some cases of one muscle as one small file of plain arrays: the truth that shipped models are held against.

muscle, arm_checksum, preset, simulator      words; `schema` a number
activation, hand_load, elbow_angle, design   of every case [-], [N], [rad], word
reference, skin, cells                       the body, as in `myograph.inference.body_file`
field_FIELD                                  cases nodes ..., float32, to the nearest 2^-13 mm or 2^-16 MPa
seconds                                      mean time of a case in the runs that solved them [s], where that is known
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Int

from myograph.case import MUSCLES, check_muscle
from myograph.ensemble.muscle_cases import MuscleCases, cases_in_memory
from myograph.ensemble.spec import Body
from myograph.errors import InputError
from myograph.fields import FIELDS, value_shape
from myograph.files import read_bounded, write_whole
from myograph.inference.arrays import check_array, read_arrays
from myograph.inference.body_file import check_nodes

SCHEMA = 1
FINEST = {"mm": -13, "MPa": -16}
"""Unit -> power of two that values are rounded to: 0.00012 mm, 0.000015 MPa."""
MOST_BYTES = 2**28
PER_CASE = "seconds_per_case"
"""The attribute that `seconds` becomes."""
_WORDS, _FIELD = ("arm_checksum", "preset", "simulator"), "field_"
_NEEDED = (
    "schema",
    "muscle",
    *_WORDS,
    "activation",
    "hand_load",
    "elbow_angle",
    "design",
    "reference",
    "skin",
    "cells",
)


def write_truth(path: Path, cases: MuscleCases, numbers: Int[np.ndarray, " some"], fields: tuple[str, ...]) -> None:
    """Write some cases and some of their fields."""
    arrays = {
        "schema": np.array(SCHEMA),
        "muscle": np.array(cases.muscle),
        **{word: np.array(cases.attributes.get(word, "")) for word in _WORDS},
        "activation": cases.activation[numbers],
        "hand_load": cases.hand_load[numbers],
        "elbow_angle": cases.elbow_angle[numbers],
        "design": np.array([cases.design[number] for number in numbers.tolist()]),
        "reference": cases.body.reference.astype(np.float32),
        "skin": cases.body.skin.astype(np.int32),
        "cells": cases.body.cells.astype(np.int32),
        **{_FIELD + name: _rounded(cases.values(name, numbers), name) for name in fields},
    }
    seconds = seconds_per_case(cases)
    if seconds is not None:
        arrays["seconds"] = np.array(seconds)
    write_whole(path, lambda file: np.savez_compressed(file, allow_pickle=False, **arrays))


def seconds_per_case(cases: MuscleCases) -> float | None:
    """Mean time of a case in the runs that solved them [s], with all muscles; None where the cases do not tell."""
    told = cases.attributes
    try:
        found = float(told[PER_CASE]) if PER_CASE in told else float(told["seconds"]) / len(cases)
    except (KeyError, ValueError, ZeroDivisionError):
        return None
    return found if np.isfinite(found) and found > 0 else None


def _rounded(values: np.ndarray, name: str) -> np.ndarray:
    """Digits that no surrogate reaches are left out: what is left is smaller when it is packed."""
    finest = 2.0 ** FINEST.get(FIELDS[name].unit, -24)
    return (np.round(values / finest) * finest).astype(np.float32)


def read_truth(path: Path) -> MuscleCases:
    """The cases; raises InputError for a file that is missing, damaged, of another schema, or does not fit itself."""
    arrays = read_arrays(read_bounded(path, MOST_BYTES), str(path), MOST_BYTES)
    missing = [name for name in _NEEDED if name not in arrays]
    if missing:
        raise InputError(f"{path}: expected the arrays {', '.join(_NEEDED)}, found no {', '.join(missing)}")
    if arrays["schema"].tolist() != SCHEMA:
        raise InputError(f"{path}: expected schema {SCHEMA}, got {arrays['schema'].tolist()}; make it anew")
    fields = {name.removeprefix(_FIELD): values for name, values in arrays.items() if name.startswith(_FIELD)}
    foreign = [name for name in fields if name not in FIELDS]
    if foreign:
        raise InputError(f"{path}: unknown fields {', '.join(foreign)}")
    _check(arrays, fields, str(path))
    return _cases(arrays, fields)


def _check(arrays: dict[str, np.ndarray], fields: dict[str, np.ndarray], source: str) -> None:
    """Raise InputError for an array of another kind or shape than the others need."""
    check_array(arrays["activation"], (None, len(MUSCLES)), "f", f"{source}: activation")
    check_array(arrays["reference"], (None, 3), "f", f"{source}: reference")
    cases, nodes = len(arrays["activation"]), len(arrays["reference"])
    if not cases or not nodes:
        raise InputError(f"{source}: expected cases of a body of nodes, got {cases} cases of {nodes} nodes")
    words = dict.fromkeys(("muscle", *_WORDS), ((), "U"))
    shapes: dict[str, tuple[tuple[int | None, ...], str]] = {
        **words,
        "design": ((cases,), "U"),
        **dict.fromkeys(("hand_load", "elbow_angle"), ((cases,), "f")),
        "skin": ((None, 4), "i"),
        "cells": ((None, None), "i"),
        **{_FIELD + name: ((cases, nodes, *value_shape(name)), "f") for name in fields},
        **({"seconds": ((), "f")} if "seconds" in arrays else {}),
    }
    for name, (shape, kind) in shapes.items():
        check_array(arrays[name], shape, kind, f"{source}: {name}", unknown=name == "elbow_angle")
    for name in ("skin", "cells"):
        check_nodes(arrays[name], nodes, f"{source}: {name}")


def _cases(arrays: dict[str, np.ndarray], fields: dict[str, np.ndarray]) -> MuscleCases:
    cases = cases_in_memory(
        check_muscle(str(arrays["muscle"])),
        Body(arrays["reference"], arrays["skin"], arrays["cells"]),
        arrays["activation"],
        [str(word) for word in arrays["design"]],
        fields,
        arrays["elbow_angle"],
    )
    words = {word: str(arrays[word]) for word in _WORDS}
    if "seconds" in arrays:
        words[PER_CASE] = str(arrays["seconds"])
    return replace(cases, hand_load=arrays["hand_load"], attributes=words)
