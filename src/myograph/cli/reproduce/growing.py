r"""Which cases to simulate next: at random, or where the model taught so far is least sure of itself.

A Gaussian process is taught on `FIRST` random cases, says its kernel k, and the next cases are chosen one after the
other; the deviation after one more case needs no answer of that case. When there are twice as many, it is taught again.

    k(i, j) <- k(i, j) - k(i, c) k(c, j) / (k(c, c) + s²)          after case c

    random      as a shuffled list has them
    deviation   argmax_c k(c, c): where the predicted deviation is largest
    overall     argmax_c sum_i k(i, c)² / (k(c, c) + s²): what lowers the sum of all variances of the pool most

Sources: MacKay 1992 for both; Cohn 1996 names the second ALC. Trap: the largest deviation is at the border of the cube.
"""

from collections.abc import Callable, Mapping

import numpy as np
from jaxtyping import Float

from myograph.cli.reproduce.trial import Choice, Drawn
from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.protocols import FACTORIAL, OFF_GRID, split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.views import chosen

FIRST = 8
Covariance = Float[np.ndarray, "pool pool"]


def grown(cases: MuscleCases, drawn: Drawn | None, seed: int) -> MuscleCases:
    """Cases with as many factorial ones as are drawn; all of them where nothing is said."""
    if drawn is None:
        return cases
    pool = cases.named(FACTORIAL)
    picked = np.random.default_rng(seed).permutation(len(pool))
    if drawn.by == "random":
        return _with(cases, pool[picked[: drawn.count]].tolist())
    taken = picked[: min(FIRST, drawn.count)].tolist()
    while len(taken) < drawn.count:
        covariance, noise = _process(cases, pool, taken)
        taken = next_cases(covariance, noise, taken, (min(2 * len(taken), drawn.count), drawn.by))
    return _with(cases, pool[taken].tolist())


def next_cases(covariance: Covariance, noise: float, taken: list[int], asked: tuple[int, Choice]) -> list[int]:
    """The cases that are taken, and more of the pool until there are as many as asked, chosen so."""
    count, by = asked
    left, taken = covariance.copy(), list(taken)
    free = np.ones(len(left), dtype=bool)
    for case in taken:
        left, free[case] = _after(left, case, noise), False
    while len(taken) < count:
        case = int(np.where(free, GAINS[by](left, noise), -np.inf).argmax())
        left, free[case] = _after(left, case, noise), False
        taken.append(case)
    return taken


def _largest(left: Covariance, noise: float) -> Float[np.ndarray, " pool"]:
    return left.diagonal()


def _overall(left: Covariance, noise: float) -> Float[np.ndarray, " pool"]:
    return np.square(left).sum(axis=0) / (left.diagonal() + noise)


GAINS: Mapping[str, Callable[[Covariance, float], Float[np.ndarray, " pool"]]] = {
    "deviation": _largest,
    "overall": _overall,
}


def _after(left: Covariance, case: int, noise: float) -> Covariance:
    return left - np.outer(left[case], left[case]) / (left[case, case] + noise)


def _process(cases: MuscleCases, pool: np.ndarray, taken: list[int]) -> tuple[Covariance, float]:
    """Covariance of the pool's leading mode by the process that the taken cases teach, and its noise."""
    from myograph.learning.baselines.gp_module import PodGpModule
    from myograph.learning.baselines.pod_gp import PodGp

    known = _with(cases, pool[taken].tolist())
    fitted = PodGp().fit(PairSampler(known, random_sensors(known.nodes)), split_pairs(known, "off_grid"))
    assert isinstance(fitted.module, PodGpModule)
    process = fitted.module.processes["position"]
    lengths, amplitude, noise = (getattr(process, name).numpy() for name in ("lengths", "amplitude", "noise"))
    places = cases.activation[pool] / lengths
    scaled = np.sqrt(3 * np.square(places[:, None] - places).sum(axis=-1))
    return float(amplitude) * (1 + scaled) * np.exp(-scaled), float(noise)


def _with(cases: MuscleCases, numbers: list[int]) -> MuscleCases:
    return chosen(cases, {FACTORIAL: sorted(numbers), OFF_GRID: cases.named(OFF_GRID).tolist()})
