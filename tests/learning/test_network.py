"""The graph element network: its parts obey their equations, its whole the symmetries of its inputs."""

import numpy as np
import pytest
import torch

from myograph.learning.config import NetworkConfig
from myograph.learning.network import GraphElementNetwork, nearness

SIDES = np.array([0.3, 0.2, 1.0])


def network(seed=0, sides=SIDES, **config):
    return GraphElementNetwork(NetworkConfig(**config), sides, values=3, outputs=3, seed=seed)


def samples(axes=3, sensors=9, values=3):
    draw = torch.Generator().manual_seed(1)
    sides = torch.tensor(SIDES[:axes], dtype=torch.float32)
    points, queries = (torch.rand(2, count, axes, generator=draw) * sides for count in (sensors, 20))
    return points, torch.randn(2, sensors, values, generator=draw), queries


@pytest.mark.parametrize("per_axis", [2, 7])
@pytest.mark.parametrize("legacy_sign", [False, True])
def test_the_shares_of_a_point_sum_to_one(per_axis, legacy_sign):
    points, _, _ = samples()
    shares = network(nodes_per_axis=per_axis, legacy_sign=legacy_sign).shares(points)
    assert shares.shape == (2, 9, per_axis**3)
    torch.testing.assert_close(shares.sum(dim=-1), torch.ones(2, 9))


def test_the_representer_is_the_softmax_of_minus_sharpness_times_squared_distance():
    points, nodes = samples()[0], torch.rand(8, 3)
    squares = torch.cdist(points, nodes).square()
    shares = torch.softmax(nearness(points, nodes, torch.tensor(7.0)), dim=-1)
    torch.testing.assert_close(shares, torch.softmax(-7.0 * squares, dim=-1), rtol=1e-4, atol=1e-6)


def test_the_nearest_node_has_the_largest_share_and_with_the_legacy_sign_the_farthest():
    points, _, _ = samples()
    right, legacy = (network(nodes_per_axis=7, legacy_sign=sign) for sign in (False, True))
    distances = torch.cdist(points, right.nodes)
    torch.testing.assert_close(right.shares(points).argmax(dim=-1), distances.argmin(dim=-1))
    torch.testing.assert_close(legacy.shares(points).argmax(dim=-1), distances.argmax(dim=-1))


def test_with_the_legacy_sign_343_nodes_count_for_no_more_than_some_corners():
    """Effective number of nodes 1 / sum m², m = mean share of a node over places in the box."""
    places = torch.rand(1, 2000, 3) * torch.tensor(SIDES, dtype=torch.float32)
    heard = {}
    for legacy_sign in (False, True):
        mass = network(nodes_per_axis=7, legacy_sign=legacy_sign).shares(places).mean(dim=(0, 1))
        heard[legacy_sign] = 1 / mass.square().sum().item()
    assert heard[True] < 30 < 250 < heard[False]


@pytest.mark.parametrize(("per_axis", "spacing"), [(2, 0.5), (7, 0.5 / 6)])
def test_the_first_sharpness_is_one_over_the_spacing_squared(per_axis, spacing):
    assert network(nodes_per_axis=per_axis).log_sharpness.exp().item() == pytest.approx(spacing**-2, rel=1e-5)


@pytest.mark.parametrize("per_axis", [2, 7])
def test_the_thesis_network_has_5860_parameters_beside_its_node_positions(per_axis):
    thesis = network(nodes_per_axis=per_axis)
    assert thesis.weight_count == 5860
    assert thesis.nodes.shape == (per_axis**3, 3)


def test_the_thesis_rounds_are_3_and_13():
    assert [NetworkConfig(nodes_per_axis=n).message_rounds for n in (2, 7)] == [3, 13]
    assert NetworkConfig(nodes_per_axis=7, rounds=4).message_rounds == 4


@pytest.mark.parametrize("aggregation", ["sum", "mean"])
def test_renumbering_the_graph_nodes_changes_no_answer(aggregation):
    points, values, queries = samples()
    gen = network(nodes_per_axis=3, aggregation=aggregation)
    before = gen(points, values, queries)
    with torch.no_grad():
        gen.nodes.copy_(gen.nodes[torch.randperm(27, generator=torch.Generator().manual_seed(0))])
    gen.triangulate()
    torch.testing.assert_close(gen(points, values, queries), before, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("aggregation", ["sum", "mean"])
def test_renumbering_the_sensors_changes_no_answer(aggregation):
    points, values, queries = samples()
    gen = network(aggregation=aggregation)
    order = torch.randperm(9, generator=torch.Generator().manual_seed(0))
    renumbered = gen(points[:, order], values[:, order], queries)
    torch.testing.assert_close(renumbered, gen(points, values, queries), rtol=1e-4, atol=1e-5)


def test_each_sample_of_a_batch_is_answered_by_itself():
    points, values, queries = samples()
    gen = network()
    alone = torch.cat([gen(points[i : i + 1], values[i : i + 1], queries[i : i + 1]) for i in range(2)])
    torch.testing.assert_close(gen(points, values, queries), alone, rtol=1e-4, atol=1e-5)


def test_the_mean_does_not_see_sensors_told_twice_and_the_sum_does():
    points, values, queries = samples()
    twice = torch.cat([points, points], dim=1), torch.cat([values, values], dim=1), queries
    mean, total = network(aggregation="mean"), network(aggregation="sum")
    torch.testing.assert_close(mean(*twice), mean(points, values, queries), rtol=1e-4, atol=1e-5)
    assert (total(*twice) - total(points, values, queries)).abs().max() > 1e-3


def test_the_mean_is_a_number_even_in_nodes_whose_shares_are_too_small_for_one():
    points, values, queries = samples()
    sharp = network(nodes_per_axis=7)
    with torch.no_grad():
        sharp.log_sharpness.fill_(12.0)
    assert (sharp.shares(points).sum(dim=1) == 0).any()
    assert sharp(points, values, queries).isfinite().all()


@pytest.mark.parametrize("axes", [2, 3])
def test_space_may_have_two_or_three_dimensions(axes):
    points, values, queries = samples(axes, sensors=5, values=1)
    gen = GraphElementNetwork(NetworkConfig(nodes_per_axis=3), SIDES[:axes], values=1, outputs=4, seed=0)
    assert gen(points, values, queries).shape == (2, 20, 4)


def test_the_shares_give_every_node_position_and_the_sharpness_a_gradient():
    gen = network()
    gen.shares(samples()[0]).square().sum().backward()
    assert gen.nodes.grad.abs().amax(dim=-1).min() > 1e-3
    assert gen.log_sharpness.grad.abs() > 1e-3


def test_a_latent_of_one_is_warned_about_because_it_cannot_see_its_input():
    points, values, queries = samples()
    with pytest.warns(UserWarning, match="latent of size 1"):
        blind = network(latent=1)
    torch.testing.assert_close(blind(points, values, queries), blind(points, 5 * values, queries))


def test_the_seed_decides_the_weights_and_torch_keeps_its_own():
    torch.manual_seed(3)
    expected = torch.rand(1)
    torch.manual_seed(3)
    first, again, other = (network(seed=seed).state_dict() for seed in (1, 1, 2))
    assert torch.rand(1) == expected
    assert all(torch.equal(first[name], again[name]) for name in first)
    assert not torch.equal(first["encoder.0.weight"], other["encoder.0.weight"])
