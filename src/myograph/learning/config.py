"""How a graph element network is built and trained.

The default is the thesis's network with its 5,860 parameters and its traps set right: normalised coordinates, softmax
over nodes of minus distance, sharpness from the node spacing, six edges of each tetrahedron, real mini-batches. It
departs from the thesis in `target` and `aggregation`, without which it needs many times the training.
"""

from typing import Literal

from pydantic import Field

from myograph.config import Model


class NetworkConfig(Model):
    """Shape of the network.

    Parameters
    ----------
    nodes_per_axis
        The graph has this many nodes along each axis: 2 or 7 in the thesis.
    latent
        Features of a graph node.
    hidden
        Widths of the hidden layers of encoder and decoder.
    rounds
        Rounds of message passing; None means 2 nodes_per_axis - 1.
    target
        What the network answers, and what sensors tell beside S: 'coordinates' is T, as in the thesis; 'displacement'
        is T - S, which is quicker to learn.
    aggregation
        What a graph node makes of the encoded sensors: the 'sum' weighted by its shares, as in the thesis, or their
        'mean', which does not fade where nodes are many, and takes any number of sensors.
    legacy_sign
        True takes the softmax of plus distance, as the thesis's listing 5.2 does: only to show what goes wrong.
    """

    nodes_per_axis: int = Field(default=2, ge=2)
    latent: int = Field(default=32, ge=1)
    hidden: tuple[int, ...] = (32, 32)
    rounds: int | None = Field(default=None, ge=1)
    target: Literal["coordinates", "displacement"] = "displacement"
    aggregation: Literal["sum", "mean"] = "mean"
    legacy_sign: bool = False

    @property
    def message_rounds(self) -> int:
        """Rounds of message passing."""
        return 2 * self.nodes_per_axis - 1 if self.rounds is None else self.rounds


class TrainingConfig(Model):
    """Course of the training.

    Parameters
    ----------
    steps
        Steps of the optimisers, at most.
    seconds
        Wall time at most [s], by which the rates have come down too; None sets no limit. Where it ends the training,
        the result depends on the machine.
    batch
        Pairs in a step, drawn at random.
    queries
        Query nodes in a step, drawn at random; all of them where there are fewer.
    learning_rate
        Largest rate of the one-cycle schedule for the weights.
    node_learning_rate
        Likewise for the positions of the graph's nodes, which live in the unit box.
    triangulate_every
        Steps between triangulations of the moved nodes; another one follows the last step.
    seed
        Of the weights, of the graph's first nodes, and of the drawn batches.
    """

    steps: int = Field(default=2000, ge=1)
    seconds: float | None = Field(default=None, gt=0)
    batch: int = Field(default=8, ge=1)
    queries: int = Field(default=64, ge=1)
    learning_rate: float = Field(default=6e-3, gt=0)
    node_learning_rate: float = Field(default=3e-3, gt=0)
    triangulate_every: int = Field(default=50, ge=1)
    seed: int = Field(default=0, ge=0)
