"""Terms of physics: right derivatives, volumes that stay when they are minded, a clamped end, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
import torch
from pydantic import ValidationError

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError
from myograph.inference.feeds import feeds
from myograph.learning.gen.config import NetworkConfig, Traps
from myograph.learning.gen.learner import GenLearner
from myograph.learning.gen.muscle import MuscleGen
from myograph.learning.gen.scaling import blank_scaling
from myograph.learning.modes.volume import fixed_nodes, volume_ratios
from myograph.learning.physics.config import Physics
from myograph.learning.physics.points import random_points
from myograph.learning.physics.terms import Asking, physics_terms
from myograph.learning.training import TrainingConfig
from tests.learning.physics.body import bar_cases

FEW = TrainingConfig(steps=3, batch=4, queries=16, device="cpu")
BOTH = Physics(volume=0.1, clamped=0.01, points=8)
STEP_MM = 0.05
NETWORKS = {
    "coordinates": NetworkConfig.thesis(),
    "displacement": NetworkConfig(nonlinearity="silu"),
    "direction and scale": NetworkConfig(outputs=(("direction_and_scale",),), nonlinearity="silu"),
    "improved": NetworkConfig.improved(),
    "barycentric": NetworkConfig(representer="barycentric", nodes_per_axis=3, nonlinearity="silu"),
    "activations": NetworkConfig(activation_input=True, reads="sensors_and_activation", nonlinearity="silu"),
}


@pytest.fixture(scope="module")
def cases():
    return bar_cases()


@pytest.fixture(scope="module", params=["material", "initial"])
def sampler(request, cases):
    return PairSampler(cases, random_sensors(cases.nodes), request.param)


@pytest.fixture(scope="module")
def strict(cases):
    return split_pairs(cases, "strict")


def asking_of(predictor):
    """How the training asks."""
    module = predictor.module

    def parts(question):
        return {name: torch.from_numpy(array) for name, array in feeds(question, module.inputs).items()}

    return Asking(parts, lambda given: module(*given.values())[0])


def differences(asking, sampler, pairs, seed):
    """F by central differences: the points move by X, and S with them as the element says."""
    cases, points = sampler.cases, random_points(sampler.cases.body, np.random.default_rng(seed), BOTH.points)
    question = sampler.batch(pairs, np.arange(cases.nodes)).question
    at_nodes = question.query_initial["position"].astype(np.float64)
    slope = points.gradient(at_nodes)
    columns = []
    for axis in range(3):
        answers = []
        for step in (STEP_MM, -STEP_MM):
            rest = points.carry(cases.body.reference[None]) + step * np.eye(3)[axis]
            before = points.carry(at_nodes) + step * slope[..., axis]
            places = before if sampler.convention == "initial" else np.broadcast_to(rest, before.shape)
            asked = replace(
                question, query_nodes=points.nodes[:, 0], query_places=places, query_initial={"position": before}
            )
            answers.append(asking.positions(asking.parts(asked)).detach().numpy())
        columns.append((answers[0] - answers[1]) / (2 * STEP_MM))
    return np.stack(columns, axis=-1)


@pytest.mark.parametrize("network", NETWORKS.values(), ids=NETWORKS)
def test_the_deformation_gradient_is_that_of_differences(network, sampler, strict):
    asking = asking_of(GenLearner(network, FEW).fit(sampler, strict))
    terms = physics_terms(BOTH, sampler, strict.train)
    pairs = strict.test[:2]
    found = terms.gradients(asking, pairs, np.random.default_rng(3)).detach().numpy()
    wanted = differences(asking, sampler, pairs, 3)
    close = np.abs(found - wanted).max(axis=(2, 3)) < 2e-3 * np.abs(wanted).max()
    kinked = network.nonlinearity == "relu" or network.representer == "barycentric"
    assert close.mean() >= 0.75 if kinked else close.all()


def test_volumes_stay_and_the_clamped_end_moves_less_when_they_are_minded(cases, strict):
    sampler = PairSampler(cases, random_sensors(cases.nodes), "material")
    end = fixed_nodes(cases.values("position", strict.train.cases))
    assert end.tolist() == list(range(9))
    asked = sampler.batch(strict.test[:8], np.arange(cases.nodes)).question
    training = TrainingConfig(steps=40, batch=2, queries=16, device="cpu")
    changes, moved = {}, {}
    for physics in (Physics(), Physics(volume=1.0), Physics(clamped=1.0)):
        network = NetworkConfig(nonlinearity="silu", physics=physics)
        answered = GenLearner(network, training).fit(sampler, strict).predict(asked).values["position"]
        changes[physics] = volume_ratios(cases.body, answered).change
        moved[physics] = np.linalg.norm(answered[:, end] - cases.body.reference[end], axis=-1).mean()
    assert changes[Physics(volume=1.0)] < 0.5 * changes[Physics()]
    assert moved[Physics(clamped=1.0)] < 0.5 * moved[Physics()]


def test_weights_of_zero_change_nothing(sampler, strict):
    plain, off = (
        GenLearner(NetworkConfig(physics=p), FEW).train(sampler, strict) for p in (Physics(), Physics(points=3))
    )
    np.testing.assert_array_equal(plain.history.loss, off.history.loss)
    assert physics_terms(Physics(), sampler, strict.train) is None


def test_the_loss_is_that_of_the_cases_and_of_the_terms(sampler, strict):
    """At the first step, before any weight moved."""
    losses = {
        weight: GenLearner(NetworkConfig(physics=Physics(volume=weight)), FEW).train(sampler, strict).history.loss[0]
        for weight in (0.0, 100.0, 300.0)
    }
    assert losses[300.0] - losses[0.0] == pytest.approx(3 * (losses[100.0] - losses[0.0]), rel=1e-3)
    assert losses[100.0] > losses[0.0]


def test_where_it_means_nothing_it_is_an_input_error(cases, strict):
    sampler = PairSampler(cases, random_sensors(cases.nodes), "material")
    unknown = replace(cases.body, cells=np.zeros((0, 27), dtype=np.int64))
    without = PairSampler(replace(cases, body=unknown), sampler.sensors, "material")
    moving = PairSampler(bar_cases(clamped=False), sampler.sensors, "material")
    for physics, traps, asked, message in (
        (Physics(volume=1.0), Traps(), without, "volumes are those of elements.*set volume to 0"),
        (Physics(clamped=1.0), Traps(), moving, "nodes that stay where they are.*set clamped to 0"),
        (Physics(volume=1.0), Traps(legacy_axis=True), sampler, "'legacy_axis'"),
    ):
        with pytest.raises(InputError, match=message):
            GenLearner(NetworkConfig(physics=physics, traps=traps), FEW).fit(asked, strict)


def test_a_network_that_answers_no_positions_is_an_input_error():
    config = NetworkConfig(outputs=(("von_mises",),), physics=BOTH)
    with pytest.raises(InputError, match="answers positions, got von_mises"):
        MuscleGen(config, blank_scaling(("displacement", "von_mises")), seed=0)


def test_a_weight_below_zero_is_refused():
    with pytest.raises(ValidationError):
        Physics(volume=-1.0)
