"""Any method with 90 % intervals and a verdict: a share of the training cases is held out from it to calibrate both.

Cases of the design 'support' are held out where there are enough of them, for these lie within what was trained on; the
factorial corners, at the edge of it, else. Each way of telling a method (`myograph.inference.ways`) is calibrated by
itself, for errors from activations are not those from sensors.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float, Int

from myograph.ensemble.muscle_cases import MuscleCases
from myograph.ensemble.pairs.predictor import Learner, Predictor, Progress
from myograph.ensemble.pairs.protocols import SUPPORT, PairSet, Split
from myograph.ensemble.pairs.question import Answer, Question
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.inference.ways import Way, judges_sensors, scales_of
from myograph.learning.torch_predictor import TorchPredictor
from myograph.learning.trust.conformal import conformal_factor, promises
from myograph.learning.trust.nearness import Nearness, nearness
from myograph.learning.trust.scores import Scores, deviation_of, residual_of, scores, ways_of

LEAST_CASES = 9
"""Cases of equal weight from which on 90 % can be promised; of unequal weight it takes more."""
RESIDUAL_LEVEL = 0.99
"""Share of the calibration cases whose sensor residual is inside."""
CONSERVATIVE = 1.5
"""How far beyond that residual is still inside."""


@dataclass(frozen=True)
class CalibratedPredictor:
    """A predictor with `half_width_90` and `inside`.

    Parameters
    ----------
    factors
        Field -> half width over deviation, or, where the method knows no deviation, half width in the field's unit:
        what `myograph.learning.saving.Training.half_width_90` wants.
    factors_from
        Likewise where a method that reads both is told activations alone, or sensors alone.
    residual_mm
        Largest residual of the sensors that is inside; None where the method gives none.
    """

    predictor: Predictor
    factors: Mapping[str, float]
    nearness: Nearness
    residual_mm: float | None
    factors_from: Mapping[Way, Mapping[str, float]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """As it stands in tables."""
        return self.predictor.name

    @property
    def fields(self) -> tuple[str, ...]:
        """What it answers."""
        return self.predictor.fields

    @property
    def parameters(self) -> int:
        """Number of trained numbers, where the method says it."""
        return int(getattr(self.predictor, "parameters", 0))

    def predict(self, question: Question) -> Answer:
        """The answer, with intervals and verdict."""
        answer = self.predictor.predict(question)
        widths = {name: scale[:, None] * deviation_of(answer, name) for name, scale in self._scales(question).items()}
        inside = self._inside(question)
        return replace(answer, half_width_90=widths, inside=inside if answer.inside is None else inside & answer.inside)

    def _scales(self, question: Question) -> dict[str, np.ndarray]:
        if isinstance(self.predictor, TorchPredictor):
            return scales_of(question, self.predictor.signature, self.factors, self.factors_from)
        return {name: np.full(question.size, factor) for name, factor in self.factors.items()}

    def _inside(self, question: Question) -> np.ndarray:
        residual = residual_of(self.predictor, question)
        agrees = np.ones(question.size, dtype=bool)
        if residual is not None and self.residual_mm is not None:
            agrees = residual <= self.residual_mm
        if isinstance(self.predictor, TorchPredictor):
            agrees = agrees & judges_sensors(question, self.predictor.signature)
        if not _reads_activation(self.predictor):
            return agrees
        unknown = np.asarray(np.isnan(question.activation).any(axis=1))
        told = np.where(unknown[:, None], self.nearness.low[:-1], question.activation)
        return agrees & (unknown | self.nearness.near(told, question.hand_load))


@dataclass(frozen=True)
class CalibratedLearner:
    """Fits a method to all but a share of the training cases, and calibrates it on these."""

    learner: Learner
    share: float = 0.15
    seed: int = 0

    @property
    def name(self) -> str:
        """As it stands in tables."""
        return self.learner.name

    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> CalibratedPredictor:
        """Learn and calibrate; raises InputError, before it learns, where too few cases are left for either."""
        rest, held_out = hold_out(sampler.cases, split, self.share, self.seed)
        if not promises(edge_weights(sampler.cases.activation[held_out])):
            raise InputError(
                f"calibration: expected cases enough for 90 %, such as 9 of equal weight, got {len(held_out)}; "
                "hold out a larger share, or none"
            )
        return calibrate(self.learner.fit(sampler, rest, progress), sampler, rest, held_out, self.seed)


def enough(cases: MuscleCases, split: Split, share: float, seed: int = 0) -> bool:
    """Whether the cases that `hold_out` would draw can be calibrated on, by the weights that `calibrate` gives them.

    Raises InputError where these leave no training cases beside them.
    """
    if round(share * len(split.train.cases)) < LEAST_CASES:
        return False
    return promises(edge_weights(cases.activation[hold_out(cases, split, share, seed)[1]]))


def hold_out(cases: MuscleCases, split: Split, share: float, seed: int) -> tuple[Split, Int[np.ndarray, " held_out"]]:
    """The split without a share of its training cases, and these; raises InputError unless both have some."""
    taught = split.train.cases
    support = np.intersect1d(taught, cases.named(SUPPORT))
    count = round(share * len(taught))
    pool = support if len(support) >= 2 * count else taught
    if not 0 < count < len(taught):
        raise InputError(f"calibration: expected a share that holds out some of {len(taught)} cases, got {share:g}")
    chosen = np.sort(np.random.default_rng((seed, 90)).permutation(pool)[:count])
    initial, target = (np.setdiff1d(role, chosen) for role in (split.train.initial, split.train.target))
    if not len(initial) or not len(target):
        raise InputError(f"calibration: expected training cases beside the {count} held out, got none")
    return replace(split, train=PairSet(initial, target)), chosen


def calibrate(
    predictor: Predictor, sampler: PairSampler, split: Split, held_out: Int[np.ndarray, " held_out"], seed: int = 0
) -> CalibratedPredictor:
    """Factors and limits from held-out target cases, each with an initial case drawn from the training."""
    initial = np.random.default_rng((seed, 91)).choice(split.train.initial, len(held_out))
    pairs = np.stack([initial, held_out], axis=1)
    weights = edge_weights(sampler.cases.activation[held_out])
    whole = scores(predictor, sampler, pairs)
    residuals = whole.residuals
    limit = CONSERVATIVE * float(np.quantile(residuals, RESIDUAL_LEVEL)) if len(residuals) else None
    alone: dict[Way, dict[str, float]] = {
        way: factors_of(scores(predictor, sampler, pairs, way), weights) for way in ways_of(predictor)
    }
    near = nearness(sampler.cases, split.train.cases)
    return CalibratedPredictor(predictor, factors_of(whole, weights), near, limit, alone)


def factors_of(found: Scores, weights: Float[np.ndarray, " pairs"] | None = None) -> dict[str, float]:
    """Field -> the factor that holds 90 % of it."""
    return {name: conformal_factor(errors, found.deviations[name], weights) for name, errors in found.errors.items()}


def edge_weights(activation: Float[np.ndarray, "cases muscles"]) -> Float[np.ndarray, " cases"]:
    """How often a case of a grid stands for activations drawn anywhere in the unit cube, over one in the middle of it.

    A value at an end of [0, 1] stands for half a step of the grid: one half for each muscle that is there. Cases of
    continuous activations all weigh one, corners of the cube all the same.
    """
    return 0.5 ** ((activation == 0) | (activation == 1)).sum(axis=1)


def _reads_activation(predictor: Predictor) -> bool:
    """Whether activations are part of what it answers from; methods that do not say count as such."""
    return not isinstance(predictor, TorchPredictor) or "activation" in predictor.signature.inputs
