"""Features in torch are those of `myograph.ensemble.pairs.features`."""

import numpy as np
import pytest
import torch

from myograph.ensemble.pairs.features import FEATURES, WIDTH, feature, field_values
from myograph.learning.gen.features import feature_of, field_of, width_of


@pytest.fixture
def state():
    draw = np.random.default_rng(0)
    initial = {"position": draw.normal(size=(2, 7, 3)) * 50}
    target = {
        "position": initial["position"] + draw.normal(size=(2, 7, 3)),
        "von_mises": draw.uniform(size=(2, 7)),
        "cauchy_stress": draw.normal(size=(2, 7, 6)),
    }
    return initial, target


@pytest.mark.parametrize("kind", FEATURES)
def test_a_feature_is_that_of_the_pairs_and_its_field_too(state, kind):
    initial, target = state
    before, after = torch.tensor(initial["position"]), {name: torch.tensor(field) for name, field in target.items()}
    values = feature_of(kind, before, after)
    assert values.shape == (2, 7, WIDTH[kind])
    np.testing.assert_allclose(values, feature(kind, initial, target), atol=1e-12)
    other = 0.7 * values
    np.testing.assert_allclose(field_of(kind, other, before), field_values(kind, other.numpy(), initial), atol=1e-9)


def test_a_point_that_does_not_move_has_a_derivative_that_is_a_number():
    still = torch.zeros(1, 1, 3, requires_grad=True)
    feature_of("direction_and_scale", torch.zeros(1, 1, 3), {"position": still}).sum().backward()
    assert still.grad.isfinite().all()


def test_widths_add_up():
    assert width_of(("direction_and_scale", "von_mises", "cauchy_stress")) == 11
