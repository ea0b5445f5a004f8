"""Feed-forward network and deep operator network: they can learn a few cases by heart, and answer as they promise."""

import numpy as np
import pytest
import torch

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.ensemble.pairs.protocols import PairSet, Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.baselines import deeponet_module, node_network
from myograph.learning.baselines.by_cases import spread_of
from myograph.learning.baselines.deeponet import DeepONet
from myograph.learning.baselines.deeponet_module import DeepONetConfig
from myograph.learning.baselines.feed_forward import FeedForward
from myograph.learning.baselines.node_network import FeedForwardConfig, growing_widths
from myograph.learning.training import TrainingConfig
from tests.learning.baselines.stand_in import distances, stand_in_sampler

SHORT = TrainingConfig(steps=300, batch=8, queries=60, learning_rate=5e-3)
FEW = TrainingConfig(steps=3, batch=8, queries=16)
SMALL = {"terms": 12, "branch": (48, 48), "trunk": (48, 48)}


@pytest.fixture(scope="module")
def six_cases():
    """Pairs among six cases, to be learned by heart."""
    few = np.array([0, 5, 11, 31, 40, 60])
    return Split("strict", PairSet(few, few), np.stack([few, np.roll(few, 1)], axis=1))


def learners(training, drive="activation"):
    return [FeedForward(training=training), DeepONet(DeepONetConfig(drive=drive, **SMALL), training)]


@pytest.mark.parametrize("learner", learners(SHORT), ids=lambda learner: learner.name)
def test_a_few_cases_can_be_learned_by_heart(learner, body_sampler, six_cases):
    fitted = learner.fit(body_sampler, six_cases)
    batch = body_sampler.batch(six_cases.test)
    answer, true = fitted.predict(batch.question), batch.truth["position"]
    apart = np.linalg.norm(true - true.mean(axis=0), axis=-1).mean()
    assert distances(answer, batch).mean() < 0.05 * apart
    stress = batch.truth["von_mises"]
    assert np.abs(answer.values["von_mises"] - stress).mean() < 0.2 * np.abs(stress - stress.mean(axis=0)).mean()


def test_a_field_can_be_learned_from_sensors_alone(body_sampler, six_cases):
    sampler = PairSampler(body_sampler.cases, body_sampler.sensors, "material")
    fitted = DeepONet(DeepONetConfig(drive="sensors", **SMALL), SHORT).fit(sampler, six_cases)
    batch = sampler.batch(six_cases.test)
    true = batch.truth["position"]
    assert (
        distances(fitted.predict(batch.question), batch).mean()
        < 0.05 * np.linalg.norm(true - true.mean(axis=0), axis=-1).mean()
    )


@pytest.mark.parametrize("drive", ["activation", "sensors", "both"])
@pytest.mark.parametrize("convention", ["initial", "material"])
def test_what_drives_the_field_and_how_it_is_asked_stand_in_its_signature(drive, convention, body_cases, six_cases):
    sampler = stand_in_sampler(convention, cases=body_cases)
    fitted = DeepONet(DeepONetConfig(drive=drive, **SMALL), FEW).fit(sampler, six_cases)
    driving = {"activation": ("activation",), "sensors": ("sensor_position_target",)}
    driving["both"] = (*driving["activation"], *driving["sensors"])
    asked = "query_places" if convention == "material" else "query_nodes"
    assert fitted.signature.inputs == (*driving[drive], asked)
    assert fitted.signature.sensors == (() if drive == "activation" else tuple(sampler.sensors.tolist()))
    assert fitted.predict(sampler.batch(six_cases.test).question).values["position"].shape == (6, 51, 3)


@pytest.mark.parametrize("learner", learners(FEW, "both"), ids=lambda learner: learner.name)
def test_answers_do_not_depend_on_the_pairs_beside(learner, body_sampler, six_cases):
    fitted = learner.fit(body_sampler, six_cases)
    whole = fitted.predict(body_sampler.batch(six_cases.test).question).values["position"]
    turned = fitted.predict(body_sampler.batch(six_cases.test[::-1]).question).values["position"]
    np.testing.assert_allclose(turned[::-1], whole, rtol=1e-5)


@pytest.mark.parametrize("learner", learners(FEW, "both"), ids=lambda learner: learner.name)
def test_all_scaling_is_inside_so_that_no_training_answers_about_the_mean(learner, body_sampler, six_cases):
    """Weights of zero leave the mean position of each node, or of the body."""
    fitted = learner.fit(body_sampler, six_cases)
    for parameter in fitted.module.parameters():
        parameter.data.zero_()
    batch = body_sampler.batch(six_cases.test)
    cases = body_sampler.cases
    positions = cases.values("position", six_cases.train.target).mean(axis=0)
    if learner.name == "deeponet":
        positions = cases.body.reference + (positions - cases.body.reference).mean(axis=0)
    answered = fitted.predict(batch.question).values["position"]
    np.testing.assert_allclose(answered, np.stack([positions[batch.question.query_nodes]] * 6), atol=1e-3)


@pytest.mark.parametrize(
    ("learner", "rebuild"),
    [(learners(FEW)[0], node_network.rebuild), (learners(FEW, "both")[1], deeponet_module.rebuild)],
    ids=["feed_forward", "deeponet"],
)
def test_method_and_result_keep_the_contracts_and_the_module_is_built_anew(learner, rebuild, body_sampler, six_cases):
    fitted = learner.fit(body_sampler, six_cases)
    assert isinstance(learner, Learner)
    assert isinstance(fitted, Predictor)
    other = rebuild(fitted.config.model_dump(mode="json"), {})
    other.load_state_dict(fitted.module.state_dict())
    question = body_sampler.batch(six_cases.test).question
    first = fitted.predict(question).values["position"]
    fitted.module.load_state_dict(other.state_dict())
    np.testing.assert_array_equal(fitted.predict(question).values["position"], first)


def test_the_same_seed_gives_the_same_network(body_sampler, six_cases):
    question = body_sampler.batch(six_cases.test).question
    for learner in learners(FEW):
        answers = [learner.fit(body_sampler, six_cases).predict(question).values["position"] for _ in range(2)]
        np.testing.assert_array_equal(*answers)


def test_widths_grow_by_the_same_factor_from_activations_to_the_surface_of_the_thesis():
    widths = growing_widths(5, 3 * 2809, 5)
    assert (widths[0], widths[-1], len(widths)) == (5, 8427, 7)
    factors = np.divide(widths[1:], widths[:-1])
    np.testing.assert_allclose(factors, (8427 / 5) ** (1 / 6), rtol=0.03)


def test_on_the_surface_alone_it_answers_there_and_nowhere_else(body_sampler, six_cases):
    fitted = FeedForward(FeedForwardConfig(surface_only=True), FEW).fit(body_sampler, six_cases)
    surface = np.unique(body_sampler.cases.body.skin)
    answer = fitted.predict(body_sampler.batch(six_cases.test, surface).question)
    assert answer.values["position"].shape == (6, len(surface), 3)
    with pytest.raises(InputError, match=r"expected queries on the surface \(8 nodes\), got inner ones"):
        fitted.predict(body_sampler.batch(six_cases.test).question)


def test_held_out_cases_are_judged_in_mm(body_sampler, six_cases):
    from myograph.learning.baselines.by_cases import CaseTraining
    from myograph.learning.baselines.taught import taught

    told = taught(body_sampler, six_cases)
    fitted = learners(FEW)[0].fit(body_sampler, six_cases)
    activation = torch.from_numpy(told.activation.astype(np.float32))
    held, nodes = np.array([1, 4]), np.arange(60)
    trainable = CaseTraining(
        fitted.module, told, lambda cases, queries: (activation[cases], torch.from_numpy(queries)), nodes, FEW,
        np.array([0, 2]), held, {name: spread_of(values) for name, values in told.fields.items()},
    )  # fmt: skip
    answered = fitted.module(activation[held], torch.arange(60))[0].detach().numpy()
    wanted = np.linalg.norm(answered - told.fields["position"][held], axis=-1).mean()
    with torch.no_grad():
        assert trainable.validation_mm() == pytest.approx(wanted, rel=1e-5)
    trainable.validated = np.array([], dtype=np.int64)
    assert trainable.validation_mm() is None


def test_a_field_that_never_varies_has_the_spread_one():
    assert spread_of(np.ones((4, 7, 3))) == 1.0


def test_a_constant_field_can_be_taught(body_cases, six_cases):
    fields = {"position": np.stack([body_cases.body.reference] * len(body_cases))}
    cases = cases_in_memory("biceps", body_cases.body, body_cases.activation, body_cases.design, fields)
    sampler = stand_in_sampler(cases=cases)
    fitted = FeedForward(training=FEW).fit(sampler, six_cases)
    assert distances(fitted.predict((batch := sampler.batch(six_cases.test)).question), batch).max() < 5
