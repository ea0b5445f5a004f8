"""Processors against their equations, and against PyTorch Geometric."""

import sys

import numpy as np
import pytest
import torch

from myograph.errors import MissingPackageError
from myograph.learning.gen.config import NetworkConfig
from myograph.learning.gen.geometric import SETTINGS
from myograph.learning.gen.graph import graph_of
from myograph.learning.gen.graph_convolution import GraphConvolution
from myograph.learning.gen.mesh import grid_nodes
from myograph.learning.gen.processors import MessagePassing, NodeUpdate, processor

OURS = ["gcn", "mlp", "mpnn"]


@pytest.fixture(scope="module")
def space():
    """125 nodes and their graph."""
    nodes = grid_nodes(5, np.ones(3), seed=0)
    return torch.tensor(nodes, dtype=torch.float32), graph_of(nodes)


def states(nodes, batch=4, latent=32):
    return torch.randn(nodes, batch, latent, generator=torch.Generator().manual_seed(0))


def test_the_graph_convolution_equals_that_of_pytorch_geometric_on_places_and_states(space):
    geometric = pytest.importorskip("torch_geometric.nn")
    nodes, graph = space
    torch.manual_seed(0)
    ours, theirs = GraphConvolution(3, 32, gain=1.0), geometric.GCNConv(35, 32)
    with torch.no_grad():
        ours.bias.normal_()
        theirs.lin.weight.copy_(ours.weight.T)
        theirs.bias.copy_(ours.bias)
    state = states(len(nodes))
    answer = ours(state, ours.prepare(nodes, graph), graph)
    for sample in range(4):
        expected = theirs(torch.cat([nodes, state[:, sample]], dim=-1), graph.edges)
        torch.testing.assert_close(answer[:, sample], expected, rtol=1e-4, atol=1e-5)


def test_the_gain_scales_the_first_weights_of_the_graph_convolution():
    torch.manual_seed(0)
    full = GraphConvolution(3, 32, gain=1.0).weight
    torch.manual_seed(0)
    torch.testing.assert_close(GraphConvolution(3, 32, gain=0.25).weight, full / 4)


def test_the_node_update_is_an_mlp_of_place_state_and_the_mean_of_the_neighbours(space):
    nodes, graph = space
    update, state = NodeUpdate(3, 32, 1.0, "silu"), states(len(nodes))
    answer = update(state, update.prepare(nodes, graph), graph)
    heard = graph.dense @ state[:, 1]
    torch.testing.assert_close(answer[:, 1], update.layers(torch.cat([nodes, state[:, 1], heard], dim=-1)))


def test_a_message_tells_receiver_sender_way_and_distance_and_nodes_hear_their_mean(space):
    nodes, graph = space
    passing, state = MessagePassing(3, 32, 1.0, "relu"), states(len(nodes))
    answer = passing(state, passing.prepare(nodes, graph), graph)
    neighbours = graph.edges[0][graph.edges[1] == 5]
    way = nodes[neighbours] - nodes[5]
    own = state[5, 2].expand(len(neighbours), -1)
    heard = passing.message(
        torch.cat([own, state[neighbours, 2], way, torch.linalg.norm(way, dim=-1, keepdim=True)], -1)
    )
    expected = passing.update(torch.cat([nodes[5], state[5, 2], heard.mean(dim=0)]))
    torch.testing.assert_close(answer[5, 2], expected, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("name", SETTINGS)
def test_a_geometric_convolution_of_a_batch_is_that_of_each_sample(space, name):
    pytest.importorskip("torch_geometric")
    nodes, graph = space
    torch.manual_seed(0)
    convolution = processor(NetworkConfig(processor=name), axes=3)
    state = states(len(nodes))
    answer = convolution(state, convolution.prepare(nodes, graph), graph)
    alone = convolution.convolution(torch.cat([nodes, state[:, 3]], dim=-1), graph.edges)
    assert answer.shape == state.shape
    torch.testing.assert_close(answer[:, 3], alone, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("name", [*OURS, *SETTINGS])
def test_what_a_node_hears_depends_on_its_neighbours_and_not_on_others(space, name):
    if name in SETTINGS:
        pytest.importorskip("torch_geometric")
    nodes, graph = space
    torch.manual_seed(0)
    one = processor(NetworkConfig(processor=name), axes=3)
    state = states(len(nodes)).requires_grad_()
    one(state, one.prepare(nodes, graph), graph)[0].square().sum().backward()
    reached = graph.dense[0] > 0
    for _ in range({"ChebConv": 1, "TAGConv": 1}.get(name, 0)):
        reached = graph.dense[reached].sum(dim=0) > 0
    assert state.grad is not None
    moved = state.grad.abs().sum(dim=(1, 2)) > 0
    assert moved[graph.dense[0] > 0].all()
    assert not moved[~reached].any()


def test_a_geometric_convolution_without_its_package_is_a_missing_package(monkeypatch):
    monkeypatch.setitem(sys.modules, "torch_geometric.nn", None)
    with pytest.raises(MissingPackageError, match=r"'ChebConv' needs the package 'torch-geometric'.*myograph\[train\]"):
        processor(NetworkConfig(processor="ChebConv"), axes=3)
