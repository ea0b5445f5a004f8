"""The graph in torch against dense algebra."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
import torch

from myograph.learning.gen.graph import graph_of
from myograph.learning.gen.mesh import grid_nodes


@pytest.fixture(params=[2, 7], ids=["8 nodes", "343 nodes"])
def graph(request):
    return graph_of(grid_nodes(request.param, np.ones(3), seed=0))


def test_the_derivative_of_the_sparse_product_is_that_of_the_dense_one(graph):
    x = torch.randn(len(graph.dense), 2, 3, requires_grad=True)
    weights = torch.randn(len(graph.dense), 2, 3)
    (sparse,) = torch.autograd.grad((graph.smooth(x) * weights).sum(), x)
    (dense,) = torch.autograd.grad((torch.einsum("nm,mbk->nbk", graph.dense, x) * weights).sum(), x)
    torch.testing.assert_close(sparse, dense, rtol=1e-5, atol=1e-6)


def test_every_edge_stands_both_ways_and_the_neighbours_are_counted(graph):
    ways = {tuple(way) for way in graph.edges.T.tolist()}
    assert all((receiver, sender) in ways for sender, receiver in ways)
    counted = np.bincount(graph.edges[1].numpy(), minlength=len(graph.dense))
    np.testing.assert_array_equal(graph.neighbours.numpy(), counted)


def test_a_graph_is_where_it_is_asked_to_be(graph):
    assert graph.on(torch.device("cpu")) is graph
    moved = graph.on(torch.device("meta"))
    assert {part.device.type for part in (moved.edges, moved.dense, moved.neighbours)} == {"meta"}


def test_a_graph_comes_back_from_another_process_whole_and_without_warnings(graph, tmp_path):
    again = pickle.loads(pickle.dumps(graph))
    assert torch.equal(again.sparse.to_dense(), graph.sparse.to_dense())
    assert torch.equal(again.edges, graph.edges)
    (tmp_path / "graph").write_bytes(pickle.dumps(graph))
    told = f"import pickle, pathlib; print(type(pickle.loads(pathlib.Path({str(tmp_path / 'graph')!r}).read_bytes())))"
    done = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True, check=True)
    assert "Graph" in done.stdout
    assert "Sparse" not in done.stderr
