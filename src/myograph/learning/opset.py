"""The network of a saved model in another operator set of ONNX, for runtimes that know only older ones."""

from myograph.errors import InputError


def with_opset(network: bytes, opset: int) -> bytes:
    """The same network in that operator set; raises InputError where an operator does not exist there."""
    import onnx
    import onnx.checker
    import onnx.version_converter

    model = onnx.load_from_string(network)
    found = {item.domain: item.version for item in model.opset_import}
    if found.get("", opset) == opset:
        return network
    try:
        converted = onnx.version_converter.convert_version(model, opset)
        onnx.checker.check_model(converted)
    except Exception as problem:
        raise InputError(
            f"opset: expected one that this network can be written in, got {opset} (it has {found['']}): {problem}"
        ) from None
    return converted.SerializeToString()
