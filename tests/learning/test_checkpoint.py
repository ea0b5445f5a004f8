"""Saved models: what comes back is what went, and a file that was touched is refused."""

import hashlib
import json

import numpy as np
import pytest

from myograph.errors import InputError
from myograph.learning.checkpoint import load_gen, save_gen
from myograph.learning.config import NetworkConfig, TrainingConfig
from myograph.learning.training import train_gen


@pytest.fixture
def folder(gen_8, tmp_path):
    save_gen(gen_8, tmp_path / "model")
    return tmp_path / "model"


def rewrite(folder, change):
    """Change model.json and give it a checksum that fits."""
    model = json.loads((folder / "model.json").read_text())["model"]
    change(model)
    checksum = hashlib.sha256(json.dumps(model, sort_keys=True).encode()).hexdigest()
    (folder / "model.json").write_text(json.dumps({"model": model, "sha256": checksum}))


def test_a_loaded_model_answers_exactly_as_the_saved_one(gen_8, folder, sampler, strict):
    loaded, batch = load_gen(folder), sampler.batch(strict.test)
    np.testing.assert_array_equal(
        loaded.predict(batch.sensors, batch.queries), gen_8.predict(batch.sensors, batch.queries)
    )


def test_a_loaded_graph_is_joined_where_its_nodes_were_in_the_end(sampler, strict, tmp_path):
    far = TrainingConfig(steps=5, batch=2, queries=16, node_learning_rate=0.1)
    moved = train_gen(sampler, strict, NetworkConfig(nodes_per_axis=3), far)
    save_gen(moved, tmp_path / "moved")
    loaded = load_gen(tmp_path / "moved")
    assert (loaded.network.adjacency.to_dense() == moved.network.adjacency.to_dense()).all()


def test_a_loaded_model_knows_where_it_comes_from(gen_8, folder):
    loaded = load_gen(folder)
    assert (loaded.source, loaded.protocol, loaded.scaling) == (gen_8.source, "strict", gen_8.scaling)
    assert (loaded.record.config, loaded.record.seconds) == (gen_8.record.config, gen_8.record.seconds)
    np.testing.assert_array_equal(loaded.sensors, gen_8.sensors)
    for name in ("rmse", "nodes_before", "nodes_after"):
        np.testing.assert_array_equal(getattr(loaded.record, name), getattr(gen_8.record, name))


def test_saving_again_replaces_the_model_and_leaves_nothing_beside_it(gen_8, folder):
    (folder / "old").touch()
    save_gen(gen_8, folder)
    assert sorted(path.name for path in folder.iterdir()) == ["history.npz", "model.json", "weights.npz"]
    assert [path.name for path in folder.parent.iterdir()] == ["model"]


def test_a_folder_that_is_no_saved_model_is_not_replaced(gen_8, tmp_path):
    (tmp_path / "thesis.txt").touch()
    with pytest.raises(InputError, match="expected a saved model or nothing"):
        save_gen(gen_8, tmp_path)
    assert (tmp_path / "thesis.txt").exists()


def test_a_place_that_cannot_be_written_is_an_input_error(gen_8, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="cannot be written"):
        save_gen(gen_8, tmp_path / "file" / "model")


@pytest.mark.parametrize("name", ["weights.npz", "history.npz"])
@pytest.mark.parametrize("spoil", [lambda data: data[:-20], lambda data: data[:500] + b"?" + data[501:]])
def test_a_truncated_or_altered_file_is_an_input_error(folder, name, spoil):
    path = folder / name
    path.write_bytes(spoil(path.read_bytes()))
    with pytest.raises(InputError, match=f"{name}: expected SHA-256 .* truncated or altered"):
        load_gen(folder)


def test_an_altered_number_in_model_json_is_an_input_error(folder):
    path = folder / "model.json"
    path.write_text(path.read_text().replace('"latent": 32', '"latent": 16'))
    with pytest.raises(InputError, match="does not match its own checksum"):
        load_gen(folder)


def test_weights_of_another_shape_are_an_input_error(folder):
    rewrite(folder, lambda model: model["network"].update(latent=16))
    with pytest.raises(InputError, match="does not fit"):
        load_gen(folder)


def test_an_unknown_key_is_an_input_error_that_names_the_near_one(folder):
    rewrite(folder, lambda model: model["network"].update(latend=16))
    with pytest.raises(InputError, match=r"'network\.latend'; did you mean 'latent'"):
        load_gen(folder)


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"model": {}}'])
def test_a_model_json_that_is_none_is_an_input_error(folder, text):
    (folder / "model.json").write_text(text)
    with pytest.raises(InputError, match="not a saved model"):
        load_gen(folder)


def test_a_folder_without_model_json_is_an_input_error(tmp_path):
    with pytest.raises(InputError, match="found no model"):
        load_gen(tmp_path)


def test_a_missing_file_is_an_input_error(folder):
    (folder / "weights.npz").unlink()
    with pytest.raises(InputError, match="cannot be read"):
        load_gen(folder)


@pytest.mark.parametrize("content", ["pickle", "text"])
def test_nothing_is_ever_unpickled(folder, content):
    path = folder / "weights.npz"
    if content == "pickle":
        np.savez(path, nodes=np.array([{}], dtype=object))
    else:
        path.write_bytes(b"PK\x03\x04 but no archive")
    rewrite(folder, lambda model: model["checksums"].update({path.name: hashlib.sha256(path.read_bytes()).hexdigest()}))
    with pytest.raises(InputError, match="not a file of plain arrays"):
        load_gen(folder)
