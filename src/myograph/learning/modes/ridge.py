r"""Amounts of the modes straight from sensors: ridge least squares, for any sensors in any number.

    minimise  |r - Φ c|² / σ² + sum_k (c_k / s_k)²

r is what sensors show beyond a first guess [mm], σ their noise, s_k how large the amounts were in training. With
A = Φ diag(s) / σ this is (AᵀA + I) (c/s) = Aᵀ r/σ: a symmetric matrix no smaller than the identity, eliminated without
pivots in double precision.
"""

import torch
from jaxtyping import Float, Float64
from torch import Tensor


def ridge_amounts(
    missed: Float[Tensor, "batch values"],
    modes: Float[Tensor, "values modes"],
    spread: Float[Tensor, " modes"],
    noise: float,
) -> Float[Tensor, "batch modes"]:
    """c; zero where there is no sensor."""
    scaled = (modes * spread / noise).double()
    normal = scaled.T @ scaled + torch.eye(scaled.shape[1], dtype=torch.float64, device=scaled.device)
    solved = eliminate(normal, scaled.T @ (missed.double() / noise).T)
    return (spread.double()[:, None] * solved).T.to(missed.dtype)


def eliminate(
    matrix: Float64[Tensor, "rows rows"], right: Float64[Tensor, "rows columns"]
) -> Float64[Tensor, "rows columns"]:
    """X of matrix X = right, for a symmetric positive definite matrix, in operations that ONNX has (Gauss-Jordan).

    Trap: a row that is divided by taking away all but one part of its pivot loses as many digits as the pivot has.
    """
    both, units = torch.cat([matrix, right], dim=1), torch.eye(matrix.shape[0], dtype=matrix.dtype)
    for row, unit in enumerate(units.to(matrix.device).unbind()):
        own, divided = unit[:, None], both[row : row + 1] / both[row, row]
        both = own * divided + (1 - own) * (both - both[:, row : row + 1] * divided)
    return both[:, matrix.shape[1] :]
