"""The graph element network: its whole obeys the symmetries of its inputs, in any space, with any functions."""

import numpy as np
import pytest
import torch

from myograph.errors import InputError
from myograph.learning.gen.config import NetworkConfig, Traps
from myograph.learning.gen.network import GraphElementNetwork

SIDES = np.array([0.3, 0.2, 1.0])
CONFIGS = {
    "sum": NetworkConfig(aggregation="sum", nodes_per_axis=3),
    "mean": NetworkConfig(aggregation="mean", nodes_per_axis=3),
    "mlp": NetworkConfig(processor="mlp", nonlinearity="silu", nodes_per_axis=3),
    "mpnn": NetworkConfig(processor="mpnn", sharpness="per_node", nodes_per_axis=3),
    "nearest": NetworkConfig(representer="nearest", context=True, nodes_per_axis=3),
    "barycentric": NetworkConfig(representer="barycentric", nodes_per_axis=3),
}


def network(config=None, seed=0, sides=SIDES, values=(3,), outputs=(3,)):
    return GraphElementNetwork(config or NetworkConfig(), sides, values, outputs, seed)


def samples(axes=3, sensors=9, values=3):
    draw = torch.Generator().manual_seed(1)
    sides = torch.tensor(SIDES[:axes], dtype=torch.float32)
    points, queries = (torch.rand(2, count, axes, generator=draw) * sides for count in (sensors, 20))
    return points, torch.randn(2, sensors, values, generator=draw), queries


def answer(gen, points, values, queries):
    return gen([(points, values)], queries)[0]


@pytest.fixture(params=CONFIGS, ids=str)
def gen(request):
    return network(CONFIGS[request.param])


@pytest.mark.parametrize("per_axis", [2, 7])
def test_the_thesis_network_has_5860_parameters_beside_its_node_positions(per_axis):
    thesis = network(NetworkConfig.thesis(per_axis))
    assert thesis.weight_count == 5860
    assert thesis.nodes.shape == (per_axis**3, 3)


def test_the_thesis_rounds_are_3_and_13():
    assert [NetworkConfig.thesis(n).message_rounds for n in (2, 7)] == [3, 13]
    assert NetworkConfig(nodes_per_axis=7, rounds=4).message_rounds == 4


@pytest.mark.parametrize(("per_axis", "spacing"), [(2, 0.5), (7, 0.5 / 6)])
def test_the_first_sharpness_is_one_over_the_spacing_squared(per_axis, spacing):
    gen = network(NetworkConfig(nodes_per_axis=per_axis))
    assert gen.log_sharpness.exp().item() == pytest.approx(spacing**-2, rel=1e-5)


def test_sharpness_is_one_number_or_one_for_each_node_or_not_learned():
    learned = {kind: network(NetworkConfig(sharpness=kind)).log_sharpness for kind in ("scalar", "per_node", "fixed")}
    assert {kind: tuple(number.shape) for kind, number in learned.items()} == {
        "scalar": (),
        "per_node": (8,),
        "fixed": (),
    }
    assert [number.requires_grad for number in learned.values()] == [True, True, False]


def test_renumbering_the_graph_nodes_changes_no_answer(gen):
    points, values, queries = samples()
    before = answer(gen, points, values, queries)
    order = torch.randperm(27, generator=torch.Generator().manual_seed(0))
    with torch.no_grad():
        gen.nodes.copy_(gen.nodes[order])
    gen.triangulate()
    torch.testing.assert_close(answer(gen, points, values, queries), before, rtol=1e-4, atol=1e-5)


def test_renumbering_the_sensors_changes_no_answer(gen):
    points, values, queries = samples()
    order = torch.randperm(9, generator=torch.Generator().manual_seed(0))
    renumbered = answer(gen, points[:, order], values[:, order], queries)
    torch.testing.assert_close(renumbered, answer(gen, points, values, queries), rtol=1e-4, atol=1e-5)


def test_each_sample_of_a_batch_is_answered_by_itself_and_each_query_by_itself(gen):
    points, values, queries = samples()
    together = answer(gen, points, values, queries)
    alone = torch.cat([answer(gen, points[i : i + 1], values[i : i + 1], queries[i : i + 1]) for i in range(2)])
    torch.testing.assert_close(together, alone, rtol=1e-4, atol=1e-5)
    torch.testing.assert_close(together[:, :3], answer(gen, points, values, queries[:, :3]), rtol=1e-4, atol=1e-5)


def test_what_every_sensor_says_is_heard(gen):
    points, values, queries = samples()
    values.requires_grad_()
    answer(gen, points, values, queries).square().sum().backward()
    assert values.grad.abs().amax(dim=(0, 2)).min() > 0


def test_the_mean_does_not_see_sensors_told_twice_and_the_sum_does():
    points, values, queries = samples()
    twice = torch.cat([points, points], dim=1), torch.cat([values, values], dim=1), queries
    mean, total = (network(CONFIGS[kind]) for kind in ("mean", "sum"))
    torch.testing.assert_close(answer(mean, *twice), answer(mean, points, values, queries), rtol=1e-4, atol=1e-5)
    assert (answer(total, *twice) - answer(total, points, values, queries)).abs().max() > 1e-3


def test_the_mean_is_a_number_even_in_nodes_whose_shares_are_too_small_for_one():
    points, values, queries = samples()
    sharp = network(NetworkConfig(nodes_per_axis=7))
    with torch.no_grad():
        sharp.log_sharpness.fill_(12.0)
    assert (sharp.shares(points).weights.sum(dim=1) == 0).any()
    assert answer(sharp, points, values, queries).isfinite().all()


@pytest.mark.parametrize("axes", [1, 2, 3, 4])
@pytest.mark.parametrize("representer", ["dense", "nearest", "barycentric"])
def test_space_may_have_any_number_of_dimensions(axes, representer):
    draw = torch.Generator().manual_seed(1)
    points, queries = (torch.rand(2, count, axes, generator=draw) for count in (5, 20))
    gen = network(NetworkConfig(nodes_per_axis=3, representer=representer), sides=np.ones(axes), values=[1])
    assert answer(gen, points, points[..., :1], queries).shape == (2, 20, 3)


def test_on_a_line_the_trap_of_triangles_joins_neighbours_as_ever():
    right, trap = (
        network(NetworkConfig(nodes_per_axis=5, traps=Traps(triangle_edges=on)), sides=np.ones(1))
        for on in (False, True)
    )
    assert torch.equal(right.graph.edges, trap.graph.edges)


def test_many_functions_go_in_each_at_its_own_points_and_many_come_out():
    points, values, queries = samples()
    gen = network(values=[3, 1], outputs=[2, 5, 1])
    answers = gen([(points, values), (queries[:, :4], queries[:, :4, :1])], queries)
    assert [tuple(part.shape) for part in answers] == [(2, 20, 2), (2, 20, 5), (2, 20, 1)]
    assert len(gen.encoders) == 2
    assert len(gen.decoders) == 3


def test_constants_add_the_same_state_to_every_node_and_may_be_all_that_is_known():
    queries = samples()[2]
    gen = GraphElementNetwork(NetworkConfig(), SIDES, [3], [3], seed=0, constants=6)
    one, other = (gen(None, queries, torch.full((2, 6), number))[0] for number in (0.0, 1.0))
    assert (one - other).abs().max() > 1e-3


def test_the_shares_give_every_node_position_and_the_sharpness_a_gradient():
    gen = network()
    gen.shares(samples()[0]).weights.square().sum().backward()
    assert gen.nodes.grad.abs().amax(dim=-1).min() > 1e-3
    assert gen.log_sharpness.grad.abs() > 1e-3


def test_a_latent_of_one_is_warned_about_because_it_cannot_see_its_input():
    points, values, queries = samples()
    with pytest.warns(UserWarning, match="latent of size 1"):
        blind = network(NetworkConfig(latent=1))
    torch.testing.assert_close(answer(blind, points, values, queries), answer(blind, points, 5 * values, queries))


def test_the_seed_decides_the_weights_and_torch_keeps_its_own():
    torch.manual_seed(3)
    expected = torch.rand(1)
    torch.manual_seed(3)
    first, again, other = (network(seed=seed).state_dict() for seed in (1, 1, 2))
    assert torch.rand(1) == expected
    assert all(torch.equal(first[name], again[name]) for name in first)
    assert not torch.equal(first["encoders.0.0.weight"], other["encoders.0.0.weight"])


def test_loaded_weights_are_joined_where_their_nodes_are():
    moved, fresh = network(NetworkConfig(nodes_per_axis=3)), network(NetworkConfig(nodes_per_axis=3), seed=5)
    with torch.no_grad():
        moved.nodes.mul_(torch.linspace(0.2, 1.7, 27)[:, None])
    moved.triangulate()
    fresh.load_state_dict(moved.state_dict())
    assert torch.equal(fresh.graph.dense, moved.graph.dense)


def test_with_the_legacy_sign_the_farthest_node_wins():
    points, _, _ = samples()
    right, legacy = (network(NetworkConfig(nodes_per_axis=7, traps=Traps(legacy_sign=sign))) for sign in (False, True))
    distances = torch.cdist(points, right.nodes)
    torch.testing.assert_close(right.shares(points).weights.argmax(dim=-1), distances.argmin(dim=-1))
    torch.testing.assert_close(legacy.shares(points).weights.argmax(dim=-1), distances.argmax(dim=-1))


def test_with_the_legacy_sign_343_nodes_count_for_no_more_than_some_corners():
    """Effective number of nodes 1 / sum m², m = mean share of a node over places in the box."""
    places = torch.rand(1, 2000, 3) * torch.tensor(SIDES, dtype=torch.float32)
    heard = {}
    for sign in (False, True):
        gen = network(NetworkConfig(nodes_per_axis=7, traps=Traps(legacy_sign=sign)))
        heard[sign] = 1 / gen.shares(places).weights.mean(dim=(0, 1)).square().sum().item()
    assert heard[True] < 30 < 250 < heard[False]


def test_with_the_legacy_axis_an_answer_depends_on_the_other_queries():
    points, values, queries = samples()
    trap = network(NetworkConfig(traps=Traps(legacy_axis=True)))
    together = answer(trap, points, values, queries)[:, :3]
    assert (together - answer(trap, points, values, queries[:, :3])).abs().max() > 1e-3


def test_without_the_query_the_thesis_decoder_lacks_its_35_inputs_and_the_network_96_weights():
    """3 x 32 weights of the first layer of the decoder."""
    trap = network(NetworkConfig.thesis().model_copy(update={"traps": Traps(no_query=True)}))
    assert trap.decoders[0][0].in_features == 32
    assert trap.weight_count == 5860 - 96


def test_in_millimetres_the_softmax_is_one_hot_and_nodes_receive_no_gradient():
    sides = 300 * SIDES
    points = samples()[0] * 300
    trap = network(NetworkConfig(traps=Traps(millimetres=True)), sides=sides)
    weights = trap.shares(points).weights
    weights.square().sum().backward()
    assert weights.amax(dim=2).min() > 1 - 1e-6
    assert trap.nodes.grad.abs().max() < 1e-6
    assert torch.equal(trap.seen(points), points)


def test_edges_of_a_loop_over_triangles_are_fewer():
    right, trap = (
        network(NetworkConfig(nodes_per_axis=3, traps=Traps(triangle_edges=on))).graph for on in (False, True)
    )
    assert trap.edges.shape[1] < right.edges.shape[1]


@pytest.mark.parametrize("trap", ["legacy_sign", "legacy_axis"])
def test_traps_of_the_softmax_without_a_dense_softmax_are_an_input_error(trap):
    with pytest.raises(InputError, match=r"the traps of listing 5\.2 exist for 'dense' only"):
        network(NetworkConfig(representer="nearest", traps=Traps(**{trap: True})))
