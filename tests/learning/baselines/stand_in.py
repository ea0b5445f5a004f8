"""A body that moves and is stressed by formulas of its activations, and questions about it."""

import itertools

import numpy as np

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.pairs.question import Question
from myograph.ensemble.pairs.sampler import PairSampler, random_sensors
from myograph.ensemble.spec import Body
from myograph.fields import von_mises

NODES, SUPPORT, OFF_GRID = 60, 48, 8


def bodies_cases(seed=0):
    """Factorial, support and off-grid cases whose positions and stresses are smooth in the activations."""
    draw = np.random.default_rng(seed)
    factorial = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    support = draw.integers(0, 11, size=(SUPPORT, 5)) / 10
    activation = np.concatenate([factorial, support, draw.uniform(size=(OFF_GRID, 5))])
    design = ["factorial"] * 32 + ["support"] * SUPPORT + ["off_grid"] * OFF_GRID
    body = stand_in_body()
    return cases_in_memory("biceps", body, activation, design, fields_of(body.reference, activation))


def stand_in_body():
    """A box of nodes, the first eight of them its skin."""
    reference = np.random.default_rng(1).uniform(-1, 1, size=(NODES, 3)) * [20, 20, 100]
    return Body(reference, np.arange(8).reshape(2, 4), np.empty((0, 27), dtype=np.int64))


def fields_of(reference, activation):
    """Turned by the first activations and bulged by the third; stress grows with the third."""
    turn = 0.6 * np.tanh(activation @ [0.5, 0.8, 1.0, -0.2, -1.0])
    own = activation[:, 2, None]
    x, y, z = reference.T
    bulge = 1 + 0.2 * own * np.cos(z / 60)
    cos, sin = np.cos(turn)[:, None], np.sin(turn)[:, None]
    position = np.stack([cos * x * bulge + sin * z, y * bulge, cos * z - sin * x * bulge], axis=-1)
    stress = own[..., None] * np.sin(reference / 50 @ np.ones((3, 6)) + np.arange(6)) * (1 + turn[:, None, None])
    return {"position": position, "cauchy_stress": stress, "von_mises": von_mises(stress)}


def stand_in_sampler(convention="initial", asked=("position",), cases=None):
    """Nine sensors."""
    cases = bodies_cases() if cases is None else cases
    return PairSampler(cases, random_sensors(cases.nodes), convention, asked=asked)


def question(sensors, moved, queries, convention="initial"):
    """About sensors that moved from there to there."""
    batch = len(sensors)
    return Question(
        convention,
        np.zeros((batch, 5)),
        np.zeros(batch),
        np.arange(sensors.shape[1]),
        np.arange(queries.shape[1]),
        sensors,
        queries,
        {"position": sensors},
        {"position": moved},
        {"position": queries},
    )


def distances(answer, batch):
    """Between answered and true positions [mm]."""
    return np.linalg.norm(answer.values["position"] - batch.truth["position"], axis=-1)
