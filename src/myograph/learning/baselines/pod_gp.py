"""Gaussian processes on POD coefficients as a method that learns: see `gp_module` for the formulas.

The lengths of the kernel, one for each muscle, its amplitude and its noise are those of the largest marginal likelihood
of the strongest mode; the other modes of the field share them. Modes come from all training cases.
Trap: with lengths from all modes alike, the many weak modes outweigh the one that carries most of the movement.
Exact processes cost the cube of the number of cases: of more than `most_cases`, those are drawn at random.
"""

import warnings
from dataclasses import dataclass, field
from typing import final

import numpy as np
import torch
from jaxtyping import Float
from scipy.linalg import solve_triangular
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Kernel, Matern, WhiteKernel

from myograph.ensemble.pairs.predictor import Progress
from myograph.ensemble.pairs.protocols import Split
from myograph.ensemble.pairs.sampler import PairSampler
from myograph.inference.signature import Signature
from myograph.learning.baselines.gp_module import FieldProcess, PodGpConfig, PodGpModule, PodGpShape
from myograph.learning.baselines.pod import Pod, pod_of
from myograph.learning.baselines.taught import taught
from myograph.learning.threads import on_one_thread
from myograph.learning.torch_predictor import TorchPredictor

LENGTHS, AMPLITUDES, NOISES = (0.05, 50.0), (1e-2, 1e4), (1e-8, 1e-1)
"""Bounds of the kernel's numbers; activations are from 0 to 1, coefficients over their spread about 1."""


@final
@dataclass(frozen=True)
class PodGp:
    """A `myograph.ensemble.pairs.predictor.Learner`: the method before it has seen data."""

    method: PodGpConfig = field(default_factory=PodGpConfig)
    name: str = "pod_gp"

    @on_one_thread
    def fit(self, sampler: PairSampler, split: Split, progress: Progress | None = None) -> TorchPredictor:
        """Modes and processes of the target cases of the training pairs."""
        told = taught(sampler, split)
        drawn = np.random.default_rng(self.method.seed).permutation(len(told))[: self.method.most_cases]
        activation = told.activation[drawn]
        processes = {}
        for name, values in told.fields.items():
            pod = pod_of(values, self.method.modes)
            coefficients = pod.coefficients[drawn] / pod.spread
            few = slice(self.method.kernel_cases)
            kernel = _kernel_of(activation[few], coefficients[few, 0])
            processes[name] = _process(kernel, activation, coefficients, pod)
        shape = PodGpShape(
            **self.method.model_dump(),
            fields=tuple(told.fields),
            muscles=activation.shape[1],
            cases=len(drawn),
            kept_modes=tuple(len(process.spread) for process in processes.values()),
            body_nodes=sampler.cases.nodes,
        )
        module = PodGpModule(shape)
        for name, process in processes.items():
            module.processes[name] = process
        signature = Signature(
            inputs=("activation", "query_nodes"), outputs=shape.outputs, convention=sampler.convention
        )
        return TorchPredictor(self.name, "pod_gp", module.eval(), signature, shape)


def _kernel_of(activation: Float[np.ndarray, "cases muscles"], coefficient: Float[np.ndarray, " cases"]) -> Kernel:
    """The kernel of the largest marginal likelihood; a length at its bound says that the muscle hardly matters."""
    first = Matern(np.ones(activation.shape[1]), LENGTHS, nu=1.5)  # type: ignore[arg-type]
    kernel = ConstantKernel(1.0, AMPLITUDES) * first + WhiteKernel(1e-4, NOISES)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)
        found = GaussianProcessRegressor(kernel).fit(activation, coefficient).kernel_
    assert isinstance(found, Kernel)
    return found


def _process(
    kernel: Kernel,
    activation: Float[np.ndarray, "cases muscles"],
    coefficients: Float[np.ndarray, "cases modes"],
    pod: Pod,
) -> FieldProcess:
    """The processes of one field, with this kernel, conditioned on the cases."""
    fitted = GaussianProcessRegressor(kernel, optimizer=None)  # type: ignore[arg-type]
    fitted.fit(activation, coefficients)
    told = kernel.get_params()
    process = FieldProcess(*activation.shape[::-1], *pod.modes.shape)
    values = {
        "lengths": told["k1__k2__length_scale"],
        "amplitude": told["k1__k1__constant_value"],
        "noise": told["k2__noise_level"],
        "weights": np.asarray(fitted.alpha_).reshape(coefficients.shape),
        "mean": pod.mean,
        "modes": pod.modes,
        "spread": pod.spread,
        "rest": pod.rest,
        "cases": activation,
        "inverse_root": solve_triangular(fitted.L_, np.eye(len(activation)), lower=True),
    }
    process.load_state_dict({name: torch.as_tensor(np.asarray(array)) for name, array in values.items()})
    return process
