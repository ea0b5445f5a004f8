"""A saved model held against cases, by every protocol that is fair to it.

A protocol is fair where its test pairs hold nothing that the model's training showed as a test would ask it: a model
that learned by `thesis` or `off_grid` has seen every factorial case as a target, so `strict` would flatter it. Where
the factorial cases are others than those that the training split, neither `thesis` nor `strict` is: the same seed holds
out other ones.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import FACTORIAL, OFF_GRID, PROTOCOLS, PairSet, Protocol, split_pairs
from myograph.ensemble.pairs.question import Batch
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError
from myograph.evaluation.evaluate import evaluate
from myograph.evaluation.summary import ErrorSummary
from myograph.inference.feeds import FIELD_PARTS
from myograph.inference.fitting import check_same_body
from myograph.inference.held_out import same_held_out
from myograph.inference.latency import forward_milliseconds
from myograph.inference.loaded import LoadedModel
from myograph.inference.model_file import Origin
from myograph.inference.ways import WHOLE, told_only, ways

FAIR: dict[str, tuple[Protocol, ...]] = {
    "thesis": ("thesis", "off_grid"),
    "off_grid": ("thesis", "off_grid"),
    "strict": PROTOCOLS,
}
"""Protocol of the training -> protocols of the test."""
PAIRS, DRAW_SEED = 1024, 0


@dataclass(frozen=True)
class SavedEvaluation:
    """What came of it.

    Parameters
    ----------
    protocols
        Errors by protocol.
    ways
        Likewise from activations alone, and from sensors alone, where the model answers from both, or from either:
        'activation', 'sensors' -> protocol -> errors.
    pairs
        Protocol -> number of pairs.
    left_out
        Protocol -> why it is not there.
    truth
        What the cases were computed by; empty where they do not say.
    latency_ms
        One forward pass for all nodes [ms].
    """

    protocols: dict[str, ErrorSummary]
    ways: dict[str, dict[str, ErrorSummary]]
    pairs: dict[str, int]
    left_out: dict[str, str]
    truth: str
    latency_ms: float


def evaluate_saved(model: LoadedModel, cases: MuscleCases, most_pairs: int = PAIRS) -> SavedEvaluation:
    """Errors on the test pairs of every fair protocol that the cases allow; of more pairs, that many at random.

    Raises InputError for cases of another body or without the model's fields, and where no protocol is left.
    """
    check_same_body(model, cases)
    sampler = _sampler(model, cases)
    asked = (WHOLE, *ways(model.told.signature))
    found: dict[str, dict[str, ErrorSummary]] = {way: {} for way in asked}
    pairs, left_out = {}, {}
    for protocol in PROTOCOLS:
        try:
            chosen = _test_pairs(cases, protocol, model.told.origin.split_seed)
            _check_fair(model.told.origin, cases, protocol)
        except InputError as problem:
            left_out[protocol] = str(problem)
            continue
        chosen = _some(chosen, most_pairs)
        pairs[protocol] = len(chosen)
        for way in asked:
            found[way][protocol] = evaluate(model, _told(sampler.batches(chosen), way)).summary()
    errors = found.pop(WHOLE)
    if not errors:
        raise InputError(f"{model.name}: expected cases for at least one protocol, got none: {left_out}")
    truth = cases.attributes.get("simulator", "")
    return SavedEvaluation(errors, found, pairs, left_out, truth, forward_milliseconds(model))


def _check_fair(origin: Origin, cases: MuscleCases, protocol: Protocol) -> None:
    """Raise InputError with the reason where the protocol would flatter."""
    if protocol not in FAIR.get(origin.protocol, PROTOCOLS):
        raise InputError(f"its cases taught this model (trained by '{origin.protocol}')")
    if protocol != "off_grid" and not same_held_out(origin, cases):
        raise InputError(
            f"its cases may have taught this model: expected the factorial cases of the training in their order, got "
            f"{len(cases.named(FACTORIAL))} others; take a dataset of the same design"
        )


def _told(batches: Iterator[Batch], way: str) -> Iterator[Batch]:
    return (replace(batch, question=told_only(batch.question, way)) for batch in batches)


def _sampler(model: LoadedModel, cases: MuscleCases) -> PairSampler:
    signature = model.told.signature
    told = {field for field in signature.rest_fields if any(p.format(field) in signature.inputs for p in FIELD_PARTS)}
    asked = told | {field for field in ("position", "von_mises") if field in model.fields and field in cases.fields}
    sensors = np.array(signature.sensors, dtype=np.int64) if signature.sensors else random_sensors(cases.nodes)
    return PairSampler(cases, sensors, signature.convention, tuple(sorted(told)), tuple(sorted(asked)))


def _test_pairs(cases: MuscleCases, protocol: Protocol, seed: int) -> Int[np.ndarray, "pairs 2"]:
    """As `split_pairs`; cases off the grid need no factorial ones beside them to be tested on."""
    if protocol != "off_grid":
        return split_pairs(cases, protocol, seed).test
    off_grid = cases.named(OFF_GRID)
    if len(off_grid) < 2:
        raise InputError(f"protocol 'off_grid': expected at least 2 cases of design 'off_grid', got {len(off_grid)}")
    pairs = PairSet(off_grid, off_grid).all()
    return pairs[pairs[:, 0] != pairs[:, 1]]


def _some(pairs: Int[np.ndarray, "pairs 2"], most: int) -> Int[np.ndarray, "some 2"]:
    """At most so many, drawn at random, each target as often as any other: what is asked are the targets' states."""
    if len(pairs) <= most:
        return pairs
    shuffled = np.random.default_rng(DRAW_SEED).permutation(pairs)
    by_target = np.argsort(shuffled[:, 1], kind="stable")
    _, first, count = np.unique(shuffled[by_target, 1], return_index=True, return_counts=True)
    turn = np.empty(len(pairs), dtype=np.int64)
    turn[by_target] = np.arange(len(pairs)) - np.repeat(first, count)
    return shuffled[np.sort(np.argsort(turn, kind="stable")[:most])]
