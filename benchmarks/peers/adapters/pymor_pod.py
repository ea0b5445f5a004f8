"""pyMOR: its data-driven reductor, POD of the snapshots and greedy kernel interpolation (VKOGA) of their coefficients.

All with pyMOR's own defaults: of these, twenty centres at most.
"""

import numpy as np
from pymor.algorithms.ml.vkoga.regressor import VKOGARegressor
from pymor.core.logger import set_log_levels
from pymor.parameters.base import Parameters
from pymor.reductors.data_driven import DataDrivenPODReductor
from pymor.vectorarrays.numpy import NumpyVectorSpace

DOES = {"package": "pymor", "anywhere": False, "reads": "activations"}
RANK, CENTRES = 20, 20


def fit(task):
    """A reduced model of each field, of what is left of its mean."""
    set_log_levels({"pymor": "ERROR"})
    parameters, nodes = Parameters(activation=task.activation.shape[1]), len(task.reference)
    told = [parameters.parse(row) for row in task.activation.astype(float)]
    models = {}
    for name, values in (("position", task.position), ("von_mises", task.von_mises)):
        snapshots = values.reshape(len(values), -1).astype(float)
        mean = snapshots.mean(axis=0)
        space = NumpyVectorSpace(snapshots.shape[1])
        regressor = VKOGARegressor()
        reductor = DataDrivenPODReductor(
            told, space.from_numpy((snapshots - mean).T), regressor=regressor, pod_params={"modes": RANK}
        )
        models[name] = (reductor, reductor.reduce(), mean)

    def predict(activation):
        found = {}
        for name, (reductor, reduced, mean) in models.items():
            rows = [reduced.solve(parameters.parse(row)) for row in activation.astype(float)]
            found[name] = np.array([reductor.reconstruct(row).to_numpy().ravel() for row in rows]) + mean
        return {"position": found["position"].reshape(-1, nodes, 3), "von_mises": found["von_mises"]}

    predict.numbers = 4 * nodes * (RANK + 1) + 2 * (RANK + task.activation.shape[1]) * CENTRES
    return predict
