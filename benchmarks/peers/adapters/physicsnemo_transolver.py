"""nvidia-physicsnemo: Transolver, attention between slices of the nodes; activations are features of each node."""

import torch
from physicsnemo.models.transolver import Transolver

from adapters.stepwise import places, train

DOES = {"package": "nvidia-physicsnemo", "anywhere": False, "reads": "activations"}
WIDTH, HEADS, LAYERS, SLICES = 32, 4, 3, 16


def fit(task):
    """Its own unstructured form, thin enough to take steps on one thread."""
    torch.manual_seed(task.seed)
    where = places(task)
    network = Transolver(
        functional_dim=5, out_dim=4, embedding_dim=3, n_layers=LAYERS, n_hidden=WIDTH, n_head=HEADS, mlp_ratio=2,
        slice_num=SLICES, use_te=False,
    )  # fmt: skip

    def forward(activation):
        many, nodes = len(activation), len(where)
        given = activation[:, None].expand(many, nodes, -1)
        return network(given, where.expand(many, nodes, 3))

    return train(network, forward, task)
