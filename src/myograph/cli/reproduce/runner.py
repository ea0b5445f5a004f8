"""Runs the trials of a section that are not in the cache, side by side, and gathers what all of them found."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from myograph.cli.progress import Steps
from myograph.cli.reproduce.cache import Cache, Found
from myograph.cli.reproduce.data import Data
from myograph.cli.reproduce.outcome import Outcome
from myograph.cli.reproduce.trial import Trial
from myograph.cli.reproduce.trying import try_and_keep
from myograph.cli.reproduce.weighing import lacks_c
from myograph.errors import InputError
from myograph.processes import side_by_side


@dataclass(frozen=True)
class Runner:
    """Where trials read, and where they keep what they find."""

    data: Data
    cache: Cache
    steps: Steps

    def run(self, section: str, trials: Sequence[Trial]) -> Outcome:
        """What the trials of a section find; the first error is raised, with all finished trials kept."""
        keys = self.keys(trials)
        wanted = dict(zip(keys, trials, strict=True))
        known = {key: found for key in wanted if (found := self.cache.get(key)) is not None}
        kept = {key: found for key, found in known.items() if not lacks_c(wanted[key], found.told)}
        missing = {key: trial for key, trial in wanted.items() if key not in kept}
        before = len(kept)
        reasons = self._make(section, missing)
        kept |= {key: found for key in missing if (found := self.cache.get(key)) is not None}
        return replace(self._outcome(trials, keys, kept, reasons), before=before)

    def keys(self, trials: Sequence[Trial]) -> list[str]:
        """Of the trials, in their order."""
        return [self._key(trial) for trial in trials]

    def _key(self, trial: Trial) -> str:
        stores = (trial.cases.store, trial.cases.truth)
        return trial.key({name: self.data.cases(name).checksum for name in stores if name is not None})

    def _make(self, section: str, missing: Mapping[str, Trial]) -> dict[str, str]:
        """Make them; why some could not be, by key."""
        if not missing:
            return {}
        tasks = [(trial, key, self._paths(trial), self.cache.folder) for key, trial in missing.items()]
        with self.steps.bars("trials", {section: len(tasks)}) as advance:
            found = side_by_side(try_and_keep, tasks, lambda _: advance(section))
        return {key: reason for key, reason in zip(missing, found, strict=True) if reason is not None}

    def _paths(self, trial: Trial) -> dict[str, Path]:
        stores = (trial.cases.store, trial.cases.truth)
        return {name: self.data.path(name).resolve() for name in stores if name is not None}

    def _outcome(
        self, trials: Sequence[Trial], keys: Sequence[str], kept: Mapping[str, Found], reasons: Mapping[str, str]
    ) -> Outcome:
        lost = [key for key in keys if key not in kept and key not in reasons]
        if lost:
            raise InputError(
                f"{self.cache.folder}: expected the {len(keys)} trials that were kept there, got none of {len(lost)}: "
                "damaged or taken away; run it again, or in another folder"
            )
        left_out = {trial.name: reasons[key] for trial, key in zip(trials, keys, strict=True) if key in reasons}
        return Outcome(self.data, self.data.size, trials, [kept.get(key) for key in keys], left_out)
