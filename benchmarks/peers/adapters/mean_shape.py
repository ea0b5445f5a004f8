"""What knowing nothing gives: the mean of the positions and stresses that teach."""

import numpy as np

DOES = {"package": "numpy", "anywhere": False, "reads": "nothing"}


def fit(task):
    """The same answer to all."""
    mean = {"position": task.position.mean(axis=0), "von_mises": task.von_mises.mean(axis=0)}

    def predict(activation):
        return {name: np.repeat(values[None], len(activation), axis=0) for name, values in mean.items()}

    predict.numbers = sum(values.size for values in mean.values())
    return predict
