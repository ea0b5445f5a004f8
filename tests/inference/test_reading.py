"""A saved model that is not whole, not itself, or not sound is refused; nothing is unpickled."""

import hashlib
import io
import json
import os
import pickle
import shutil
import subprocess
import sys

import numpy as np
import onnx
import onnx.helper
import onnx.numpy_helper
import onnx.parser
import pytest

from myograph.errors import InputError
from myograph.inference.body_file import body_bytes, body_of
from myograph.inference.loaded import load
from myograph.inference.model_file import BODY, CARD, MODEL_FILE, MOST_BYTES, NETWORK, WEIGHTS
from myograph.inference.session import open_session
from myograph.inference.writing import write_model
from tests.inference.stand_in import (
    FROM_ACTIVATION,
    FROM_SENSORS,
    LINEAR,
    files,
    network,
    save_linear,
    stand_in_body,
    told,
)


@pytest.fixture
def folder(saved, tmp_path):
    shutil.copytree(saved / "linear", tmp_path / "copy")
    return tmp_path / "copy"


def test_what_was_said_is_what_is_read(linear, tmp_path):
    assert load_again(linear.told, tmp_path).told.model_dump() == linear.told.model_dump()


def load_again(said, tmp_path):
    write_model(said, files(FROM_ACTIVATION), tmp_path / "again")
    return load(tmp_path / "again")


@pytest.mark.parametrize("name", [MODEL_FILE, NETWORK, BODY, CARD])
def test_a_missing_file_is_named(folder, name):
    (folder / name).unlink()
    with pytest.raises(InputError, match=name):
        load(folder)


@pytest.mark.parametrize("name", [NETWORK, BODY, CARD])
def test_a_truncated_file_is_refused(folder, name):
    data = (folder / name).read_bytes()
    (folder / name).write_bytes(data[:-1])
    with pytest.raises(InputError, match=rf"{name}: expected a file of {len(data)} bytes, got {len(data) - 1}"):
        load(folder)


@pytest.mark.parametrize("name", [NETWORK, BODY, CARD])
def test_an_altered_file_is_refused(folder, name):
    data = bytearray((folder / name).read_bytes())
    data[len(data) // 2] ^= 1
    (folder / name).write_bytes(data)
    with pytest.raises(InputError, match=rf"{name}: expected SHA-256 .* it was altered"):
        load(folder)


def test_a_file_that_is_too_large_is_not_read(folder, monkeypatch):
    monkeypatch.setitem(MOST_BYTES, NETWORK, 10)
    with pytest.raises(InputError, match="expected a file of at most 10 bytes"):
        load(folder)


def _say(folder, change):
    """Change what model.json says, and its checksum with it."""
    whole = json.loads((folder / MODEL_FILE).read_text())
    change(whole["model"])
    whole["sha256"] = hashlib.sha256(json.dumps(whole["model"], sort_keys=True).encode()).hexdigest()
    (folder / MODEL_FILE).write_text(json.dumps(whole))


def _rename(model, old, new):
    model["files"][new] = model["files"].pop(old)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda m: m.update(schema_version=2), "expected schema version 1, got 2"),
        (lambda m: m.update(muscle="calf"), "unknown muscle 'calf'"),
        (lambda m: m.update(shape="round"), "unknown key 'shape'"),
        (lambda m: m.update(parity=float("nan")), "parity"),
        (lambda m: m["fields"].update(position="m"), "fields: expected"),
        (lambda m: m.update(half_width_90={"pressure": 1.0}), "half_width_90: expected some of"),
        (lambda m: m.update(half_width_90_from={"sensors": {"pressure": 1.0}}), "got pressure"),
        (lambda m: m.update(half_width_90_from={"guessing": {}}), "half_width_90_from"),
        (lambda m: m["signature"].update(inputs=["shoe_size"]), "unknown input 'shoe_size'"),
        (lambda m: m["signature"].update(inputs=["sensor_taste_initial"]), "unknown input 'sensor_taste_initial'"),
        (lambda m: m["signature"].update(outputs=["taste"]), "unknown output 'taste'"),
        (lambda m: m["signature"].update(inputs=["query_places", "activation"]), "expected the inputs and outputs"),
        (lambda m: m["signature"].update(inputs=["activation", "query_von_mises_initial"]), "at rest of von_mises"),
        (lambda m: m["signature"].update(sensors=[40]), "expected sensors among 40 nodes"),
        (lambda m: _rename(m, NETWORK, "../model.onnx"), r"files: expected .* got .*\.\./model\.onnx"),
        (lambda m: m["files"].pop(WEIGHTS), "files: expected"),
    ],
)
def test_what_model_json_may_not_say_is_refused(folder, change, message):
    _say(folder, change)
    with pytest.raises(InputError, match=message):
        load(folder)


def test_a_model_of_before_single_ways_had_widths_is_read(folder):
    _say(folder, lambda m: m.pop("half_width_90_from"))
    assert load(folder).told.half_width_90_from == {}


def test_an_altered_model_json_is_refused(folder):
    text = (folder / MODEL_FILE).read_text()
    (folder / MODEL_FILE).write_text(text.replace('"seed": 0', '"seed": 1'))
    with pytest.raises(InputError, match="does not match its own checksum"):
        load(folder)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"model": 1, "sha256": ""}', "[" * 100_000, "\x80"])
def test_what_is_no_model_json_is_refused(folder, text):
    (folder / MODEL_FILE).write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError, match="not a saved model"):
        load(folder)


def test_a_model_json_that_is_too_large_is_not_read(folder):
    (folder / MODEL_FILE).write_bytes(b" " * (2**20 + 1))
    with pytest.raises(InputError, match="expected at most 1048576 bytes"):
        load(folder)


def test_a_place_without_a_model_is_refused(tmp_path):
    with pytest.raises(InputError, match="expected the folder of a saved model, found nothing there"):
        load(str(tmp_path / "nothing"))
    for folder in (tmp_path, tmp_path / "nothing"):
        with pytest.raises(InputError, match=r"found no model\.json there"):
            load(folder)


def _body(change):
    with np.load(io.BytesIO(body_bytes(stand_in_body()))) as arrays:
        found = dict(arrays)
    change(found)
    file = io.BytesIO()
    np.savez_compressed(file, **found)
    return file.getvalue()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda b: b.pop("reference"), "reference: expected"),
        (lambda b: b.pop("low"), "low: expected an array, found none"),
        (lambda b: b.update(low=b["low"][1:]), r"low: expected shape \(40, 3\)"),
        (lambda b: b.update(high=b["high"].astype(int)), "high: expected shape"),
        (lambda b: b.update(rest_position=b["low"] * np.nan), "rest_position: expected finite"),
        (lambda b: b.update(cells=b["cells"] + 1), "cells: expected nodes from 0 to 39"),
        (lambda b: b.update(rest_taste=b["low"]), "unknown array 'rest_taste'"),
        (lambda b: b.update(hair=b["low"]), "unknown array 'hair'"),
        (lambda b: b.update(low=np.array([None])), "not a file of plain arrays"),
    ],
)
def test_a_body_that_does_not_fit_itself_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        body_of(_body(change), "body.npz")


def test_a_body_that_unpacks_to_too_much_is_not_read(monkeypatch):
    monkeypatch.setattr("myograph.inference.body_file.MOST_UNPACKED", 1000)
    with pytest.raises(InputError, match="expected at most 1000 bytes of arrays"):
        body_of(body_bytes(stand_in_body()), "body.npz")


def test_nothing_is_unpickled():
    with pytest.raises(InputError, match="not a file of plain arrays"):
        body_of(pickle.dumps({"reference": 1}), "body.npz")


@pytest.mark.skipif(os.name == "nt", reason="needs named pipes")
def test_a_model_is_no_pipe_and_no_device(folder):
    (folder / MODEL_FILE).unlink()
    os.mkfifo(folder / MODEL_FILE)
    with pytest.raises(InputError, match="expected a plain file"):
        load(folder)


def test_a_body_without_nodes_is_refused():
    arrays = dict.fromkeys(("reference", "low", "high", "rest_position"), np.zeros((0, 3), dtype=np.float32))
    file = io.BytesIO()
    np.savez(file, **arrays, skin=np.zeros((0, 4), dtype=np.int32), cells=np.zeros((0, 8), dtype=np.int32))
    with pytest.raises(InputError, match="expected a body of nodes, got none"):
        body_of(file.getvalue(), "body.npz")


@pytest.mark.parametrize(
    ("change", "words"), [({"name": "a\x1b[2J"}, "name"), ({"half_width_90": {"position": -3.0}}, "half_width_90")]
)
def test_what_a_model_says_of_itself_can_be_shown_and_be(linear, tmp_path, change, words):
    with pytest.raises(InputError, match=words):
        load_again(linear.told.model_copy(update=change), tmp_path)


def test_a_network_may_have_names_with_any_word_in_them():
    weights = FROM_ACTIVATION.replace("stretch", "location_of_stretch")
    assert open_session(network(weights), LINEAR, 1, "model.onnx") is not None


def test_a_network_that_names_other_files_in_another_writing_is_refused(tmp_path):
    """The length of a key may be written in more bytes than it needs."""
    tensor = onnx.TensorProto(name="w", dims=[1], data_type=1, data_location=onnx.TensorProto.EXTERNAL)
    tensor.external_data.add(key="location", value="secret")
    written = onnx.helper.make_model(onnx.helper.make_graph([], "g", [], [], [tensor])).SerializeToString()
    longer = written.replace(b"\n\x08location", b"\n\x88\x00location")
    assert longer != written
    with pytest.raises(InputError, match="names other files"):
        open_session(longer, LINEAR, 1, "model.onnx")


def test_a_network_that_names_other_files_is_refused(tmp_path):
    model = onnx.parser.parse_model(FROM_ACTIVATION)
    for number, tensor in enumerate(model.graph.initializer):
        raw = onnx.numpy_helper.from_array(onnx.numpy_helper.to_array(tensor), tensor.name)
        model.graph.initializer[number].CopyFrom(raw)
    onnx.save(model, tmp_path / "m.onnx", save_as_external_data=True, size_threshold=0, location="weights")
    with pytest.raises(InputError, match="names other files"):
        open_session((tmp_path / "m.onnx").read_bytes(), LINEAR, 1, "model.onnx")


def test_bytes_that_are_no_network_are_refused():
    with pytest.raises(InputError, match="not a network that onnxruntime can run"):
        open_session(b"network", LINEAR, 1, "model.onnx")


def test_a_network_of_another_signature_is_refused():
    with pytest.raises(InputError, match="expected the inputs and outputs"):
        open_session(network(FROM_SENSORS), LINEAR, 1, "model.onnx")


def test_a_saved_model_takes_the_place_of_a_saved_model_only(tmp_path):
    save_linear(tmp_path / "model", parameters=1)
    save_linear(tmp_path / "model", parameters=2)
    assert load(tmp_path / "model").told.parameters == 2
    (tmp_path / "thesis").mkdir()
    with pytest.raises(InputError, match="expected a saved model or nothing"):
        save_linear(tmp_path / "thesis")


def test_a_folder_that_cannot_be_written_leaves_nothing(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        write_model(told("linear", LINEAR), files(FROM_ACTIVATION), tmp_path / "file" / "model")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


BLOCKED = """
import sys
for name in ("torch", "onnx", "safetensors", "ngsolve", "dask", "distributed", "matplotlib"):
    sys.modules[name] = None
import myograph
model = myograph.load(sys.argv[1])
print(model.predict_activation([0, 0, 1, 0, 0]).values["position"].shape)
"""


def test_a_model_answers_where_torch_is_not_installed(saved):
    done = subprocess.run([sys.executable, "-c", BLOCKED, str(saved / "linear")], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("(1, 40, 3)\n", "")
