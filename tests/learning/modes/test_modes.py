"""Neural modes as a whole, on a block whose fields they can represent exactly."""

import copy
from dataclasses import replace

import numpy as np
import pytest
import torch

from myograph.ensemble.pairs.protocols import PairSet
from myograph.errors import InputError
from myograph.learning.modes import locating
from myograph.learning.modes.chebyshev import RANGE
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.field_modes import Shapes
from myograph.learning.modes.fitting import measure_angle
from myograph.learning.modes.learner import ModesLearner, reading
from myograph.learning.modes.locating import Known, _root_of_inverse, _solve, locate
from myograph.learning.modes.rebuild import rebuild
from myograph.learning.torch_predictor import TorchPredictor
from tests.learning.modes.block import OWN, block
from tests.learning.modes.conftest import QUICK


def read(both, sampler, **settings):
    return reading(both, sampler, ModesConfig(**{"sensor_noise": 0.01, **QUICK, **settings}))


def errors(predictor, batch):
    answer = predictor.predict(batch.question)
    return np.linalg.norm(answer.values["position"] - batch.truth["position"], axis=-1)


def with_sensors(question, chosen):
    """The question with some of its sensors, in that order."""
    return replace(
        question,
        sensor_nodes=question.sensor_nodes[chosen],
        sensor_places=question.sensor_places[:, chosen],
        sensor_initial={name: values[:, chosen] for name, values in question.sensor_initial.items()},
        sensor_target={name: values[:, chosen] for name, values in question.sensor_target.items()},
    )


def test_activations_of_new_cases_tell_positions_and_stress(both, sampler, split):
    batch = sampler.batch(split.test[:60])
    answer = read(both, sampler).predict(batch.question)
    assert errors(read(both, sampler), batch).mean() < 0.05
    missed = np.abs(answer.values["von_mises"] - batch.truth["von_mises"])
    assert missed.mean() < 0.02 * batch.truth["von_mises"].mean()
    assert set(answer.deviation) == {"position", "von_mises"}


@pytest.mark.parametrize("sensing", ["surface", "ridge", "surface_and_ridge"])
def test_sensors_of_new_cases_tell_positions_exactly(both, sampler, split, sensing):
    batch = sampler.batch(split.test[:60])
    predictor = read(both, sampler, reads="sensors", sensing=sensing)
    assert errors(predictor, batch).max() < 0.02
    assert predictor.outputs(batch.question)["sensor_residual"].max() < 0.01


def test_any_sensors_in_any_order_tell_the_same(both, sampler, split):
    batch = sampler.batch(split.test[:20])
    predictor = read(both, sampler, reads="sensors")
    for chosen in ([3, 1, 0, 2], [0, 3], [2, 1, 0]):
        subset = replace(batch, question=with_sensors(batch.question, np.array(chosen)))
        assert errors(predictor, subset).max() < 0.02


def test_reading_both_without_sensors_is_reading_activations(both, sampler, split):
    question = sampler.batch(split.test[:5]).question
    blind = with_sensors(question, np.zeros(0, dtype=np.int64))
    from_activation = read(both, sampler).predict(question).values["position"]
    assert np.allclose(both.predict(blind).values["position"], from_activation, atol=1e-4)
    assert (both.outputs(blind)["sensor_residual"] == 0).all()


def test_reading_both_without_activations_is_reading_sensors(both, sampler, split):
    question = sampler.batch(split.test[:5]).question
    unknown = replace(question, activation=np.full_like(question.activation, np.nan))
    from_sensors = read(both, sampler, reads="sensors").predict(question).values["position"]
    assert np.allclose(both.predict(unknown).values["position"], from_sensors, atol=1e-4)


def test_sensors_off_all_known_shapes_leave_a_residual(both, sampler, split):
    question = sampler.batch(split.test[:5]).question
    pushed = question.sensor_target["position"].copy()
    pushed[:, 0] += [0.0, 0.0, 5.0]
    predictor = read(both, sampler, reads="sensors")
    odd = replace(question, sensor_target={**question.sensor_target, "position": pushed})
    assert (predictor.outputs(odd)["sensor_residual"] > 0.1).all()
    assert (predictor.outputs(question)["sensor_residual"] < 0.01).all()


def test_deviations_grow_where_fewer_sensors_tell(both, sampler, split):
    question = sampler.batch(split.test[:20]).question
    predictor = read(both, sampler, reads="sensors", sensor_noise=0.5)
    few = predictor.predict(with_sensors(question, np.array([0]))).deviation["position"]
    assert few.mean() > 1.2 * predictor.predict(question).deviation["position"].mean()


def test_gradients_flow_from_positions_to_sensors_and_activations(both, split, sampler):
    batch = sampler.batch(split.test[:2]).question
    activation = torch.tensor(batch.activation, dtype=torch.float32, requires_grad=True)
    target = torch.tensor(batch.sensor_target["position"], dtype=torch.float32, requires_grad=True)
    nodes = torch.tensor(batch.sensor_nodes), torch.tensor(batch.query_nodes)
    both.module(activation, torch.zeros(2), target, *nodes)[0].sum().backward()
    assert activation.grad.abs().sum() > 0
    assert target.grad.abs().sum() > 0


def test_the_own_activation_alone_moves_the_second_number(both):
    activation = torch.full((1, 5), 0.5)
    changed = activation.clone()
    changed[0, OWN] = 1.0
    (before, _), (after, _) = both.module.place(activation, torch.zeros(1)), both.module.place(changed, torch.zeros(1))
    assert before[0, 1] == 0
    assert after[0, 1].item() == pytest.approx(RANGE)


def test_the_leading_mode_serves_where_the_angle_is_unknown(split, sampler):
    blind = replace(sampler, cases=block(known_angle=False))
    predictor = ModesLearner(ModesConfig(coordinate="mode", **QUICK)).fit(blind, split)
    assert errors(predictor, blind.batch(split.test[:60])).mean() < 0.2


def test_the_root_of_the_covariance_is_that_of_the_inverse():
    slopes = torch.randn(3, 2, 7)
    normal = slopes @ slopes.mT + torch.eye(2)
    root = _root_of_inverse(torch.cat([torch.zeros(3, 2, 1), normal], dim=-1))
    for case in range(3):
        lower = torch.tensor([[root[case, 0], 0], [root[case, 1], root[case, 2]]])
        assert torch.allclose(lower @ lower.T, torch.linalg.inv(normal[case]), atol=1e-5)


def test_a_step_solves_the_symmetric_system():
    slopes, right, pull = torch.randn(3, 2, 7).double(), torch.randn(3, 2, 1).double(), torch.randn(3, 2).double()
    normal = slopes @ slopes.mT
    wanted = torch.linalg.solve(normal, right[..., 0] + pull)
    assert torch.allclose(_solve(torch.cat([right, normal], dim=-1), pull), wanted)


def test_fields_may_have_fewer_modes_and_any_field_is_answered(sampler, split):
    asked = replace(sampler, asked=("position", "von_mises", "fibre_stretch"))
    settings = ModesConfig(stress="von_mises", modes_of={"position": 3}, **QUICK)
    predictor = ModesLearner(settings).fit(asked, split)
    batch = asked.batch(split.test[:20])
    found = predictor.predict(batch.question).values["fibre_stretch"]
    assert np.abs(found - batch.truth["fibre_stretch"]).max() < 0.02
    assert {shape.name: shape.modes for shape in predictor.module.built.fields}["position"] == 3


def test_the_angle_is_off_by_what_it_misses_on_the_cases_that_are_told(both, sampler):
    module, cases = copy.deepcopy(both.module), sampler.cases
    chosen = np.arange(12)
    measure_angle(module, cases, chosen)
    near = float(module.angle_misfit)
    measure_angle(module, replace(cases, elbow_angle=cases.elbow_angle + 0.1), chosen)
    low, high = module.angle_range.tolist()
    assert float(module.angle_misfit) == pytest.approx(2 * RANGE * 0.1 / (high - low), abs=2 * near)


def test_a_model_that_knows_no_angle_cannot_be_off_it(both, sampler):
    module = copy.deepcopy(both.module)
    module.angle_range.fill_(torch.nan)
    with pytest.raises(InputError, match="elbow's angle"):
        measure_angle(module, sampler.cases, np.arange(3))


def test_no_step_is_longer_than_two_cells_of_the_grid(both, monkeypatch):
    monkeypatch.setattr(locating, "STEPS", 1)
    position = both.module.position
    sensors = Shapes(*(part.double() for part in position.at(torch.arange(27))))
    far = torch.tensor([[0.8, 0.8]]).double()
    moved = position.tangent(far)[:, 0] @ sensors.modes.T
    start = torch.zeros(1, 2).double()
    located = locate(moved, start, locating.nothing_known(start), position, sensors, 0.1)
    assert np.allclose(located.place, [locating.LONGEST])


def test_what_is_known_beforehand_wins_over_bad_sensors(both):
    position = both.module.position
    sensors = Shapes(*(part.double() for part in position.at(torch.arange(4))))
    known = Known(torch.tensor([[0.25, -0.5]]).double(), torch.full((1, 2), 1e8).double())
    located = locate(torch.zeros(1, 12).double(), torch.zeros(1, 2).double(), known, position, sensors, 10.0)
    assert torch.allclose(located.place, known.place, atol=1e-3)


def test_numbers_can_be_loaded_into_what_the_configuration_builds(both, split, sampler):
    again = rebuild(both.config.model_dump(mode="json"), {})
    again.load_state_dict(both.module.state_dict())
    question = sampler.batch(split.test[:2]).question
    copy = replace(both, module=again)
    assert np.array_equal(copy.predict(question).values["position"], both.predict(question).values["position"])


def test_progress_is_told_in_steps_of_all_members(sampler, split):
    told = []
    ModesLearner(ModesConfig(**{**QUICK, "steps": 3})).fit(sampler, split, lambda *step: told.append(step))
    assert [step for step, _, _ in told] == [1, 2, 3, 4, 5, 6]
    assert {total for _, total, _ in told} == {6}


def test_too_few_cases_are_refused(sampler, split):
    few = replace(split, train=PairSet(np.arange(3), np.arange(5)))
    with pytest.raises(InputError, match="at least 6 training cases, got 5"):
        ModesLearner().fit(sampler, few)


def test_unknown_angles_are_refused_with_what_to_do(split, sampler):
    with pytest.raises(InputError, match="coordinate = 'mode'"):
        ModesLearner(ModesConfig(**QUICK)).fit(replace(sampler, cases=block(known_angle=False)), split)


def test_one_angle_for_all_is_refused(sampler, split, block_cases):
    rigid = replace(block_cases, elbow_angle=np.ones(len(block_cases)))
    with pytest.raises(InputError, match="different elbow angles"):
        ModesLearner(ModesConfig(**QUICK)).fit(replace(sampler, cases=rigid), split)


def test_only_modes_can_be_read_otherwise(both, sampler):
    other = TorchPredictor("other", "gen", torch.nn.Identity(), both.signature, both.config)
    with pytest.raises(InputError, match="expected neural modes, got the method 'gen'"):
        reading(other, sampler, ModesConfig())


def test_a_model_of_sensors_cannot_read_activations(both, sampler):
    deaf = read(both, sampler, reads="sensors")
    with pytest.raises(InputError, match="learned from sensors only"):
        reading(deaf, sampler, ModesConfig())


def test_a_number_of_modes_for_a_field_that_is_not_answered_is_a_mistake(sampler, split):
    with pytest.raises(InputError, match=r"modes_of: expected some of position, .*got nonsense"):
        ModesLearner(ModesConfig(modes_of={"nonsense": 3}, **QUICK)).fit(sampler, split)


def test_a_ridge_beside_activations_is_a_mistake():
    with pytest.raises(ValueError, match="set reads = 'sensors'"):
        ModesConfig(reads="both", sensing="ridge")
