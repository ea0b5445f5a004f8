"""What a training is about: a folder goes on with the same questions about the same cases, and with no others."""

import hashlib

import numpy as np

from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler


def about(sampler: PairSampler, split: Split, shape: str) -> str:
    """Words for `train`: the data, the protocol, a checksum of the questions that teach, and what learns them.

    Parameters
    ----------
    shape
        Of what learns: its configuration as text.
    """
    told = f"{sampler.convention} known {sampler.known} asked {sampler.asked}"
    digest = hashlib.sha256(told.encode())
    for numbers in (sampler.sensors, split.train.initial, split.train.target):
        digest.update(f"\n{len(numbers)} ".encode() + np.ascontiguousarray(numbers, dtype="<i8").tobytes())
    return f"data {sampler.cases.checksum}, protocol {split.protocol}, questions {digest.hexdigest()}, {shape}"
