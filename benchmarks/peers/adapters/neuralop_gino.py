"""neuraloperator: the geometry-informed neural operator, from the body's nodes over a latent grid to the same nodes.

Without torch-scatter, which must be built from sources, it takes means over neighbours in a loop that its authors wrote
for tests only, with which two steps fit into twenty seconds: the same means, all at once, take its place.
"""

import torch
from neuralop.layers import integral_transform
from neuralop.models import GINO

from adapters.stepwise import places, train

DOES = {"package": "neuraloperator", "anywhere": True, "reads": "activations"}
GRID = 8


def segment_csr(src, indptr, reduction, use_scatter):
    """Sums or means of src (batch, neighbours, channels) between indptr (batch, nodes + 1), alike for the batch."""
    many = indptr[0].diff()
    node = torch.repeat_interleave(torch.arange(len(many)), many)
    total = src.new_zeros(len(src), len(many), src.shape[-1]).index_add(1, node, src)
    return total / many.clamp(min=1)[:, None] if reduction == "mean" else total


integral_transform.segment_csr = segment_csr


def fit(task):
    """Activations are features of every input node; one latent grid for all cases."""
    torch.manual_seed(task.seed)
    where = places(task)
    low, high = where.min(dim=0).values, where.max(dim=0).values
    where = (where - low) / (high - low)
    line = torch.linspace(0, 1, GRID)
    grid = torch.stack(torch.meshgrid(line, line, line, indexing="ij"), dim=-1)[None]
    network = GINO(
        in_channels=5,
        out_channels=4,
        gno_coord_dim=3,
        in_gno_radius=0.25,
        out_gno_radius=0.25,
        fno_in_channels=5,
        fno_n_modes=(4, 4, 4),
        fno_hidden_channels=16,
        fno_n_layers=2,
        gno_use_open3d=False,
        gno_use_torch_scatter=False,
    )

    def forward(activation):
        features = activation[:, None, :].expand(-1, len(where), -1)
        return network(input_geom=where[None], latent_queries=grid, output_queries=where, x=features)

    return train(network, forward, task)
