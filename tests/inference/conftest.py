"""Two saved models for all tests of this folder; no torch."""

import pytest

from myograph.inference.loaded import load
from tests.inference.stand_in import save_linear, save_mean


@pytest.fixture(scope="session")
def saved(tmp_path_factory):
    """Folder with the folders `linear` and `mean`."""
    folder = tmp_path_factory.mktemp("saved")
    save_linear(folder / "linear")
    save_mean(folder / "mean")
    return folder


@pytest.fixture(scope="session")
def linear(saved):
    return load(saved / "linear")


@pytest.fixture(scope="session")
def mean(saved):
    return load(saved / "mean")
