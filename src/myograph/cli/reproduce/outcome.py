"""What a section's trials found, by row."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float

from myograph.cli.reproduce.cache import Found
from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.sizes import Size
from myograph.cli.reproduce.trial import Trial
from myograph.cli.reproduce.weighing import lacks_c
from myograph.ensemble.pairs.protocols import PROTOCOLS, Protocol
from myograph.evaluation import ErrorSummary, Figure
from myograph.evaluation.page import duration

Row = dict[str, Any]
DIGITS = 4
SPREAD = ("mean_mm", "skin_mean_mm", "von_mises_mean_mpa")
"""Figures whose spread over the seeds is told, and their value for each seed."""
MEASURED = ("seconds", "predict_ms", "weights_kb", "onnx_kb", "onnx_ms", "c_kb", "c_int8_kb", "c_ms")
"""Of a method, whatever the protocol."""


@dataclass(frozen=True)
class Outcome:
    """Trials and what came of each; a trial that could not be made has a reason in their place.

    Parameters
    ----------
    found
        As `trials`; None where there is a reason.
    left_out
        Name of a row -> why it is not there.
    before
        How many different trials had been made before.
    """

    data: Data
    size: Size
    trials: Sequence[Trial]
    found: Sequence[Found | None]
    left_out: Mapping[str, str]
    before: int = 0

    @property
    def names(self) -> list[str]:
        """Of the rows, in order."""
        return list(dict.fromkeys(trial.name for trial in self.trials))

    @property
    def seconds(self) -> float:
        """Processor time of all trainings [s], without those that were interrupted."""
        return sum(found.told.get("seconds", 0.0) for found in self.found if found is not None)

    def taken(self, seconds: float) -> str:
        """Of this time, what it was spent on."""
        return f"{duration(seconds)}, {self.before} trials made before" if self.before else duration(seconds)

    def of(self, name: str, protocol: Protocol) -> list[Found]:
        """What was found under a protocol, a seed each."""
        pairs = zip(self.trials, self.found, strict=True)
        return [found for trial, found in pairs if found and trial.name == name and protocol in trial.tested]

    def mean(self, name: str, protocol: Protocol, figure: str = "mean_mm") -> float:
        """Of a figure over the seeds; NaN where there is none."""
        values = [found.told["protocols"][protocol].get(figure, np.nan) for found in self.of(name, protocol)]
        return float(np.mean(values)) if values else float("nan")

    def values(
        self, names: Sequence[str], protocol: Protocol, figure: str = "mean_mm"
    ) -> tuple[Float[np.ndarray, " rows"], Float[np.ndarray, " rows"]]:
        """Means and sample standard deviations over the seeds, of several rows; 0 where a seed is alone."""
        each = [[f.told["protocols"][protocol].get(figure, np.nan) for f in self.of(name, protocol)] for name in names]
        return np.array([np.mean(own) for own in each]), np.array([_deviation(own) for own in each])

    def array(self, name: str, protocol: Protocol, which: str) -> np.ndarray | None:
        """An array of the first seed, its name before the protocol; None where there is none."""
        found = self.of(name, protocol)
        return found[0].arrays.get(which) if found else None

    def summaries(self) -> dict[str, dict[str, ErrorSummary]]:
        """Row -> protocol -> the figures that bars are drawn of."""
        keys = ("mean_mm", "rmse_mm", "p95_mm", "max_mm")
        return {
            name: {
                protocol: ErrorSummary(**{key: self.mean(name, protocol, key) for key in keys})
                for protocol in PROTOCOLS
                if np.isfinite(self.mean(name, protocol))
            }
            for name in self.names
        }


Figures = Callable[[Outcome], tuple[Figure, ...]]


def table_rows(outcome: Outcome) -> list[Row]:
    """A row for each name and protocol: means over the seeds, and their spread where there are several.

    Of largest errors the largest is taken.
    """
    rows: list[Row] = []
    for name in outcome.names:
        if name in outcome.left_out:
            rows.append({"name": name, "left_out": outcome.left_out[name]})
            continue
        for protocol in PROTOCOLS:
            found = outcome.of(name, protocol)
            if found:
                rows.append({"name": name, "protocol": protocol, "seeds": len(found), **_figures(found, protocol)})
    return rows


def finished(trials: Sequence[Trial], rows: Sequence[Mapping[str, Any]]) -> bool:
    """Whether nothing could be added now: no row was left out, and no model waits to be weighed in C."""
    own = {name: {} for name in dict.fromkeys(trial.name for trial in trials)}
    for row in rows:
        own.setdefault(row["name"], {}).update(row)
    return not any("left_out" in row for row in rows) and not any(lacks_c(trial, own[trial.name]) for trial in trials)


def _figures(found: Sequence[Found], protocol: Protocol) -> dict[str, float | int | list[float]]:
    figures: dict[str, float | int | list[float]] = {}
    for key in found[0].told["protocols"][protocol]:
        values = [own.told["protocols"][protocol][key] for own in found]
        figures[key] = rounded(float(max(values) if "_max_" in f"_{key}" else np.mean(values)))
        if len(found) > 1 and key in SPREAD:
            figures[f"{key}_std"] = rounded(_deviation(values))
            figures[f"{key}_seeds"] = [rounded(value) for value in values]
    for key in ("taught", "stored", "multiply_adds"):
        if key in found[0].told:
            figures[key] = int(found[0].told[key])
    for key in MEASURED:
        values = [own.told[key] for own in found if key in own.told]
        if values:
            figures[key] = rounded(float(np.mean(values)))
    return figures


def _deviation(values: Sequence[float]) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else 0.0


def rounded(value: float) -> float:
    """Four significant digits."""
    return float(f"{value:.{DIGITS}g}")
