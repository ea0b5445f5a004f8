import numpy as np
import pytest

from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler
from tests.learning.modes.block import block


@pytest.fixture(scope="session")
def block_cases():
    return block()


@pytest.fixture(scope="session")
def sampler(block_cases):
    return PairSampler(block_cases, np.array([0, 8, 13, 20]), asked=("position", "cauchy_stress", "von_mises"))


@pytest.fixture(scope="session")
def split(block_cases):
    return split_pairs(block_cases, "off_grid")
