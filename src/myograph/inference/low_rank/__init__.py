"""Neural modes as plain arrays: what the page, the exports and the pictures evaluate without onnxruntime.

field      one field: mean, modes, their amounts over (x, u)
angle      activations and load -> x, and x -> the elbow's angle
muscle     both together: activations and load -> fields at the nodes
reading    out of the folders of saved models
"""

from myograph.inference.low_rank.angle import AngleNetwork
from myograph.inference.low_rank.field import RANGE, LowRankField
from myograph.inference.low_rank.muscle import LowRankMuscle, Place
from myograph.inference.low_rank.reading import read_low_rank, read_low_rank_arm

__all__ = [
    "RANGE",
    "AngleNetwork",
    "LowRankField",
    "LowRankMuscle",
    "Place",
    "read_low_rank",
    "read_low_rank_arm",
]
