"""Figures of the demo's report."""

import numpy as np
from jaxtyping import Float

from myograph.cli.arm import bone_surfaces
from myograph.cli.demo.networks import Comparison
from myograph.cli.demo.simulation import Simulation
from myograph.cli.demo.sizes import MUSCLE
from myograph.evaluation import Figure
from myograph.learning.gen.mesh import delaunay_edges
from myograph.mesh.presets import preset_mesh
from myograph.mesh.tissue import tendon_share
from myograph.units import NEWTON_MM_PER_NEWTON_METRE, degrees
from myograph.view import (
    NetworkNodes,
    Surface,
    draw_arm,
    draw_error_bars,
    draw_heat_maps,
    draw_moments,
    draw_network_nodes,
    draw_states,
    draw_training,
)
from myograph.view.palette import MUSCLE_COLOURS

_TOLD_ACTIVATIONS = (0.0, 0.5, 1.0)
_SMOOTHED = 10


def figures(simulation: Simulation, comparison: Comparison) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    return (
        _arm_figure(simulation, active=False),
        _arm_figure(simulation, active=True),
        _moment_figure(simulation),
        _states_figure(simulation, comparison),
        _error_figure(comparison),
        _heat_figure(simulation, comparison),
        _nodes_figure(comparison),
        _training_figure(comparison),
    )


def _arm_figure(simulation: Simulation, active: bool) -> Figure:
    solution = simulation.active if active else simulation.rest
    flexion = solution.elbow_angle - simulation.arm.reference_angle
    muscles = []
    for name, table in simulation.tables.items():
        mesh = preset_mesh(simulation.arm, name, simulation.preset)
        share = tendon_share(simulation.arm, name, mesh)
        points = solution.fields[name]["position"]
        muscles.append(Surface(points, table.skin, name, MUSCLE_COLOURS[name], share))
    state = "all muscles fully active" if active else "all muscles at rest"
    title = f"{state}: elbow at {degrees(solution.elbow_angle):.0f}°"
    picture = draw_arm([*bone_surfaces(simulation.arm, flexion), *muscles], title)
    return Figure(f"The arm, {state}, where its moments balance.", picture, f"Arm with five muscles, {title}")


def _moment_figure(simulation: Simulation) -> Figure:
    low, high = np.radians(simulation.arm.hinge.range_deg)
    angles = np.linspace(low, high, 81)
    moments = {
        name: {level: table.moment(angles, level) / NEWTON_MM_PER_NEWTON_METRE for level in _TOLD_ACTIVATIONS}
        for name, table in simulation.tables.items()
    }
    caption = "Moment of each muscle about the elbow over its angle, from the tables of finite-element states."
    return Figure(caption, draw_moments(np.degrees(angles), moments), "Moments of five muscles over the elbow angle")


def _states_figure(simulation: Simulation, comparison: Comparison) -> Figure:
    rest, active = (solution.fields[MUSCLE]["position"] for solution in (simulation.rest, simulation.active))
    picture = draw_states(rest, active, simulation.tables[MUSCLE].skin, comparison.sampler.sensors)
    caption = (
        "The biceps with all muscles at rest and fully active (as figure 5.2 of the thesis): the nine sensors"
        " black, the queries blue, arrows from S to T."
    )
    return Figure(caption, picture, "Biceps at rest and active")


def _error_figure(comparison: Comparison) -> Figure:
    caption = "Mean error of each method under each protocol."
    return Figure(caption, draw_error_bars(comparison.summaries), "Bars of mean errors")


def _heat_figure(simulation: Simulation, comparison: Comparison) -> Figure:
    nodes = len(simulation.tables[MUSCLE].reference)
    maps = {}
    for method, row in comparison.errors.items():
        if method != "do_nothing":
            maps[method] = np.full(nodes, np.nan)
            maps[method][comparison.sampler.queries] = row["strict"].node_mean
    picture = draw_heat_maps(simulation.tables[MUSCLE].reference, simulation.tables[MUSCLE].skin, maps)
    caption = "Where the errors sit on the biceps, protocol strict (as figure 6.2 f of the thesis)."
    return Figure(caption, picture, "Heat maps of the error on the biceps")


def _nodes_figure(comparison: Comparison) -> Figure:
    networks = [comparison.networks[key] for key in sorted(comparison.networks) if key[1] == "thesis"]
    before = [_nodes(f"{trained.predictor.name}, before", trained.nodes_before) for trained in networks]
    after = [_nodes(f"{trained.predictor.name}, after", trained.module.nodes_mm) for trained in networks]
    cloud = comparison.sampler.cases.values("position", np.array([0]))[0]
    caption = "The networks' nodes before and after training (as figure 6.2 a–e of the thesis)."
    return Figure(caption, draw_network_nodes(before, after, cloud), "Nodes of both networks before and after training")


def _nodes(title: str, positions: Float[np.ndarray, "nodes 3"]) -> NetworkNodes:
    return NetworkNodes(title, positions, delaunay_edges(positions))


def _training_figure(comparison: Comparison) -> Figure:
    runs = {
        f"{trained.predictor.name}, {protocol}": _smoothed(trained.history.rmse)
        for (_, protocol), trained in sorted(comparison.networks.items(), key=lambda item: item[0])
    }
    caption = f"Error of the training batches over the steps, each point the mean of {_SMOOTHED} steps."
    return Figure(caption, draw_training(runs), "Training curves")


def _smoothed(rmse: Float[np.ndarray, " steps"]) -> tuple[Float[np.ndarray, " points"], Float[np.ndarray, " points"]]:
    """Middle step and mean error [mm] of every few steps."""
    blocks = len(rmse) // _SMOOTHED
    means = rmse[: blocks * _SMOOTHED].reshape(blocks, _SMOOTHED).mean(axis=1)
    return (np.arange(blocks) + 0.5) * _SMOOTHED, means
