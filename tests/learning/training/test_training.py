"""Training: it learns, it repeats itself, it stops when told, it says what it does."""

import numpy as np
import pytest
import torch

from myograph.errors import InputError, NotConvergedError
from myograph.learning.training import TrainingConfig, train
from myograph.learning.training.trainable import Trainable


def weights(trainable):
    return torch.cat([value.flatten() for value in trainable.module.state_dict().values()])


def test_the_smallest_thing_to_train_is_a_trainable(field):
    assert isinstance(field()[0], Trainable)


def test_training_makes_the_error_many_times_smaller(field):
    trainable, config = field(steps=150, batch=8, queries=32, learning_rate=1e-2)
    history = train(trainable, config)
    assert history.rmse[-10:].mean() < history.rmse[:10].mean() / 3


def test_the_same_seed_gives_the_same_losses_and_another_seed_others(field):
    first, again, other = (train(*field(dropout=0.2, seed=seed)) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.loss, again.loss)
    assert not np.array_equal(first.loss, other.loss)


def test_training_leaves_the_chance_of_others_alone(field):
    torch.manual_seed(5)
    untouched = torch.rand(3)
    torch.manual_seed(5)
    train(*field(dropout=0.2))
    assert torch.equal(torch.rand(3), untouched)


def test_a_constant_rate_makes_the_steps_of_adam(field):
    """With gradients that stay the same, each step of Adam has the length of the rate."""
    trainable, config = field(schedule="constant", steps=2, learning_rate=1e-3)
    trainable.loss = lambda generator: (trainable.module.layers[0].bias.sum(), 0.0)
    before = trainable.module.layers[0].bias.detach().clone()
    history = train(trainable, config)
    np.testing.assert_allclose(before - trainable.module.layers[0].bias.detach(), 2e-3, rtol=1e-4)
    np.testing.assert_array_equal(history.rate, 1.0)


def test_weight_decay_shrinks_weights_that_the_loss_does_not_move(field):
    trainable, config = field(schedule="constant", steps=2, learning_rate=1e-2, weight_decay=0.5)
    trainable.loss = lambda generator: (0 * trainable.module.layers[0].bias.sum(), 0.0)
    before = trainable.module.layers[0].bias.detach().clone()
    train(trainable, config)
    np.testing.assert_allclose(trainable.module.layers[0].bias.detach(), before * (1 - 0.005) ** 2, rtol=1e-5)


def test_clipping_bounds_the_norm_of_the_gradients(field):
    norms = []
    for clip in (None, 1e-3):
        trainable, config = field(steps=1, clip=clip)
        train(trainable, config)
        gradients = [value.grad for value in trainable.module.parameters()]
        norms.append(float(torch.cat([gradient.flatten() for gradient in gradients]).norm()))
    assert norms[0] > 1e-2
    assert norms[1] == pytest.approx(1e-3, rel=1e-3)


def test_each_group_has_its_own_largest_rate(field):
    trainable, config = field(schedule="constant", steps=1, learning_rate=1e-2)
    first, last = trainable.module.layers[0], trainable.module.layers[3]
    trainable.parameter_groups = lambda rate: [
        {"params": [first.bias], "lr": rate},
        {"params": [last.bias], "lr": rate / 10},
    ]
    trainable.loss = lambda generator: (first.bias.sum() + last.bias.sum(), 0.0)
    before = [layer.bias.detach().clone() for layer in (first, last)]
    train(trainable, config)
    moved = [float((old - layer.bias.detach()).mean()) for old, layer in zip(before, (first, last), strict=True)]
    assert moved == pytest.approx([1e-2, 1e-3], rel=1e-3)


def test_averaged_weights_are_kept_instead_of_the_last(field):
    """One step with decay d: the average is d before + (1 - d) after, with d = 2/11 at the first step."""
    settings = {"steps": 1, "schedule": "constant"}
    (last, config), (averaged, averaging) = field(**settings), field(**settings, averaging=0.999)
    before = weights(last)
    train(last, config)
    train(averaged, averaging)
    torch.testing.assert_close(weights(averaged), 2 / 11 * before + 9 / 11 * weights(last))


def test_training_stops_after_validations_without_gain_and_keeps_the_best_weights(field):
    trainable, config = field(steps=50, validation=0.2, validate_every=2, patience=3)
    told = iter([3.0, 2.0, 2.0, 2.5, 2.0, 1.0])
    seen = []

    def validation_mm():
        seen.append(weights(trainable))
        return next(told)

    trainable.validation_mm = validation_mm
    history = train(trainable, config)
    assert history.stopped == "patience"
    assert len(history.loss) == 10
    np.testing.assert_array_equal(history.validation[1::2], [3.0, 2.0, 2.0, 2.5, 2.0])
    assert np.isnan(history.validation[::2]).all()
    assert torch.equal(weights(trainable), seen[1])


def test_a_gain_below_the_smallest_is_none(field):
    trainable, config = field(steps=50, validate_every=1, patience=2, smallest_gain=0.1)
    errors = iter([1.0, 0.95, 0.92, 0.5])
    trainable.validation_mm = lambda: next(errors)
    assert len(train(trainable, config).loss) == 3


def test_the_last_step_is_validated_whatever_its_number(field):
    history = train(*field(steps=5, validation=0.2, validate_every=3))
    assert np.isnan(history.validation).tolist() == [True, True, False, True, False]


def test_patience_without_cases_to_validate_on_is_a_mistake(field):
    with pytest.raises(InputError, match="set 'validation'"):
        train(*field(patience=2))


def test_dropout_rests_while_validating(field):
    trainable, config = field(dropout=0.5, validation=0.2, validate_every=1)
    modes = []
    trainable.validation_mm = lambda: modes.append(trainable.module.training) or 1.0
    train(trainable, config)
    assert modes == [False] * 6


def test_time_may_end_the_training_before_the_steps_do(field):
    history = train(*field(steps=10**6, seconds=0.2))
    assert history.stopped == "seconds"
    assert 1 <= len(history.loss) < 10**4
    assert history.rate[-1] < history.rate.max()
    assert 0.2 <= history.seconds < 10


def test_the_last_step_is_validated_also_where_time_ends_it(field):
    history = train(*field(0.2, steps=10**6, seconds=0.2, validation=0.2, validate_every=10**6))
    assert history.stopped == "seconds"
    assert np.isfinite(history.validation[-1])
    assert np.isnan(history.validation[:-1]).all()


def test_progress_is_told_after_every_step(field):
    told = []
    history = train(*field(), progress=lambda *news: told.append(news))
    assert [news[:2] for news in told] == [(step, 6) for step in range(1, 7)]
    np.testing.assert_array_equal([news[2] for news in told], history.rmse)


def test_what_is_due_after_a_step_is_done_after_every_step(field):
    trainable, config = field()
    train(trainable, config)
    assert trainable.steps_seen == [1, 2, 3, 4, 5, 6]


def test_a_loss_that_is_no_number_is_a_failure_with_its_step(field):
    trainable, config = field()
    losses = iter([1.0, float("nan")])
    trainable.loss = lambda generator: (trainable.module.layers[0].bias.sum() * next(losses), 1.0)
    with pytest.raises(NotConvergedError, match="loss is nan at step 2; try a smaller learning_rate"):
        train(trainable, config)


def test_a_trained_module_is_on_the_cpu_and_no_longer_in_training(field):
    trainable, config = field()
    train(trainable, config)
    assert not trainable.module.training
    assert {value.device.type for value in trainable.module.parameters()} == {"cpu"}


def test_bfloat16_learns_too_but_not_the_same_digits(field):
    exact, mixed = (train(*field(precision=precision)) for precision in ("32-true", "bf16-mixed"))
    np.testing.assert_allclose(mixed.rmse, exact.rmse, rtol=0.05)
    assert not np.array_equal(mixed.loss, exact.loss)


@pytest.mark.skipif(torch.cuda.is_available(), reason="there is a GPU")
def test_a_gpu_where_there_is_none_is_a_mistake(field):
    with pytest.raises(InputError, match="expected a CUDA GPU, found none"):
        train(*field(device="cuda"))


def test_half_precision_needs_a_gpu(field):
    with pytest.raises(InputError, match="'16-mixed'"):
        train(*field(precision="16-mixed"))


@pytest.mark.skipif(not torch.cuda.is_available(), reason="there is no GPU")
@pytest.mark.parametrize("precision", ["32-true", "bf16-mixed", "16-mixed"])
def test_a_gpu_learns_what_the_cpu_learns(field, precision):
    slow, fast = (train(*field(device=device, precision=p)) for device, p in (("cpu", "32-true"), ("cuda", precision)))
    np.testing.assert_allclose(fast.rmse, slow.rmse, rtol=1e-3 if precision == "32-true" else 0.05)


def test_the_default_takes_a_gpu_where_there_is_one():
    assert TrainingConfig().device == "auto"
