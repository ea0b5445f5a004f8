"""A stand-in for simulated data: a muscle that bends, shortens, bulges and pulls by formulas."""

import itertools

import numpy as np
import pytest
import torch

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.protocols import split_pairs
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.spec import Body

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


def frames(material, activation):
    """Of the bow from the shoulder to the forearm: places [mm], unit tangents and normals (cases, nodes, 3)."""
    angle, own = elbow_angles(activation)[:, None], activation[:, 2:3]
    insertion = np.stack([LEVER * np.sin(angle), 0 * angle, -UPPER_ARM - LEVER * np.cos(angle)], axis=-1)
    bow = np.stack([30 + 25 * np.sin(angle) + 8 * own, 0 * angle, 0.55 * insertion[..., 2]], axis=-1)
    t = material[None, :, :1]
    centre = 2 * t * (1 - t) * bow + t**2 * insertion
    tangent = 2 * (1 - 2 * t) * bow + 2 * t * insertion
    tangent = tangent / np.linalg.norm(tangent, axis=-1, keepdims=True)
    normal = np.stack([tangent[..., 2], 0 * tangent[..., 0], -tangent[..., 0]], axis=-1)
    return centre, tangent, normal, np.linalg.norm(insertion, axis=-1)


def place(material, activation):
    """Positions [mm] (cases, nodes, 3): a spindle along the bow."""
    centre, _, normal, length = frames(material, activation)
    s, y, z = material.T
    own = activation[:, 2:3]
    belly = 0.5 - 0.1 * own
    radius = RADIUS * np.sqrt(330 / length) * (0.25 + (1 + 0.15 * own) * np.exp(-(((s - belly) / 0.25) ** 2)))
    return centre + (radius * y)[..., None] * normal + (radius * z)[..., None] * np.array([0.0, 1.0, 0.0])


def stress(material, activation):
    """Cauchy stress [MPa] (cases, nodes, 6) in the order xx yy zz yz xz xy: tension along the bow, some across it."""
    _, tangent, normal, _ = frames(material, activation)
    s, y, z = material.T
    pull = (0.02 + 0.2 * activation[:, 2:3]) * (1 + 0.3 * np.cos(2 * np.pi * s) + 0.1 * y)
    across = 0.2 * pull * (1 + 0.3 * z)
    tensor = pull[..., None, None] * tangent[..., :, None] * tangent[..., None, :]
    tensor = tensor - across[..., None, None] * normal[..., :, None] * normal[..., None, :]
    return tensor[..., [0, 1, 2, 1, 0, 0], [0, 1, 2, 2, 2, 1]]


def von_mises(stress):
    """Von Mises stress [MPa] of Cauchy stress (..., 6)."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    normal = ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2
    return np.sqrt(normal + 3 * (yz**2 + xz**2 + xy**2))


def spindle_skin(sections, rings, spokes):
    """Quadrilaterals (facets, 4) of the outermost ring."""
    ring = 1 + (rings - 1) * spokes + np.arange(spokes)
    after = np.roll(ring, -1)
    each = 1 + rings * spokes
    return np.concatenate(
        [np.stack([ring, after, after + each, ring + each], axis=1) + each * k for k in range(sections - 1)]
    )


def stand_in(sections=17, rings=1, spokes=8, off_grid=16):
    """The biceps in 32 factorial and some off-grid cases; float32, as stores have it."""
    factorial = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    activation = np.concatenate([factorial, np.random.default_rng(7).uniform(size=(off_grid, 5))])
    material = spindle_nodes(sections, rings, spokes)
    body = Body(
        place(material, np.zeros((1, 5)))[0], spindle_skin(sections, rings, spokes), np.zeros((0, 8), dtype=np.int64)
    )
    cauchy = stress(material, activation)
    fields = {"position": place(material, activation), "cauchy_stress": cauchy, "von_mises": von_mises(cauchy)}
    return cases_in_memory(
        "biceps",
        body,
        activation,
        ["factorial"] * 32 + ["off_grid"] * off_grid,
        {name: values.astype(np.float32) for name, values in fields.items()},
        elbow_angles(activation),
    )


@pytest.fixture(scope="session", autouse=True)
def _one_thread():
    torch.set_num_threads(1)


@pytest.fixture(scope="session")
def cases():
    """153 nodes, 48 cases."""
    return stand_in()


@pytest.fixture(scope="session")
def sampler(cases):
    """Nine sensors, 144 queries."""
    return PairSampler(cases, random_sensors(cases.nodes))


@pytest.fixture(scope="session")
def strict(cases):
    """Pairs of the strict protocol."""
    return split_pairs(cases, "strict")


@pytest.fixture(scope="session")
def mean_error():
    """Function: mean distance [mm] of a predictor's answers from the truth."""

    def measure(predictor, batch):
        answered = predictor.predict(batch.question).values["position"]
        return np.linalg.norm(answered - batch.truth["position"], axis=-1).mean()

    return measure
