"""Writing a saved model: the folder is whole or not there."""

import hashlib
from collections.abc import Mapping
from pathlib import Path

from myograph.errors import InputError
from myograph.files import write_whole_folder
from myograph.inference.model_file import MODEL_FILE, FileRecord, ModelFile, model_text


def check_place(folder: Path) -> None:
    """Raise InputError where the folder is something else than a saved model: it would be lost."""
    if folder.exists() and not (folder / MODEL_FILE).is_file():
        raise InputError(f"{folder}: expected a saved model or nothing, got something else; choose another place")


def write_model(told: ModelFile, files: Mapping[str, bytes], folder: Path) -> ModelFile:
    """Write the files and model.json, which names their checksums; it replaces a saved model, and nothing else.

    Raises InputError where the folder is something else, or cannot be written.
    """
    check_place(folder)
    records = {
        name: FileRecord(size=len(data), sha256=hashlib.sha256(data).hexdigest()) for name, data in files.items()
    }
    told = told.model_copy(update={"files": records})

    def write(aside: Path) -> None:
        aside.mkdir()
        for name, data in files.items():
            (aside / name).write_bytes(data)
        (aside / MODEL_FILE).write_text(model_text(told), encoding="utf-8")

    write_whole_folder(folder, write)
    return told
