"""nvidia-physicsnemo: MeshGraphNet on the nearest neighbours of each node, activations as features of every node.

Of torch-scatter, which must be built from sources, it calls one function; where it was not built, PyTorch Geometric's
own function of the same name and arguments takes its place.
"""

import importlib.util
import sys
from importlib import metadata
from types import ModuleType
from unittest import mock

import numpy as np
import torch
import torch_geometric.utils
from torch_geometric.data import Data

from adapters.stepwise import places, train

SCATTER = "torch_scatter"
if importlib.util.find_spec(SCATTER) is None:
    sys.modules[SCATTER] = ModuleType(SCATTER)
    sys.modules[SCATTER].scatter = torch_geometric.utils.scatter
    known = metadata.version
    with mock.patch.object(metadata, "version", lambda name: "2.1.2" if name == SCATTER else known(name)):
        from physicsnemo.models.meshgraphnet import MeshGraphNet
else:
    from physicsnemo.models.meshgraphnet import MeshGraphNet

DOES = {"package": "nvidia-physicsnemo", "anywhere": False, "reads": "activations"}
WIDTH, ROUNDS, NEIGHBOURS = 32, 5, 6


def fit(task):
    """One graph for all cases, repeated over the batch."""
    torch.manual_seed(task.seed)
    where = places(task)
    edges = _edges(where)
    way = where[edges[1]] - where[edges[0]]
    features = torch.cat([way, way.norm(dim=1, keepdim=True)], dim=1)
    network = MeshGraphNet(
        8, 4, 4, processor_size=ROUNDS, hidden_dim_processor=WIDTH, hidden_dim_node_encoder=WIDTH,
        hidden_dim_edge_encoder=WIDTH, hidden_dim_node_decoder=WIDTH,
    )  # fmt: skip

    def forward(activation):
        many, nodes = len(activation), len(where)
        shift = (torch.arange(many) * nodes).repeat_interleave(edges.shape[1])
        graph = Data(edge_index=edges.repeat(1, many) + shift, num_nodes=many * nodes)
        given = torch.cat([where.repeat(many, 1), activation.repeat_interleave(nodes, dim=0)], dim=1)
        return network(given, features.repeat(many, 1), graph).view(many, nodes, 4)

    return train(network, forward, task)


def _edges(where):
    """The nearest neighbours of each node, both ways: elements with 27 nodes would give hundreds an element."""
    distance = torch.cdist(where, where)
    near = distance.argsort(dim=1)[:, 1 : NEIGHBOURS + 1]
    pairs = {(i, j) for i, row in enumerate(near.tolist()) for j in row}
    both = sorted(pairs | {(j, i) for i, j in pairs})
    return torch.from_numpy(np.array(both).T.copy())
