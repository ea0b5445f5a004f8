"""Shares of points in nodes: softmax over all, over the nearest, and barycentric coordinates."""

import numpy as np
import pytest
import torch

from myograph.learning.gen.barycentric import _by_trying_all, _by_walking, _maps, barycentric_shares
from myograph.learning.gen.mesh import grid_nodes, triangulate
from myograph.learning.gen.representer import DenseShares, FewShares, nearest_shares, scores


def cloud(points=30, axes=3, per_axis=3):
    draw = torch.Generator().manual_seed(0)
    nodes = grid_nodes(per_axis, np.ones(axes), seed=0)
    return torch.rand(2, points, axes, generator=draw), torch.tensor(nodes, dtype=torch.float32)


def as_dense(shares):
    """Weights (batch, points, nodes) of shares in few nodes."""
    zeros = torch.zeros(*shares.indices.shape[:2], shares.count)
    return zeros.scatter_add(2, shares.indices, shares.weights)


@pytest.mark.parametrize("sharpness", [torch.tensor(7.0), torch.linspace(2.0, 9.0, 27)], ids=["scalar", "per node"])
def test_the_representer_is_the_softmax_over_nodes_of_minus_sharpness_times_squared_distance(sharpness):
    points, nodes = cloud()
    expected = torch.softmax(-sharpness * torch.cdist(points, nodes).square(), dim=2)
    weights = DenseShares(scores(points, nodes, sharpness)).weights
    torch.testing.assert_close(weights, expected, rtol=1e-4, atol=1e-6)
    torch.testing.assert_close(weights.sum(dim=2), torch.ones(2, 30))


def test_the_nearest_of_all_nodes_are_all_nodes():
    points, nodes = cloud()
    scored = scores(points, nodes, torch.tensor(7.0))
    state, encoded = torch.randn(27, 2, 5), torch.randn(2, 30, 5)
    few, dense = nearest_shares(scored, 27), DenseShares(scored)
    torch.testing.assert_close(few.collect(state), dense.collect(state), rtol=1e-4, atol=1e-5)
    for aggregation in ("sum", "mean"):
        torch.testing.assert_close(
            few.spread(encoded, aggregation), dense.spread(encoded, aggregation), rtol=1e-4, atol=1e-5
        )


def test_only_the_nearest_nodes_share_and_their_shares_sum_to_one():
    points, nodes = cloud()
    few = nearest_shares(scores(points, nodes, torch.tensor(7.0)), 4)
    nearest = torch.cdist(points, nodes).topk(4, largest=False).indices
    torch.testing.assert_close(few.indices.sort().values, nearest.sort().values)
    torch.testing.assert_close(few.weights.sum(dim=2), torch.ones(2, 30))


@pytest.mark.parametrize("axes", [1, 2, 3])
def test_barycentric_shares_reproduce_the_places_of_points_inside(axes):
    """Linear functions are reproduced exactly: sum_n w_n x_n = p."""
    points, nodes = cloud(axes=axes)
    inside = 0.2 + 0.6 * points
    shares = barycentric_shares(inside, nodes, triangulate(nodes.double().numpy()))
    assert (shares.weights >= 0).all()
    torch.testing.assert_close(shares.collect(nodes[:, None, :].expand(-1, 2, -1)), inside, rtol=1e-4, atol=1e-5)


def test_a_point_outside_of_all_simplices_has_shares_of_one_that_are_not_negative():
    points, nodes = cloud()
    shares = barycentric_shares(3 * points, nodes, triangulate(nodes.double().numpy()))
    assert (shares.weights >= 0).all()
    torch.testing.assert_close(shares.weights.sum(dim=2), torch.ones(2, 30))


def test_walking_to_a_simplex_and_trying_all_give_the_same_shares():
    points, nodes = cloud()
    triangulation = triangulate(nodes.double().numpy())
    maps = _maps(triangulation)
    ones = torch.cat([1.6 * points - 0.3, torch.ones(2, 30, 1)], dim=-1)
    found = [
        (ones[..., None, :] @ maps[way])[..., 0, :].amin(dim=-1)
        for way in (_by_walking(1.6 * points - 0.3, triangulation), _by_trying_all(1.6 * points - 0.3, maps))
    ]
    torch.testing.assert_close(*found, rtol=1e-3, atol=1e-4)


@pytest.mark.parametrize("kind", ["dense", "nearest", "barycentric"])
def test_node_positions_receive_the_derivative_of_the_shares(kind):
    """Against central differences, away from where the triangulation changes."""
    points, nodes = cloud(points=8)
    points, nodes = (0.2 + 0.6 * points).double(), nodes.double().requires_grad_()
    triangulation = triangulate(nodes.detach().numpy())

    def told(places):
        if kind == "barycentric":
            shares = barycentric_shares(points, places, triangulation)
        else:
            scored = scores(points, places, torch.tensor(7.0, dtype=torch.float64))
            shares = DenseShares(scored) if kind == "dense" else nearest_shares(scored, 6)
        return shares.collect(torch.linspace(0, 1, 27, dtype=torch.float64)[:, None, None].expand(-1, 2, 1))

    assert torch.autograd.gradcheck(told, (nodes,), eps=1e-7, atol=1e-5)


def test_the_mean_is_the_sum_over_the_received_shares_in_every_node():
    points, nodes = cloud()
    encoded, scored = torch.randn(2, 30, 5), scores(points, nodes, torch.tensor(3.0))
    for shares in (DenseShares(scored), nearest_shares(scored, 6)):
        mass = shares.spread(torch.ones(2, 30, 1), "sum")
        reached = mass[..., 0] > 1e-3
        mean = shares.spread(encoded, "mean")
        torch.testing.assert_close(mean[reached], (shares.spread(encoded, "sum") / mass)[reached], rtol=1e-4, atol=1e-5)


def test_nodes_in_which_no_point_shares_get_zero():
    shares = FewShares(torch.ones(1, 1, 1), torch.tensor([[[2]]]), 4)
    state = shares.spread(torch.full((1, 1, 3), 5.0), "mean")
    torch.testing.assert_close(state[:, 0, 0], torch.tensor([0.0, 0.0, 5.0, 0.0]))


def test_over_points_the_columns_sum_to_one_and_not_the_rows():
    points, nodes = cloud()
    trap = DenseShares(scores(points, nodes, torch.tensor(7.0)), over_points=True).weights
    torch.testing.assert_close(trap.sum(dim=1), torch.ones(2, 27))
    assert (trap.sum(dim=2) - 1).abs().max() > 0.1
    assert as_dense(nearest_shares(scores(points, nodes, torch.tensor(7.0)), 27)).shape == trap.shape
