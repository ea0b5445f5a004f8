"""TOML files become frozen pydantic models; an unknown key is an error that names the near one.

Nothing is executed or unpickled; a file that is missing, is not TOML, or does not fit its model is an InputError with
the file's name, the key, what was expected and what was found.
"""

import difflib
import tomllib
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from myograph.errors import InputError


class Model(BaseModel):
    """Base of every configuration: frozen, and no unknown keys."""

    model_config = ConfigDict(extra="forbid", frozen=True)


M = TypeVar("M", bound=Model)


def read_toml(path: Path, model: type[M]) -> M:
    """Read the file at `path` into `model`; every mistake in it is an InputError of one line per key."""
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(f"{path}: expected a TOML file, found none there") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise InputError(f"{path}: not TOML: {problem}") from None
    except OSError as problem:
        raise InputError(f"{path}: cannot be read: {problem.strerror}") from None
    return parse(data, model, str(path))


def parse(data: dict[str, Any], model: type[M], source: str) -> M:
    """Fit `data` to `model`; `source` names the place in messages."""
    try:
        return model.model_validate(data)
    except ValidationError as problem:
        lines = [f"{source}: {_explain(error, model)}" for error in problem.errors()]
        raise InputError("\n".join(lines)) from None


def _explain(error: Any, model: type[Model]) -> str:
    key = ".".join(str(part) for part in error["loc"])
    if error["type"] == "extra_forbidden":
        near = difflib.get_close_matches(str(error["loc"][-1]), sorted(_names(model, set())), n=1)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        return f"unknown key '{key}'{hint}"
    return f"{key}: {error['msg']}, got {error['input']!r}"


def _names(model: type[BaseModel], seen: set[type]) -> set[str]:
    """All keys of the model and of the models inside it."""
    if model in seen:
        return set()
    seen.add(model)
    names = set(model.model_fields)
    for info in model.model_fields.values():
        for inner in _models_in(info.annotation):
            names |= _names(inner, seen)
    return names


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in getattr(annotation, "__args__", ()) for model in _models_in(argument)]
