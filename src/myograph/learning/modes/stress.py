"""Von Mises stress and its change, in torch; `myograph.fields.von_mises` is the same in NumPy.

σ_v² = B(σ, σ),    dσ_v = B(σ, dσ) / σ_v
B(σ, τ) = ((σ_xx - σ_yy)(τ_xx - τ_yy) + ...) / 2 + 3 (σ_yz τ_yz + σ_xz τ_xz + σ_xy τ_xy)
"""

import torch
from jaxtyping import Float
from torch import Tensor

SMALLEST = 1e-6
"""Von Mises stress [MPa] below which its direction is not defined."""


def von_mises(stress: Float[Tensor, "*batch 6"]) -> Float[Tensor, "*batch"]:
    """Von Mises stress [MPa] of a Cauchy stress in Voigt order xx yy zz yz xz xy."""
    return _product(stress, stress).sqrt()


def von_mises_change(
    stress: Float[Tensor, "#*batch 6"], change: Float[Tensor, "#*batch 6"]
) -> Float[Tensor, "#*batch"]:
    """What a small change of the stress changes [MPa]."""
    return _product(stress, change) / von_mises(stress).clamp_min(SMALLEST)


def _product(first: Float[Tensor, "#*batch 6"], second: Float[Tensor, "#*batch 6"]) -> Float[Tensor, "#*batch"]:
    normal = _differences(first) * _differences(second)
    shear = first[..., 3:] * second[..., 3:]
    return normal.sum(dim=-1) / 2 + 3 * shear.sum(dim=-1)


def _differences(stress: Float[Tensor, "*batch 6"]) -> Float[Tensor, "*batch 3"]:
    normal = stress[..., :3]
    return normal - torch.cat([normal[..., 1:], normal[..., :1]], dim=-1)
