"""Cases, sampler and split of the stand-in body."""

import pytest

from myograph.ensemble.pairs.protocols import split_pairs
from tests.learning.baselines.stand_in import bodies_cases, stand_in_sampler


@pytest.fixture(scope="session")
def body_cases():
    """60 nodes, 88 cases."""
    return bodies_cases()


@pytest.fixture(scope="session")
def body_sampler(body_cases):
    """Nine sensors; positions and von Mises stress are asked, places are material."""
    return stand_in_sampler("material", ("position", "von_mises"), body_cases)


@pytest.fixture(scope="session")
def off_grid(body_cases):
    """Learns from the grid, is tested off it."""
    return split_pairs(body_cases, "off_grid")
