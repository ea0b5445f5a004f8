"""A stand-in for simulated data: a muscle that bends, shortens and bulges by formulas."""

import itertools

import numpy as np
import pytest
import torch
import xarray as xr

from myograph.case import MUSCLES
from myograph.ensemble.pairs import sample_pairs
from myograph.ensemble.protocols import split_pairs
from myograph.learning.config import NetworkConfig, TrainingConfig
from myograph.learning.training import train_gen

UPPER_ARM, LEVER, RADIUS = 300.0, 45.0, 25.0  # mm
FLEXORS = np.array([0.5, 0.8, 1.0, -0.15, -1.0])


def spindle_nodes(sections, rings, spokes):
    """Material coordinates (nodes, 3): share of the length in [0, 1], offsets across over the local radius."""
    across = [(0.0, 0.0)] + [
        (r * np.cos(w), r * np.sin(w))
        for r in np.linspace(0, 1, rings + 1)[1:]
        for w in np.arange(spokes) * 2 * np.pi / spokes
    ]
    return np.array([(s, y, z) for s in np.linspace(0, 1, sections) for y, z in across])


def elbow_angles(activation):
    """Elbow angle [rad], 20 to 120 degrees, of activations (cases, 5)."""
    return np.radians(70 + 50 * np.tanh(1.3 * activation @ FLEXORS - 0.4))


def place(material, activation):
    """Positions [mm] (cases, nodes, 3): a spindle along a bow from the shoulder to the forearm."""
    angle, own = elbow_angles(activation)[:, None], activation[:, 2:3]
    s, y, z = material.T
    insertion = np.stack([LEVER * np.sin(angle), 0 * angle, -UPPER_ARM - LEVER * np.cos(angle)], axis=-1)
    bow = np.stack([30 + 25 * np.sin(angle) + 8 * own, 0 * angle, 0.55 * insertion[..., 2]], axis=-1)
    t = s[None, :, None]
    centre = 2 * t * (1 - t) * bow + t**2 * insertion
    tangent = 2 * (1 - 2 * t) * bow + 2 * t * insertion
    tangent = tangent / np.linalg.norm(tangent, axis=-1, keepdims=True)
    normal = np.stack([tangent[..., 2], 0 * tangent[..., 0], -tangent[..., 0]], axis=-1)
    length = np.linalg.norm(insertion, axis=-1)
    belly = 0.5 - 0.1 * own
    radius = RADIUS * np.sqrt(330 / length) * (0.25 + (1 + 0.15 * own) * np.exp(-(((s - belly) / 0.25) ** 2)))
    return centre + (radius * y)[..., None] * normal + (radius * z)[..., None] * np.array([0.0, 1.0, 0.0])


def stand_in(sections=17, rings=1, spokes=8, off_grid=16):
    """Dataset of 32 factorial and some off-grid cases under the contract of `myograph.ensemble.dataset`."""
    factorial = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    activation = np.concatenate([factorial, np.random.default_rng(7).uniform(size=(off_grid, 5))])
    material = spindle_nodes(sections, rings, spokes)
    return xr.Dataset(
        {
            "activation": (("cases", "muscles"), activation),
            "elbow_angle": ("cases", elbow_angles(activation)),
            "design": ("cases", np.array(["factorial"] * 32 + ["off_grid"] * off_grid, dtype="<U16")),
            "reference_position": (("nodes", "axes"), place(material, np.zeros((1, 5)))[0]),
            "position": (("cases", "nodes", "axes"), place(material, activation)),
        },
        coords={"muscles": list(MUSCLES), "axes": list("xyz")},
        attrs={"muscle": "biceps", "schema": 1, "simulator": "formulas", "preset": "tiny"},
    )


@pytest.fixture(scope="session", autouse=True)
def _one_thread():
    torch.set_num_threads(1)


@pytest.fixture(scope="session")
def dataset():
    """153 nodes, 48 cases."""
    return stand_in()


@pytest.fixture(scope="session")
def sampler(dataset):
    """Nine sensors, 144 queries."""
    return sample_pairs(dataset)


@pytest.fixture(scope="session")
def strict(dataset):
    """Pairs of the strict protocol."""
    return split_pairs(dataset, "strict")


@pytest.fixture(scope="session")
def gen_8(sampler, strict):
    """The thesis's small graph, trained for some seconds."""
    return train_gen(sampler, strict, NetworkConfig(), TrainingConfig(steps=300))


@pytest.fixture(scope="session")
def mean_error():
    """Function: mean distance [mm] of a predictor's answers from the truth."""

    def measure(predictor, batch):
        answers = predictor.predict(batch.sensors, batch.queries)
        return np.linalg.norm(answers - batch.targets, axis=-1).mean()

    return measure
