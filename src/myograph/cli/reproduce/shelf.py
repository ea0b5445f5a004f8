"""Finished sections in the output folder: rows and pictures, each written whole, made again where something changed.

reproduce.json          preset, format and version of the folder
sections/NAME/          section.json (key, rows, seconds, provenance, captions), 0.png, 1.png, ...
results.json            rows of all sections: what `docs/write_results.py` reads
report.html
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import myograph
from myograph.cli.reproduce.cache import FORMAT
from myograph.cli.reproduce.registry import EXPERIMENTS
from myograph.cli.reproduce.sizes import reproduction_size
from myograph.errors import InputError
from myograph.evaluation import Figure
from myograph.evaluation.experiments.page import Made
from myograph.files import sweep, write_whole, write_whole_folder

MARK, RESULTS, REPORT = "reproduce.json", "results.json", "report.html"


@dataclass(frozen=True)
class Shelf:
    """The output folder of a preset."""

    out: Path
    preset: str

    def prepare(self) -> None:
        """Make the folder ours, without what killed runs left half-written.

        Raises InputError for a folder of another preset, and where nothing can be written.
        """
        told = {"preset": self.preset, "format": FORMAT, "myograph": myograph.__version__}
        found = _read(self.out / MARK)
        if found is not None and found.get("preset") != self.preset:
            raise InputError(
                f"{self.out}: expected a folder of preset '{self.preset}', got one of '{found.get('preset')}'; "
                "choose another --out"
            )
        if found is None and self.out.is_dir() and any(not path.name.startswith(".") for path in self.out.iterdir()):
            raise InputError(f"{self.out}: expected a new folder or one of 'myograph reproduce'; choose another --out")
        if found != told:
            write_whole(self.out / MARK, lambda file: file.write(json.dumps(told).encode()))
        sweep(self.out, MARK, RESULTS, REPORT)
        sweep(self.out / "sections", *EXPERIMENTS)

    def get(self, name: str, key: str | None = None) -> Made | None:
        """A finished section, of this key if one is given; None where there is none of this version and these sizes."""
        folder = self.out / "sections" / name
        told = _read(folder / "section.json")
        if told is None or told.get("version") != self._version() or key not in (None, told.get("key")):
            return None
        try:
            figures = [
                Figure(own["caption"], (folder / f"{place}.png").read_bytes(), own["alt"])
                for place, own in enumerate(told["figures"])
            ]
        except (OSError, InputError):
            return None
        return Made(told["rows"], figures, told["seconds"], told["provenance"])

    def put(self, name: str, key: str, made: Made) -> None:
        """Keep a finished section."""
        captions = [{"caption": figure.caption, "alt": figure.alt} for figure in made.figures]
        told = {"version": self._version(), "key": key, "rows": list(made.rows), "seconds": made.seconds}
        told |= {"provenance": dict(made.provenance), "figures": captions}

        def write(folder: Path) -> None:
            folder.mkdir()
            (folder / "section.json").write_text(json.dumps(told, indent=1), encoding="utf-8")
            for place, figure in enumerate(made.figures):
                (folder / f"{place}.png").write_bytes(figure.png)

        write_whole_folder(self.out / "sections" / name, write)

    def all(self, run: Mapping[str, str]) -> dict[str, Made]:
        """All finished sections, in the order of the report; of their provenance what is not that of the run."""
        found = {name: made for name in EXPERIMENTS if (made := self.get(name)) is not None}
        return {name: replace(made, provenance=_beside(made.provenance, run)) for name, made in found.items()}

    def write_results(self, provenance: Mapping[str, str]) -> None:
        """Write the rows of all finished sections, and the provenance of the run."""
        sections = {
            name: {"rows": list(made.rows), "seconds": made.seconds, "provenance": dict(made.provenance)}
            for name, made in self.all(provenance).items()
        }
        told = {"preset": self.preset, "provenance": dict(provenance), "sections": sections}
        text = json.dumps(told, indent=1) + "\n"
        write_whole(self.out / RESULTS, lambda file: file.write(text.encode()))

    def _version(self) -> list[Any]:
        return [FORMAT, myograph.__version__, reproduction_size(self.preset).checksum]


def _beside(own: Mapping[str, str], run: Mapping[str, str]) -> dict[str, str]:
    return {key: value for key, value in own.items() if run.get(key) != value}


def _read(path: Path) -> dict[str, Any] | None:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) else None
