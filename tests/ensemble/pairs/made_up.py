"""Cases of one muscle made of random numbers: nothing in them is equal by accident."""

import numpy as np

from myograph.ensemble.muscle_cases import cases_in_memory
from myograph.ensemble.spec import Body
from myograph.fields import von_mises

NODES = 20


def body(nodes=NODES, seed=5):
    reference = np.random.default_rng(seed).normal(size=(nodes, 3)) * 50
    return Body(reference, np.arange(8).reshape(2, 4), np.zeros((0, 8), dtype=np.int64))


def made_up(factorial=6, off_grid=3, support=0, seed=0):
    """Cases in the order off_grid, factorial, support."""
    draw = np.random.default_rng(seed)
    design = ["off_grid"] * off_grid + ["factorial"] * factorial + ["support"] * support
    stress = draw.normal(size=(len(design), NODES, 6))
    fields = {
        "position": draw.normal(size=(len(design), NODES, 3)) * 50,
        "cauchy_stress": stress,
        "von_mises": von_mises(stress),
    }
    return cases_in_memory("biceps", body(), draw.uniform(size=(len(design), 5)), design, fields)
