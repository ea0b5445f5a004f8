"""An ensemble as a TOML file: which arm answers which cases, and how they are run. docs/ensembles.md has an example."""

from pathlib import Path

from pydantic import Field

from myograph.case import MUSCLES
from myograph.config import Model, read_toml
from myograph.ensemble.design import DesignSpec


class RunConfig(Model):
    """How to run; none of it changes what is computed."""

    workers: int | None = Field(default=None, ge=1)
    time_limit_s: float | None = Field(default=None, gt=0, allow_inf_nan=False)


class EnsembleConfig(Model):
    """Which arm answers which cases.

    `simulator` is 'table', 'direct' or 'package.module:function'; `muscles` are those whose fields are stored;
    `arm` is a TOML file, without it the built-in left arm; `tables` is the folder of the arm's tables.
    """

    simulator: str = "table"
    preset: str = "quick"
    muscles: tuple[str, ...] = MUSCLES
    arm: Path | None = None
    tables: Path | None = None
    gravity: bool = True
    design: tuple[DesignSpec, ...] = (DesignSpec(),)
    run: RunConfig = RunConfig()


def read_config(path: Path) -> EnsembleConfig:
    """The ensemble of a file; paths in it are relative to its folder. Raises InputError with file and key."""
    config = read_toml(path, EnsembleConfig)
    design = [_beside(path, spec) for spec in config.design]
    found = {name: path.parent / value for name in ("arm", "tables") if (value := getattr(config, name)) is not None}
    return config.model_copy(update={"design": tuple(design), **found})


def _beside(path: Path, spec: DesignSpec) -> DesignSpec:
    return spec if spec.file is None else spec.model_copy(update={"file": path.parent / spec.file})
