"""A configuration of few steps, and what it trains."""

import pytest

from myograph.learning.training import TrainingConfig
from tests.learning.training.field import Field

FEW = TrainingConfig(steps=6, batch=4, queries=16, device="cpu")


@pytest.fixture
def field(cases, strict):
    """Function: a fresh trainable, and its configuration of six steps with some settings changed."""

    def make(dropout=0.0, **settings):
        config = FEW.model_copy(update=settings)
        return Field(cases, strict, config, dropout), config

    return make
