"""A method held against the truth: what is measured, and that pieces give what the whole gives."""

import numpy as np
import pytest

from myograph.ensemble.pairs.question import Answer
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError
from myograph.evaluation import evaluate, summarise
from myograph.fields import von_mises
from tests.ensemble.pairs.made_up import NODES, made_up

PAIRS = np.array([[0, 3], [1, 4], [3, 1], [5, 2], [7, 8]])
FIELDS = ("position", "von_mises", "cauchy_stress")


class Oracle:
    """Knows the cases; answers some fields, off by a shift [mm] and a stress [MPa], within told intervals."""

    name = "oracle"

    def __init__(self, cases, fields=("position",), off=0.0, half_width=None, inside=None):
        self.cases, self.fields, self.off = cases, fields, off
        self.half_width, self.inside = half_width, inside

    def predict(self, question):
        target = np.array([np.flatnonzero((self.cases.activation == a).all(1))[0] for a in question.activation])
        off = {name: np.array([self.off, 0, 0]) if name == "position" else self.off for name in self.fields}
        values = {name: self.cases.values(name, target)[:, question.query_nodes] + off[name] for name in self.fields}
        widths = {} if self.half_width is None else dict.fromkeys(values, self.half_width[:, question.query_nodes])
        inside = None if self.inside is None else self.inside[target]
        return Answer(values, half_width_90={k: w[: len(target)] for k, w in widths.items()}, inside=inside)


@pytest.fixture
def cases():
    return made_up()


@pytest.fixture
def batch(cases):
    """Function: batches of pairs at all queries, asked in some fields."""

    def make(asked=("position",), size=5, pairs=PAIRS):
        return PairSampler(cases, random_sensors(NODES), asked=asked).batches(pairs, size)

    return make


def test_a_shift_of_two_millimetres_is_an_error_of_two(cases, batch):
    found = evaluate(Oracle(cases, off=2.0), batch())
    assert found.position.errors == pytest.approx(np.full((5, NODES - 9), 2.0), rel=1e-6)
    assert found.von_mises is None
    assert found.summary().coverage_90 is None
    assert found.summary().inside is None


def test_evaluating_in_batches_gives_what_all_at_once_gives(cases, batch):
    widths = np.random.default_rng(0).uniform(0, 4, (5, NODES))
    widths[:] = widths[0]
    oracle = Oracle(cases, FIELDS, 1.5, widths, np.arange(9) % 2 == 0)
    once, parts = evaluate(oracle, batch(FIELDS)), evaluate(oracle, batch(FIELDS, size=2))
    np.testing.assert_array_equal(parts.position.errors, once.position.errors)
    np.testing.assert_array_equal(parts.von_mises.errors, once.von_mises.errors)
    for name, figure in once.summary().figures().items():
        assert getattr(parts.summary(), name) == pytest.approx(figure, rel=1e-12), name
    assert parts.inside == once.inside == 3 / 5


def test_the_summary_is_that_of_positions_at_hand(cases, batch):
    [all_pairs] = batch()
    true, initial = all_pairs.truth["position"], all_pairs.question.query_initial["position"]
    expected = summarise(true + np.array([1.0, 0, 0]), true, initial)
    assert evaluate(Oracle(cases, off=1.0), batch()).summary() == expected


def test_doing_nothing_has_relative_error_1(batch):
    class Nothing:
        name, fields = "do_nothing", ("position",)

        def predict(self, question):
            return Answer(question.query_initial)

    assert evaluate(Nothing(), batch(size=2)).summary().relative == pytest.approx(1, rel=1e-6)


def test_stresses_are_measured_in_mpa_and_relative_to_their_mean(cases, batch):
    found = evaluate(Oracle(cases, ("von_mises",), 0.3), batch(("von_mises",))).summary()
    mean = cases.values("von_mises", PAIRS[:, 1])[:, np.setdiff1d(np.arange(NODES), random_sensors(NODES))].mean()
    assert found.von_mises_mean_mpa == pytest.approx(0.3, rel=1e-6)
    assert found.von_mises_max_mpa == pytest.approx(0.3, rel=1e-6)
    assert found.von_mises_relative == pytest.approx(0.3 / mean, rel=1e-6)
    assert found.mean_mm is found.max_mm is None


def test_a_cauchy_stress_stands_for_its_von_mises_stress(cases, batch):
    """Pressure (the same in xx, yy, zz) does not count; here every component is off by 1 MPa: von Mises sqrt(3²)."""
    assert evaluate(Oracle(cases, ("cauchy_stress",)), batch(("von_mises",))).summary().von_mises_max_mpa < 1e-6
    found = evaluate(Oracle(cases, ("cauchy_stress",), 1.0), batch(("cauchy_stress",)))
    [all_pairs] = batch(("cauchy_stress",))
    stress = all_pairs.truth["cauchy_stress"]
    assert found.von_mises.errors == pytest.approx(np.abs(von_mises(stress + 1) - von_mises(stress)), rel=1e-4)


def test_coverage_is_the_share_of_errors_within_the_interval(cases, batch):
    """Errors are 2 everywhere; seven of the eleven queries have a half width that holds them."""
    widths = np.full((5, NODES), 1.9)
    queries = np.setdiff1d(np.arange(NODES), random_sensors(NODES))
    widths[:, queries[:7]] = 2.1
    found = evaluate(Oracle(cases, ("position", "von_mises"), 2.0, widths), batch(FIELDS)).summary()
    assert found.coverage_90 == found.von_mises_coverage_90 == pytest.approx(7 / 11)


def test_what_is_not_asked_is_not_measured(cases, batch):
    found = evaluate(Oracle(cases, FIELDS), batch(("position",))).summary()
    assert found.von_mises_mean_mpa is None
    assert found.mean_mm == 0


def test_the_figures_for_programs_have_their_agreed_names(cases, batch):
    assert list(evaluate(Oracle(cases, off=1.0), batch()).summary().figures()) == [
        "mean_mm", "rmse_mm", "p95_mm", "max_mm", "relative", "von_mises_mean_mpa", "von_mises_max_mpa", "coverage_90",
    ]  # fmt: skip


def test_errors_are_kept_in_single_precision(cases, batch):
    assert evaluate(Oracle(cases), batch()).position.errors.dtype == np.float32


@pytest.mark.parametrize("pairs", [PAIRS[:0], None])
def test_evaluating_no_pair_or_nothing_that_is_answered_is_refused(cases, batch, pairs):
    batches = batch(pairs=pairs) if pairs is not None else batch(("von_mises",))
    with pytest.raises(InputError, match="oracle: expected at least one pair to evaluate"):
        evaluate(Oracle(cases), batches)


def test_batches_with_different_queries_are_refused(cases):
    sampler = PairSampler(cases, random_sensors(NODES))
    batches = [sampler.batch(PAIRS, sampler.queries[:count]) for count in (4, 5)]
    with pytest.raises(InputError, match="4 queries in every batch, got 5"):
        evaluate(Oracle(cases), batches)
