"""A stand-in for a simulated biceps: a bent spindle that shortens, thickens, and turns at the elbow."""

import itertools

import numpy as np
import pytest
import xarray as xr

from myograph.case import MUSCLES
from myograph.fields import AXES, VOIGT

ORIGIN, INSERTION = np.array([128.4, 172.4, -290.9]), np.array([50.1, 144.8, -637.7])
HINGE = np.array([35.4, 114.6, -585.6])
FORWARD, LATERAL = np.array([1.0, 1.5, 0.0]) / np.sqrt(3.25), np.array([-1.5, 1.0, 0.0]) / np.sqrt(3.25)


def spindle(across: int = 7, along: int = 25) -> tuple[np.ndarray, np.ndarray]:
    """Local coordinates (disc, disc, along in [0, 1]) of the nodes, and the quadrilaterals of the skin."""
    lattice = np.linspace(-1, 1, across)
    x, y, s = np.meshgrid(lattice, lattice, np.linspace(0, 1, along), indexing="ij")
    disc = [x * np.sqrt(1 - y**2 / 2), y * np.sqrt(1 - x**2 / 2)]
    index = np.arange(x.size).reshape(x.shape)
    sheets = [
        index[0], index[-1][::-1], index[:, 0][::-1], index[:, -1], index[:, :, 0], index[:, :, -1][::-1],
    ]  # fmt: skip
    quads = [np.stack([g[:-1, :-1], g[:-1, 1:], g[1:, 1:], g[1:, :-1]], axis=-1).reshape(-1, 4) for g in sheets]
    return np.stack([*disc, s], axis=-1).reshape(-1, 3), np.concatenate(quads)


def placed(local: np.ndarray, activation: float, angle: float) -> np.ndarray:
    """Positions [mm] of the spindle: the insertion turns about the hinge by `angle` [rad], the belly bulges."""
    c, s = np.cos(angle), np.sin(angle)
    arm = INSERTION - HINGE
    ahead, height = arm @ FORWARD, arm[2]
    end = INSERTION + (c * ahead - s * height - ahead) * FORWARD
    end = end + np.array([0.0, 0.0, s * ahead + c * height - height])
    share = local[:, 2:]
    axis = end - ORIGIN
    along = axis / np.linalg.norm(axis)
    ahead_square = np.cross(along, LATERAL)
    ahead_square /= np.linalg.norm(ahead_square)
    peak = 0.42 + 0.1 * activation
    belly = np.exp(-(((share - peak) / 0.17) ** 2))
    radius = 4.0 + (22.0 + 7.0 * activation) * belly
    bow = -np.sign(ahead_square @ FORWARD) * -30.0 * np.sin(np.pi * share) * ahead_square
    return ORIGIN + share * axis + bow + radius * (local[:, :1] * LATERAL + local[:, 1:2] * ahead_square)


@pytest.fixture(scope="session")
def biceps() -> xr.Dataset:
    """32 factorial and 16 off-grid cases under the dataset contract."""
    local, quads = spindle()
    corners = np.array(list(itertools.product([0.0, 1.0], repeat=5)))
    activation = np.concatenate([corners, np.random.default_rng(0).uniform(0.02, 0.98, (16, 5))])
    angle = 0.7 + 0.7 * activation[:, 2] + 0.4 * activation[:, 1] + 0.2 * activation[:, 0] - 0.8 * activation[:, 4]
    position = np.stack([placed(local, a[2], t - 1.06) for a, t in zip(activation, angle, strict=True)])
    cases, nodes = position.shape[:2]
    node_field = ("cases", "nodes")
    return xr.Dataset(
        {
            "activation": (("cases", "muscles"), activation),
            "elbow_angle": (("cases",), angle),
            "design": (("cases",), np.array(["factorial"] * 32 + ["off_grid"] * 16, dtype="<U16")),
            "reference_position": (("nodes", "axes"), placed(local, 0.0, 0.0)),
            "position": ((*node_field, "axes"), position),
            "cauchy_stress": ((*node_field, "voigt"), np.zeros((cases, nodes, 6))),
            "von_mises": (node_field, np.zeros((cases, nodes))),
            "fibre_stretch": (node_field, np.ones((cases, nodes))),
            "pressure": (node_field, np.zeros((cases, nodes))),
            "surface_quads": (("facets", "corners"), quads),
        },
        coords={"muscles": list(MUSCLES), "axes": list(AXES), "voigt": list(VOIGT)},
        attrs={"muscle": "biceps", "schema": 1, "simulator": "stand-in", "preset": "test"},
    )
