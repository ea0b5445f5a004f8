"""Where a training runs: device, precision and processes, by Lightning Fabric.

Started by `torchrun` or by SLURM, a training is one of several processes that share every batch; otherwise it is alone.
Gradients are averaged over the processes (gloo on CPUs, NCCL on GPUs).
"""

import os
import warnings

import torch
from lightning_fabric import Fabric
from lightning_fabric.plugins.environments.cluster_environment import ClusterEnvironment
from lightning_fabric.plugins.environments.slurm import SLURMEnvironment
from lightning_fabric.plugins.environments.torchelastic import TorchElasticEnvironment
from lightning_fabric.strategies.ddp import DDPStrategy
from lightning_fabric.strategies.strategy import Strategy
from lightning_fabric.wrappers import _FabricModule, _FabricOptimizer
from torch import nn

from myograph.errors import InputError
from myograph.learning.training.config import Device, TrainingConfig


def start_fabric(config: TrainingConfig) -> Fabric:
    """Join the other processes, if there are any.

    Raises InputError for a GPU where there is none, and for a batch that the processes cannot share equally.
    """
    device = found_device(config.device)
    if config.precision == "16-mixed" and device == "cpu":
        raise InputError("precision: expected a GPU for '16-mixed', got the CPU; take 'bf16-mixed' or '32-true'")
    nodes, each = _asked_processes()
    if config.batch % (nodes * each):
        raise InputError(
            f"batch: expected a multiple of {nodes * each}, the number of processes, got {config.batch}; "
            "change the batch or the processes"
        )
    strategy = _distributed() if nodes * each > 1 else "auto"
    fabric = Fabric(accelerator=device, devices=each, num_nodes=nodes, strategy=strategy, precision=config.precision)
    fabric.launch()
    return fabric


def set_up(
    fabric: Fabric, module: nn.Module, optimiser: torch.optim.Optimizer
) -> tuple[_FabricModule, _FabricOptimizer]:
    """Both as Fabric wraps them, on the device."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="`broadcast_buffers` is deprecated")
        return fabric.setup(module, optimiser)


def rank() -> int:
    """Number of this process among those that train together; 0 where it is alone."""
    environment = _environment()
    return 0 if environment is None else environment.global_rank()


def found_device(asked: Device) -> str:
    """'cpu' or 'cuda'; raises InputError for a GPU where there is none."""
    if asked == "cuda" and not torch.cuda.is_available():
        raise InputError("device: expected a CUDA GPU, found none; take 'cpu' or 'auto'")
    return "cuda" if asked != "cpu" and torch.cuda.is_available() else "cpu"


def _distributed() -> Strategy:
    """All processes build the same module from the same seed: nothing is sent at the start, buffers never."""
    return DDPStrategy(find_unused_parameters=True, broadcast_buffers=False, init_sync=False)


def _asked_processes() -> tuple[int, int]:
    """Machines, and processes on each."""
    environment = _environment()
    if environment is None:
        return 1, 1
    size = environment.world_size()
    each = int(os.environ.get("LOCAL_WORLD_SIZE") or os.environ.get("SLURM_NTASKS_PER_NODE") or size)
    return size // each, each


def _environment() -> ClusterEnvironment | None:
    for kind in (TorchElasticEnvironment, SLURMEnvironment):
        if kind.detect():
            return kind()
    return None
