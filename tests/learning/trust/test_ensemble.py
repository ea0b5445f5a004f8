"""Several members as one."""

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.trust.ensemble import EnsembleLearner, EnsemblePredictor
from tests.learning.trust.guessers import Guesser, Stresser


def test_the_answer_is_the_mean_and_the_deviation_the_spread(sampler, split):
    question = sampler.batch(split.test[:3]).question
    answer = EnsembleLearner((Guesser(1.0), Guesser(3.0))).fit(sampler, split).predict(question)
    assert np.allclose(answer.values["position"] - question.query_initial["position"], [2, 0, 0], atol=1e-5)
    assert np.allclose(answer.deviation["position"], 1, atol=1e-5)
    assert answer.inside is None


def test_von_mises_is_that_of_the_mean_stress(sampler, split):
    question = sampler.batch(split.test[:3]).question
    answer = EnsemblePredictor("two", (Stresser(1.0), Stresser(-0.5))).predict(question)
    assert np.allclose(answer.values["von_mises"], 0.25 * question.query_initial["von_mises"], rtol=1e-4)


def test_inside_is_where_all_members_say_so(sampler, split):
    question = sampler.batch(split.test[:2]).question
    for other, verdict in ((True, True), (False, False)):
        members = (Guesser(0.0, inside=True), Guesser(0.0), Guesser(0.0, inside=other))
        assert EnsemblePredictor("three", members).predict(question).inside.tolist() == [verdict] * 2


def test_one_member_is_no_ensemble():
    with pytest.raises(InputError, match="at least 2 members, got 1"):
        EnsemblePredictor("one", (Guesser(0.0),))


def test_members_of_different_fields_are_refused():
    with pytest.raises(InputError, match="the same fields"):
        EnsemblePredictor("odd", (Guesser(0.0), Stresser(1.0)))
