"""Steady heat in a house of two rooms: the graph element network in two dimensions, with two input functions.

-div(k grad u) = heaters inside, u = that of the street on the outer walls. The wall between the rooms lets little heat
through, its door lets it pass. What goes in: the heaters at their places, and temperatures at some points of the outer
walls; what comes out: the temperature anywhere. Any other partial differential equation takes the place of `solve`.
Source: Alet et al. 2019, section 5.1, for the problem.
"""

from dataclasses import dataclass

import numpy as np
import torch
from scipy.sparse import csc_array, diags_array, kron
from scipy.sparse.linalg import splu

from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.network import GraphElementNetwork

CELLS = 32
LINE = np.linspace(0, 1, CELLS + 1)
PLACES = np.stack(np.meshgrid(LINE, LINE, indexing="ij"), axis=-1)
OUTSIDE = (PLACES == 0).any(axis=-1) | (PLACES == 1).any(axis=-1)
WALL, DOOR, CONDUCTIVITY = 0.5, (0.35, 0.65), 0.02
HEATERS, HEATER_WIDTH, SENSED = 2, 0.06, 8


@dataclass(frozen=True)
class Houses:
    """Many houses; arrays begin with the number of the house, places are in [0, 1]²."""

    heaters: np.ndarray
    power: np.ndarray
    walls: np.ndarray
    street: np.ndarray
    temperature: np.ndarray


def stiffness() -> csc_array:
    """Five-point differences of div(k grad); rows of all points, k per edge between two points."""
    difference = diags_array([-1.0, 1.0], offsets=[0, 1], shape=(CELLS, CELLS + 1)) * CELLS
    middle = (LINE[1:] + LINE[:-1]) / 2
    y = np.broadcast_to(LINE, (CELLS, CELLS + 1))
    crosses = (np.abs(middle - WALL) < 1 / CELLS)[:, None] & ((y < DOOR[0]) | (y > DOOR[1]))
    along_x = kron(difference, diags_array(np.ones(CELLS + 1)))
    along_y = kron(diags_array(np.ones(CELLS + 1)), difference)
    conductivity = np.where(crosses, CONDUCTIVITY, 1.0).ravel()
    return csc_array(along_x.T @ diags_array(conductivity) @ along_x + along_y.T @ along_y)


def solve(houses: int, seed: int) -> Houses:
    """Random heaters and streets, and the temperatures that come of them."""
    draw = np.random.default_rng(seed)
    heaters, power = draw.uniform(0.1, 0.9, (houses, HEATERS, 2)), draw.uniform(5, 15, (houses, HEATERS, 1))
    walls = PLACES[OUTSIDE][:: OUTSIDE.sum() // (4 * SENSED)]
    slope, level = draw.normal(size=(houses, 1, 2)), draw.normal(size=(houses, 1, 1))
    street = level + (PLACES[OUTSIDE] * slope).sum(axis=-1, keepdims=True)
    squares = np.square(PLACES[None, :, :, None] - heaters[:, None, None]).sum(axis=-1)
    heat = (power[:, None, None, :, 0] * np.exp(-squares / (2 * HEATER_WIDTH**2))).sum(axis=-1)

    matrix, inside = stiffness(), np.flatnonzero(~OUTSIDE.ravel())
    outside = np.flatnonzero(OUTSIDE.ravel())
    temperature = np.zeros((houses, PLACES[..., 0].size))
    temperature[:, outside] = street[..., 0]
    right = heat.reshape(houses, -1)[:, inside] - temperature[:, outside] @ matrix[inside][:, outside].T
    temperature[:, inside] = splu(csc_array(matrix[inside][:, inside])).solve(right.T).T
    sensed = level + (walls * slope).sum(axis=-1, keepdims=True)
    return Houses(heaters, power / 10, np.broadcast_to(walls, (houses, *walls.shape)), sensed, temperature)


def answer(network: GraphElementNetwork, of: Houses, which: np.ndarray, asked: np.ndarray) -> torch.Tensor:
    """Temperatures of some houses at some points."""
    arrays = (of.heaters, of.power, of.walls, of.street)
    heaters, power, walls, street = (torch.tensor(array[which], dtype=torch.float32) for array in arrays)
    queries = torch.tensor(PLACES.reshape(-1, 2)[asked], dtype=torch.float32).expand(len(which), -1, -1)
    return network([(heaters, power), (walls, street)], queries)[0][..., 0]


def train(houses: Houses, steps: int, nodes_per_axis: int) -> GraphElementNetwork:
    """A network that has seen these houses; its nodes move, and are joined anew."""
    config = NetworkConfig(
        nodes_per_axis=nodes_per_axis, processor="mpnn", nonlinearity="silu", rounds=4, aggregation="sum"
    )
    network = GraphElementNetwork(config, np.ones(2), values=[1, 1], outputs=[1], seed=0)
    adam = torch.optim.Adam(network.parameters(), lr=3e-3)
    rate = torch.optim.lr_scheduler.OneCycleLR(adam, 5e-3, total_steps=steps)
    draw = np.random.default_rng(0)
    for step in range(steps):
        which, asked = draw.integers(len(houses.power), size=16), draw.integers(PLACES[..., 0].size, size=64)
        wanted = torch.tensor(houses.temperature[which][:, asked], dtype=torch.float32)
        loss = (answer(network, houses, which, asked) - wanted).square().mean()
        adam.zero_grad()
        loss.backward()
        adam.step()
        rate.step()
        if step % 50 == 0:
            network.triangulate()
    network.triangulate()
    return network


def errors(houses: int = 1000, steps: int = 1500, nodes_per_axis: int = 6) -> tuple[float, float]:
    """Mean error on houses that were not seen, and that of answering with the mean temperature [K]."""
    seen, fresh = solve(houses, seed=0), solve(50, seed=1)
    network = train(seen, steps, nodes_per_axis)
    with torch.no_grad():
        answered = answer(network, fresh, np.arange(50), np.arange(PLACES[..., 0].size)).numpy()
    mean = seen.temperature.mean(axis=0)
    return float(np.abs(answered - fresh.temperature).mean()), float(np.abs(mean - fresh.temperature).mean())


if __name__ == "__main__":
    torch.set_num_threads(1)
    error, error_of_mean = errors()
    print(f"mean error {error:.3f} K; answering with the mean temperature of each place: {error_of_mean:.3f} K")
