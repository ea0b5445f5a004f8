"""The graph convolution against PyTorch Geometric's and against dense algebra."""

import numpy as np
import pytest
import torch

from myograph.learning.graph_convolution import GraphConvolution, product, symmetric_matrix
from myograph.learning.mesh import delaunay_edges, grid_nodes, normalised_adjacency


@pytest.fixture(params=[2, 7], ids=["8 nodes", "343 nodes"])
def graph(request):
    nodes = grid_nodes(request.param, np.ones(3), seed=0)
    edges = delaunay_edges(nodes)
    return torch.tensor(nodes, dtype=torch.float32), edges, symmetric_matrix(normalised_adjacency(edges, len(nodes)))


def test_it_equals_the_gcn_of_pytorch_geometric_on_places_and_states(graph):
    geometric = pytest.importorskip("torch_geometric.nn")
    nodes, edges, adjacency = graph
    torch.manual_seed(0)
    ours, theirs = GraphConvolution(3, 32, gain=1.0), geometric.GCNConv(35, 32)
    with torch.no_grad():
        ours.bias.normal_()
        theirs.lin.weight.copy_(ours.weight.T)
        theirs.bias.copy_(ours.bias)
    state = torch.randn(len(nodes), 4, 32)
    answer = ours(state, ours.places(nodes, adjacency), adjacency)
    both_ways = torch.tensor(np.concatenate([edges, edges[:, ::-1]]).T.copy())
    for sample in range(4):
        expected = theirs(torch.cat([nodes, state[:, sample]], dim=-1), both_ways)
        torch.testing.assert_close(answer[:, sample], expected, rtol=1e-4, atol=1e-5)


def test_the_derivative_of_the_sparse_product_is_that_of_the_dense_one(graph):
    _, _, adjacency = graph
    x = torch.randn(adjacency.shape[0], 6, requires_grad=True)
    weights = torch.randn(adjacency.shape[0], 6)
    (sparse,) = torch.autograd.grad((product(adjacency, x) * weights).sum(), x)
    (dense,) = torch.autograd.grad((adjacency.to_dense() @ x * weights).sum(), x)
    torch.testing.assert_close(sparse, dense, rtol=1e-5, atol=1e-6)


def test_the_gain_scales_the_first_weights():
    torch.manual_seed(0)
    full = GraphConvolution(3, 32, gain=1.0).weight
    torch.manual_seed(0)
    torch.testing.assert_close(GraphConvolution(3, 32, gain=0.25).weight, full / 4)
