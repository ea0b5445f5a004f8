"""scikit-learn: principal components and a Gaussian process for each of them."""

import numpy as np
from sklearn.decomposition import PCA
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

DOES = {"package": "scikit-learn", "anywhere": False, "reads": "activations"}
COMPONENTS = 10


def kernel():
    """A length for each muscle, and some noise; all are fitted. Lengths without a bound end at zero for weak modes."""
    return ConstantKernel() * Matern(np.ones(5), (0.3, 100.0), nu=2.5) + WhiteKernel(1e-5, (1e-10, 1e-1))


def fit(task):
    """A regressor for each component."""
    values = np.concatenate([task.position.reshape(len(task.position), -1), task.von_mises], axis=1)
    spread = np.concatenate([np.full(task.position[0].size, task.position.std(axis=0).mean()),
                             np.full(task.von_mises.shape[1], task.von_mises.std(axis=0).mean())])  # fmt: skip
    pca = PCA(min(COMPONENTS, len(values) - 1)).fit(values / spread)
    amounts = pca.transform(values / spread)
    scale = amounts.std(axis=0)
    processes = [
        GaussianProcessRegressor(kernel(), random_state=task.seed).fit(task.activation, amount)
        for amount in (amounts / scale).T
    ]

    def predict(activation):
        found = pca.inverse_transform(np.stack([own.predict(activation) for own in processes], axis=1) * scale) * spread
        nodes = len(task.reference)
        return {"position": found[:, : 3 * nodes].reshape(-1, nodes, 3), "von_mises": found[:, 3 * nodes :]}

    predict.numbers = int(pca.components_.size + pca.mean_.size + amounts.size)
    return predict
