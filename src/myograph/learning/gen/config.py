"""How a graph element network is built.

Three presets: `NetworkConfig.thesis()`, what the thesis describes, its traps set right; `NetworkConfig()`, as many
weights, learned many times faster; `NetworkConfig.improved()`, the most exact. `Traps` brings the mistakes of the
thesis's listings back, to show what each costs.
"""

from typing import Annotated, Literal

from pydantic import Field

from myograph.config import Model
from myograph.ensemble.pairs.features import Feature
from myograph.learning.physics.config import Physics

Processor = Literal[
    "gcn",
    "mlp",
    "mpnn",
    "GCNConv",
    "ChebConv",
    "SAGEConv",
    "GATv2Conv",
    "GraphConv",
    "TAGConv",
    "TransformerConv",
]
Reads = Literal["sensors", "activation", "sensors_and_activation"]


class Traps(Model):
    """Mistakes of the thesis's listings, each on its own; all are off.

    Parameters
    ----------
    legacy_sign
        Listing 5.2: softmax of *plus* squared distance: the farthest node wins.
    legacy_axis
        Listing 5.2: softmax over the points instead of the nodes: the answer at a query depends on the other queries.
    no_query
        Listing 5.3: the decoder sees the interpolated state without the place of the query.
    millimetres
        Places are not normalised: the softmax is one-hot, and node positions receive no gradient.
    triangle_edges
        A loop over simplices that was written for triangles: three of a tetrahedron's six edges.
    """

    legacy_sign: bool = False
    legacy_axis: bool = False
    no_query: bool = False
    millimetres: bool = False
    triangle_edges: bool = False


class NetworkConfig(Model):
    """Shape of the network.

    Parameters
    ----------
    nodes_per_axis
        The graph has this many nodes along each axis: 2 or 7 in the thesis.
    latent
        Features of a graph node.
    hidden
        Widths of the hidden layers of encoders and decoders.
    rounds
        Rounds of message passing; None means 2 nodes_per_axis - 1.
    inputs
        Input functions, each with its own encoder and made of one or more features at the sensors.
    outputs
        Output functions, each with its own decoder: 'coordinates' is T, as in the thesis; 'displacement' is T - S,
        which is quicker to learn.
    aggregation
        What a graph node makes of the encoded sensors: the 'sum' weighted by its shares, as in the thesis, or their
        'mean', which does not fade where nodes are many, and takes any number of sensors.
    processor
        What happens in a round: 'gcn', 'mlp', 'mpnn', or a convolution of PyTorch Geometric by its name.
    representer
        How points share in nodes: 'dense', softmax over all; 'nearest', softmax over the `nearest` ones;
        'barycentric', coordinates in the tetrahedron of the triangulation.
    sharpness
        Of the softmax: one learned number, one for each node, or 'fixed' as it is at first.
    nonlinearity
        Between the layers of encoders, decoders and processors.
    skip
        'affine' adds the affine map that suits the sensors best, so that the network learns what is left; for outputs
        that are made of positions.
    context
        Whether decoders also see the mean state of the nodes.
    modulated
        Whether the state multiplies the hidden layers of the decoders.
    activation_input
        Whether the activations of the target case are a further input.
    dropout
        With an activation input: share of training steps without sensors, and share of samples without activation.
    reads
        What of them the module reads when it is used.
    physics
        What a training minds beside the cases: that volumes stay, and the clamped end.
    traps
        Mistakes to be shown.
    """

    nodes_per_axis: int = Field(default=2, ge=2)
    latent: int = Field(default=32, ge=1)
    hidden: tuple[Annotated[int, Field(ge=1)], ...] = (32, 32)
    rounds: int | None = Field(default=None, ge=1)
    inputs: tuple[tuple[Feature, ...], ...] = (("displacement",),)
    outputs: tuple[tuple[Feature, ...], ...] = (("displacement",),)
    aggregation: Literal["sum", "mean"] = "mean"
    processor: Processor = "gcn"
    representer: Literal["dense", "nearest", "barycentric"] = "dense"
    nearest: int = Field(default=8, ge=1)
    sharpness: Literal["scalar", "per_node", "fixed"] = "scalar"
    nonlinearity: Literal["relu", "silu"] = "relu"
    skip: Literal["none", "affine"] = "none"
    context: bool = False
    modulated: bool = False
    activation_input: bool = False
    dropout: float = Field(default=0.3, ge=0, lt=0.5)
    reads: Reads = "sensors"
    physics: Physics = Physics()
    traps: Traps = Traps()

    @property
    def message_rounds(self) -> int:
        """Rounds of message passing."""
        return 2 * self.nodes_per_axis - 1 if self.rounds is None else self.rounds

    @property
    def input_features(self) -> tuple[Feature, ...]:
        """Features of all input functions, side by side."""
        return tuple(kind for kinds in self.inputs for kind in kinds)

    @property
    def output_features(self) -> tuple[Feature, ...]:
        """Features of all output functions, side by side."""
        return tuple(kind for kinds in self.outputs for kind in kinds)

    @classmethod
    def thesis(cls, nodes_per_axis: int = 2) -> "NetworkConfig":
        """Encoder 6-32-32-32, decoder 35-32-32-3, GCN 35-32, coordinates in and out: 5,860 parameters."""
        coordinates: tuple[tuple[Feature, ...], ...] = (("coordinates",),)
        return cls(nodes_per_axis=nodes_per_axis, inputs=coordinates, outputs=coordinates, aggregation="sum")

    @classmethod
    def improved(cls, nodes_per_axis: int = 2) -> "NetworkConfig":
        """The most exact: the network learns what the affine map of the sensors leaves, with modulated decoders."""
        return cls(
            nodes_per_axis=nodes_per_axis,
            latent=64,
            hidden=(64, 64),
            processor="mlp",
            nonlinearity="silu",
            skip="affine",
            context=True,
            modulated=True,
        )
