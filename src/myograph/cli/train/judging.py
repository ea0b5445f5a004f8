"""Errors of a trained method under every protocol that is fair to it."""

import numpy as np

from myograph.ensemble.pairs.predictor import Predictor
from myograph.ensemble.pairs.protocols import Split, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.evaluation import ErrorSummary, evaluate
from myograph.evaluation.saved import DRAW_SEED, FAIR

FIGURES = ("mean_mm", "rmse_mm", "p95_mm", "max_mm", "relative", "von_mises_mean_mpa", "coverage_90")


def judge(
    predictor: Predictor, sampler: PairSampler, taught: Split, split_seed: int, pairs: int
) -> dict[str, ErrorSummary]:
    """Protocol -> errors, over at most so many test pairs of each; protocols that lack cases are left out."""
    errors: dict[str, ErrorSummary] = {}
    for protocol in FAIR[taught.protocol]:
        try:
            test = split_pairs(sampler.cases, protocol, split_seed).test
        except InputError:
            continue
        drawn = np.random.default_rng(DRAW_SEED).permutation(len(test))[:pairs]
        errors[protocol] = evaluate(predictor, sampler.batches(test[np.sort(drawn)])).summary()
    return errors


def table(errors: dict[str, ErrorSummary]) -> str:
    """A row for each protocol; a column for each figure that any of them has."""
    known = [name for name in FIGURES if any(getattr(row, name) is not None for row in errors.values())]
    lines = [" " * 10 + "".join(f"{name:>20}" for name in known)]
    for protocol, row in errors.items():
        values = [getattr(row, name) for name in known]
        lines.append(f"{protocol:10}" + "".join(f"{'–' if v is None else format(v, '.4g'):>20}" for v in values))
    return "\n".join(lines)
