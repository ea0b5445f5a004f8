"""Finite elements and networks in one process."""

import subprocess
import sys

import pytest

PROGRAM = """
import ngsolve
import myograph.learning
import torch
products = torch.einsum("bsn,bsk->nbk", torch.ones(8, 9, 8), torch.ones(8, 9, 32))
assert products.eq(9).all()
"""


def test_torch_multiplies_in_a_process_that_has_loaded_ngsolve():
    """Without care it takes batched products from NGSolve's OpenBLAS and crashes."""
    pytest.importorskip("ngsolve", reason="needs NGSolve")
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
