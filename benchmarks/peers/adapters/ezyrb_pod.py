"""What both methods of EZyRB share: a reduced-order model of each field, with EZyRB's own defaults."""

import numpy as np
from ezyrb import POD, Database, ReducedOrderModel

DOES = {"package": "ezyrb", "anywhere": False, "reads": "activations"}
RANK = 20


def pod(task, approximation):
    """Predicts both fields; modes of the snapshots as they are."""
    nodes = len(task.reference)
    models = {}
    for name, values in (("position", task.position), ("von_mises", task.von_mises)):
        snapshots = values.reshape(len(values), -1).astype(float)
        database = Database(task.activation, snapshots)
        models[name] = ReducedOrderModel(database, POD("svd", rank=RANK), approximation()).fit()

    def predict(activation):
        found = {name: _snapshots(model.predict(activation)) for name, model in models.items()}
        return {"position": found["position"].reshape(-1, nodes, 3), "von_mises": found["von_mises"]}

    predict.numbers = 4 * nodes * RANK + 2 * RANK * len(task.activation)
    return predict


def _snapshots(predicted):
    values = getattr(predicted, "snapshots_matrix", predicted)
    return np.atleast_2d(np.asarray(values))
