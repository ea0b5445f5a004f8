"""The network of a saved model in onnxruntime."""

import re
from collections.abc import Mapping

import numpy as np
import onnxruntime

from myograph.errors import InputError
from myograph.inference.signature import Signature

_OUTSIDE = re.compile(rb"(?:\x0a|\x8a\x80*\x00)(?:\x08|\x88\x80*\x00)location")
"""The key by which a tensor says that its numbers lie in another file, its tag and length in any writing of numbers."""


def open_session(data: bytes, signature: Signature, threads: int, source: str) -> onnxruntime.InferenceSession:
    """Make the network ready to run on that many threads of the processor.

    Raises InputError for bytes that are no network, or one with other inputs and outputs than the signature's.
    """
    if _OUTSIDE.search(data):
        raise InputError(f"{source}: expected a network with its weights inside, got one that names other files")
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.inter_op_num_threads = 1
    options.log_severity_level = 4
    try:
        session = onnxruntime.InferenceSession(data, options, providers=["CPUExecutionProvider"])
    except Exception as problem:
        raise InputError(f"{source}: not a network that onnxruntime can run: {problem}") from None
    found = [item.name for item in session.get_inputs()], [item.name for item in session.get_outputs()]
    wanted = list(signature.inputs), list(signature.outputs)
    if found != wanted:
        raise InputError(f"{source}: expected the inputs and outputs {wanted}, got {found}")
    return session


def run_session(
    session: onnxruntime.InferenceSession, given: Mapping[str, np.ndarray], outputs: tuple[str, ...]
) -> dict[str, np.ndarray]:
    """Outputs by name; raises InputError for inputs that the network cannot take."""
    try:
        results = session.run(list(outputs), dict(given))
    except Exception as problem:
        shapes = {name: array.shape for name, array in given.items()}
        raise InputError(f"the network does not take inputs of the shapes {shapes}: {problem}") from None
    return {name: np.asarray(result) for name, result in zip(outputs, results, strict=True)}
