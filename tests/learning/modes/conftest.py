import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.learning.modes.config import ModesConfig
from myograph.learning.modes.learner import ModesLearner
from tests.learning.modes.block import block

QUICK = {"modes": 8, "width": 8, "members": 2, "steps": 60}


@pytest.fixture(scope="session")
def block_cases():
    return block()


@pytest.fixture(scope="session")
def sampler(block_cases):
    return PairSampler(block_cases, np.array([0, 8, 13, 20]), asked=("position", "cauchy_stress", "von_mises"))


@pytest.fixture(scope="session")
def split(block_cases):
    return split_pairs(block_cases, "off_grid")


@pytest.fixture(scope="session")
def both(sampler, split):
    """Reads activations and sensors."""
    return ModesLearner(ModesConfig(reads="both", sensor_noise=0.01, **QUICK)).fit(sampler, split)
