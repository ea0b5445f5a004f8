"""How long one answer takes: one forward pass for all nodes, on as many threads as the model was loaded with."""

import numpy as np
from jaxtyping import Float

from myograph.inference.at_rest import question_at_rest
from myograph.inference.feeds import feeds
from myograph.inference.loaded import LoadedModel
from myograph.inference.session import run_session
from myograph.timing import call_times


def forward_milliseconds(model: LoadedModel, repeats: int = 30) -> float:
    """Median over the repeats of the time of one pass of the network for all nodes of one case, at rest [ms]."""
    return float(np.median(forward_times(model, repeats)))


def forward_times(model: LoadedModel, repeats: int) -> Float[np.ndarray, " repeats"]:
    """Each of these times [ms]."""
    signature = model.told.signature
    question = question_at_rest(model, np.array([model.told.trained_range.activation_low]))
    given = feeds(question, signature.inputs)
    return call_times(lambda: run_session(model.session, given, signature.outputs), repeats)
