"""The cases of an ensemble: parts by different methods, one after the other, no case twice."""

from collections.abc import Iterable, Sequence

import numpy as np
from jaxtyping import Float

from myograph.case import MUSCLES, Case
from myograph.ensemble.design import points
from myograph.ensemble.design.cases import Design
from myograph.ensemble.design.listing import read_cases
from myograph.ensemble.design.spec import DesignSpec
from myograph.units import radians


def make_design(specs: Sequence[DesignSpec]) -> Design:
    """The cases of all parts. A case of an earlier part is left out later; `tenths` draws another one instead.

    Raises InputError where a part does not fit its method.
    """
    cases: dict[Case, str] = {}
    for spec in specs:
        spec.check()
        for case, word in _part(spec, cases):
            cases.setdefault(case, word)
    return Design(tuple(cases), tuple(cases.values()))


def _part(spec: DesignSpec, taken: dict[Case, str]) -> Iterable[tuple[Case, str]]:
    if spec.method == "list":
        assert spec.file is not None
        return list(zip(*read_cases(spec.file, spec.word), strict=True))
    dimension = len(MUSCLES) + len(spec.ranges)
    if spec.method == "tenths":
        assert spec.count is not None
        spare = min(len(taken), 11**dimension - spec.count) if spec.count <= 11**dimension else 0
        drawn = _cases(spec, points.tenths(dimension, spec.count + spare, spec.seed))
        chosen = [case for case in drawn if case not in taken][: spec.count]
    else:
        chosen = _cases(spec, _points(spec, dimension))
    return [(case, spec.word) for case in chosen]


def _points(spec: DesignSpec, dimension: int) -> Float[np.ndarray, "points dimension"]:
    if spec.method == "factorial":
        return points.factorial(dimension, spec.step)
    if spec.method == "sparse_grid":
        assert spec.level is not None
        return points.sparse_grid(dimension, spec.level)
    assert spec.count is not None
    if spec.method == "sobol":
        return points.sobol(dimension, spec.count, spec.seed)
    return points.latin_hypercube(dimension, spec.count, spec.seed)


def _cases(spec: DesignSpec, unit: Float[np.ndarray, "points dimension"]) -> list[Case]:
    """Points of the unit cube as cases: activations first, then the further dimensions in their ranges."""
    further = {
        name: (low + unit[:, len(MUSCLES) + k] * (high - low)).tolist()
        for k, (name, (low, high)) in enumerate(spec.ranges)
    }
    load = further.get("hand_load_n", [spec.hand_load_n] * len(unit))
    angle = further.get("elbow_angle_deg", [spec.elbow_angle_deg] * len(unit))
    return [
        Case(tuple(row[: len(MUSCLES)]), float(n), None if deg is None else radians(float(deg)))
        for row, n, deg in zip(unit.tolist(), load, angle, strict=True)
    ]
