"""neuraloperator: the geometry-informed neural operator, from the body's nodes over a latent grid to the same nodes."""

import torch
from neuralop.models import GINO

from adapters.stepwise import places, train

DOES = {"package": "neuraloperator", "anywhere": True, "reads": "activations"}
GRID = 8


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
