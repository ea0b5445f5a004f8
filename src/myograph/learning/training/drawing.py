"""Batches of pairs as most trainables draw them, and pairs held out from training.

Where several processes train together, all of them draw the same pairs and queries and each takes its share of the
pairs: the losses are those of one process.
"""

import numpy as np
import torch

from myograph.ensemble.pairs.protocols import PairSet
from myograph.ensemble.pairs.question import Batch
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.errors import InputError
from myograph.learning.training.config import TrainingConfig

HELD_OUT_STREAM = 1
"""Sets the chance of held-out cases apart from that of the steps."""


def draw_batch(sampler: PairSampler, pairs: PairSet, config: TrainingConfig, generator: np.random.Generator) -> Batch:
    """This process's share of a batch: `config.batch` pairs and `config.queries` nodes at random."""
    drawn = pairs.draw(generator, config.batch)
    asked = min(config.queries, len(sampler.queries))
    queries = generator.choice(sampler.queries, size=asked, replace=False)
    return sampler.batch(share_of(drawn), queries)


def share_of(rows: np.ndarray) -> np.ndarray:
    """The rows of this process: all of them where it is alone."""
    if not (torch.distributed.is_available() and torch.distributed.is_initialized()):
        return rows
    return rows[torch.distributed.get_rank() :: torch.distributed.get_world_size()]


def hold_out(pairs: PairSet, share: float, seed: int = 0) -> tuple[PairSet, PairSet]:
    """Pairs to train on, and pairs to validate on: none of the latter's targets is in either role of the former.

    Parameters
    ----------
    share
        Of the cases [-]; 0 holds out nothing, and the second set is empty.

    Raises InputError where one of both sets would have no pairs.
    """
    count = round(share * len(pairs.cases))
    shuffled = np.random.default_rng((seed, HELD_OUT_STREAM)).permutation(pairs.cases)
    held = np.sort(shuffled[:count])
    taught = PairSet(np.setdiff1d(pairs.initial, held), np.setdiff1d(pairs.target, held))
    validated = PairSet(taught.initial, np.intersect1d(pairs.target, held))
    if not len(taught) or (share > 0 and not len(validated)):
        raise InputError(
            f"validation: expected cases for both training and validation, got {len(pairs.cases)} cases and a share of "
            f"{share}; take a larger dataset or another share"
        )
    return taught, validated
