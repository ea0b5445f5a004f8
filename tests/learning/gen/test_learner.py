"""The method as a whole: it learns, it repeats itself, it can be exported and saved, it refuses what it cannot do."""

from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
import torch

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.predictor import Learner, Predictor
from myograph.ensemble.pairs.protocols import PairSet, Split
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.errors import InputError
from myograph.learning.gen.config import NetworkConfig, Processor
from myograph.learning.gen.learner import GenLearner, reading
from myograph.learning.gen.rebuild import rebuild
from myograph.learning.onnx_export import export
from myograph.learning.training import TrainingConfig
from myograph.learning.training.drawing import draw_batch
from tests.learning.gen.conftest import FEW, KINDS


def answers(predictor, batch):
    return predictor.predict(batch.question).values


def without_sensors(batch):
    """The same batch with no sensor in it."""
    asked = batch.question
    none = {"sensor_nodes": asked.sensor_nodes[:0], "sensor_places": asked.sensor_places[:, :0]}
    for role in ("sensor_initial", "sensor_target"):
        none[role] = {name: values[:, :0] for name, values in getattr(asked, role).items()}
    return replace(batch, question=replace(asked, **none))


def do_nothing(batch):
    return np.linalg.norm(batch.truth["position"] - batch.question.query_initial["position"], axis=-1).mean()


def test_it_is_a_learner_and_what_it_gives_a_predictor(gen_8):
    assert isinstance(GenLearner(), Learner)
    assert isinstance(gen_8.predictor, Predictor)
    assert (gen_8.predictor.name, GenLearner(NetworkConfig(nodes_per_axis=7)).name) == ("gen_8", "gen_343")
    assert GenLearner(called="faithful").name == "faithful"


def test_it_beats_doing_nothing_threefold_on_activations_that_training_never_saw(gen_8, sampler, strict, mean_error):
    batch = sampler.batch(strict.test)
    assert 3 * mean_error(gen_8.predictor, batch) < do_nothing(batch)


def test_one_pair_is_learned_by_heart_by_the_thesis_network(sampler, mean_error):
    one = PairSet(np.array([0]), np.array([31]))
    config = TrainingConfig(steps=300, batch=1, learning_rate=1e-2, device="cpu")
    learned = GenLearner(NetworkConfig.thesis(), config).fit(sampler, Split("strict", one, one.all()))
    batch = sampler.batch(one.all())
    assert 10 * mean_error(learned, batch) < do_nothing(batch)


def test_every_kind_answers_the_fields_of_its_outputs_with_numbers(kind, briefly_trained, stressed, strict):
    answered = answers(briefly_trained.predictor, stressed.batch(strict.test[:3]))
    shapes = {"position": (3, 144, 3), "cauchy_stress": (3, 144, 6), "von_mises": (3, 144)}
    assert set(answered) == (set(shapes) if kind == "many" else {"position"})
    for name, values in answered.items():
        assert values.shape == shapes[name]
        assert np.isfinite(values).all()


def test_every_kind_is_the_same_in_onnx(kind, briefly_trained, stressed, strict):
    """`export` itself compares the answers of onnxruntime with those of torch."""
    pytest.importorskip("onnxscript")
    assert export(briefly_trained.predictor, stressed.cases, strict).parity < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("processor", sorted(set(get_args(Processor)) - {kind.processor for kind in KINDS.values()}))
def test_every_processor_is_the_same_in_onnx(processor, sampler, strict):
    pytest.importorskip("onnxscript")
    if processor.endswith("Conv"):
        pytest.importorskip("torch_geometric")
    trained = GenLearner(NetworkConfig(processor=processor), FEW).fit(sampler, strict)
    assert export(trained, sampler.cases, strict).parity < 1e-5


def test_every_kind_is_rebuilt_from_its_configuration_and_weights(kind, briefly_trained, stressed, strict):
    module, config = briefly_trained.predictor.module, briefly_trained.predictor.config
    weights = module.state_dict()
    again = rebuild(config.model_dump(mode="json"), {name: tuple(w.shape) for name, w in weights.items()})
    again.load_state_dict(weights)
    predictor = briefly_trained.predictor
    batch = stressed.batch(strict.test[:3])
    rebuilt = answers(type(predictor)("again", "gen", again, predictor.signature, config), batch)
    for name, values in answers(predictor, batch).items():
        np.testing.assert_array_equal(rebuilt[name], values)


@pytest.mark.parametrize(("sensors", "least"), [(3, 3), (9, 4)])
def test_an_affine_skip_needs_the_points_that_decide_it_or_all_of_fewer(sampler, strict, sensors, least):
    own = PairSampler(sampler.cases, random_sensors(sampler.cases.nodes, sensors))
    trained = GenLearner(NetworkConfig(skip="affine"), FEW).fit(own, strict)
    assert trained.signature.least_sensors == least
    assert trained.predict(own.batch(strict.test[:2]).question).values["position"].shape[0] == 2


def test_the_same_seed_gives_the_same_weights_and_another_seed_others(sampler, strict):
    first, again, other = (
        GenLearner(NetworkConfig(nodes_per_axis=3), FEW.model_copy(update={"seed": seed})).train(sampler, strict)
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first.history.rmse, again.history.rmse)
    np.testing.assert_array_equal(first.module.nodes_mm, again.module.nodes_mm)
    assert not np.array_equal(first.history.rmse, other.history.rmse)


def test_held_out_cases_leave_no_trace_in_what_is_learned(sampler, strict):
    cases = sampler.cases
    altered = cases.values("position", np.arange(len(cases))).copy()
    altered[np.unique(strict.test)] += 1000.0
    other = cases_in_memory("biceps", cases.body, cases.activation, cases.design, {"position": altered})
    one, two = (GenLearner(training=FEW).train(s, strict) for s in (sampler, PairSampler(other, sampler.sensors)))
    np.testing.assert_array_equal(one.history.rmse, two.history.rmse)


def test_graph_nodes_move_and_end_near_the_muscle(sampler, strict):
    config = FEW.model_copy(update={"node_learning_rate": 0.01})
    trained = GenLearner(NetworkConfig(nodes_per_axis=3), config).train(sampler, strict)
    moved = np.abs(trained.module.nodes_mm - trained.nodes_before).max(axis=1)
    assert (moved > 0).all()
    positions = sampler.cases.values("position", strict.train.cases).reshape(-1, 3)
    assert (trained.nodes_before >= positions.min(axis=0) - 1e-3).all()
    assert (trained.nodes_before <= positions.max(axis=0) + 1e-3).all()


def test_in_the_material_convention_points_are_named_by_where_they_rest(sampler, strict, mean_error):
    material = PairSampler(sampler.cases, sampler.sensors, "material")
    learned = GenLearner(training=TrainingConfig(steps=80, device="cpu")).fit(material, strict)
    batch = material.batch(strict.test)
    assert 2 * mean_error(learned, batch) < do_nothing(batch)
    with pytest.raises(InputError, match="convention 'material', got 'initial'"):
        learned.predict(sampler.batch(strict.test[:1]).question)


def test_one_network_answers_from_sensors_from_activations_or_from_both(sampler, mean_error):
    """Four pairs, all from one case: what tells them apart is the activation of the target."""
    four = PairSet(np.array([0]), np.array([1, 4, 16, 31]))
    config = NetworkConfig(activation_input=True, reads="sensors_and_activation", dropout=0.4)
    both = GenLearner(config, TrainingConfig(steps=200, device="cpu")).fit(sampler, Split("strict", four, four.all()))
    batch = sampler.batch(four.all())
    for reads in ("sensors", "activation", "sensors_and_activation"):
        assert 2 * mean_error(reading(both, reads), batch) < do_nothing(batch)


def test_without_dropout_neither_sensors_nor_activations_may_lack(sampler, strict):
    config = NetworkConfig(activation_input=True, reads="sensors_and_activation", dropout=0.0)
    never = GenLearner(config, FEW).fit(sampler, strict)
    assert (never.signature.unknown_activation, never.signature.least_sensors) == (False, 1)
    either = GenLearner(KINDS["both"], FEW).fit(sampler, strict)
    assert (either.signature.unknown_activation, either.signature.least_sensors) == (True, 0)
    with pytest.raises(InputError, match="train it with dropout"):
        reading(never, "activation")


def test_sensors_or_activations_that_are_not_told_are_those_that_are_not_read(sampler, strict):
    both = GenLearner(KINDS["both"], FEW).fit(sampler, strict)
    batch = sampler.batch(strict.test[:2])
    unknown = replace(batch, question=replace(batch.question, activation=np.full((2, 5), np.nan)))
    for told, reads in ((unknown, "sensors"), (without_sensors(batch), "activation")):
        np.testing.assert_allclose(
            answers(both, told)["position"], answers(reading(both, reads), batch)["position"], atol=1e-4
        )


def test_validation_is_the_mean_distance_on_held_out_pairs(sampler, strict):
    config = FEW.model_copy(update={"validation": 0.2, "validate_every": 2})
    history = GenLearner(training=config).train(sampler, strict).history
    assert np.isfinite(history.validation[[1, 3]]).all()
    assert 1 < history.validation[3] < 100


def test_the_recorded_error_is_that_of_the_answers_in_millimetres(sampler, strict):
    """One step, all queries of the only pair, at no rate: what was recorded can be computed from outside."""
    one = PairSet(np.array([0]), np.array([31]))
    for network in (NetworkConfig(), NetworkConfig.thesis(), NetworkConfig(skip="affine")):
        still = TrainingConfig(steps=1, batch=1, queries=1000, learning_rate=1e-12, node_learning_rate=0, device="cpu")
        trained = GenLearner(network, still).train(sampler, Split("strict", one, one.all()))
        batch = sampler.batch(one.all())
        squares = np.square(answers(trained.predictor, batch)["position"] - batch.truth["position"]).sum(axis=-1)
        assert trained.history.rmse[0] == pytest.approx(np.sqrt(squares.mean()), rel=1e-4)


def test_fewer_sensors_are_taken_by_the_mean_and_not_by_the_sum(gen_8, sampler, strict):
    fewer = PairSampler(sampler.cases, sampler.sensors[:7])
    batch = fewer.batch(strict.test[:2])
    assert answers(gen_8.predictor, batch)["position"].shape == (2, 146, 3)
    total = GenLearner(NetworkConfig.thesis(), FEW).fit(sampler, strict)
    with pytest.raises(InputError, match="expected the 9 sensors of the training"):
        total.predict(batch.question)


def test_a_sampler_that_does_not_ask_for_what_is_answered_is_an_input_error(sampler, strict):
    with pytest.raises(InputError, match="sampler: expected one that asks for cauchy_stress, got position"):
        GenLearner(NetworkConfig(outputs=(("cauchy_stress",),)), FEW).fit(sampler, strict)


def test_another_reading_of_a_network_without_activation_input_is_an_input_error(gen_8):
    with pytest.raises(InputError, match="gen_8: expected a graph element network with an activation input"):
        reading(gen_8.predictor, "activation")


def test_processes_forget_the_activations_that_one_alone_would_forget(sampler, strict, monkeypatch):
    training = FEW.model_copy(update={"batch": 8})
    learner, config = GenLearner(KINDS["both"], training), KINDS["both"]
    trainable = learner._trainable(
        config, sampler, strict.train, PairSet(strict.train.initial[:0], strict.train.target)
    )

    def activations(seed):
        generator = np.random.default_rng(seed)
        batch = draw_batch(sampler, strict.train, training, generator)
        parts = trainable._forget(trainable.parts(batch.question), generator)
        return parts["activation"].numpy(), parts["sensor_places"].shape[1], generator.random()

    (alone, sensors, chance) = activations(2)
    assert 0 < np.isnan(alone).any(axis=1).sum() < 8
    monkeypatch.setattr(torch.distributed, "is_initialized", lambda: True)
    monkeypatch.setattr(torch.distributed, "get_world_size", lambda: 2)
    for rank in (0, 1):
        monkeypatch.setattr(torch.distributed, "get_rank", lambda rank=rank: rank)
        share, kept, after = activations(2)
        np.testing.assert_array_equal(share, alone[rank::2])
        assert (kept, after) == (sensors, chance)
