"""What the thesis concludes, held against the rows of our experiments: each as a ratio of two errors and its bounds.

Ratios can be compared where errors of two arms cannot. Both rows are trained from the same seeds, on the same splits: a
claim holds if the ratio lies within the bounds for every seed, does not hold if it lies outside for every seed, and is
not decided otherwise, nor by one seed alone.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite

from myograph.evaluation.experiments.columns import Row, number

ALIKE = 1.1
"""Errors within a tenth of each other are alike."""
HOLDS, FAILS, OPEN, ALONE = "holds", "does not hold", "not decided by these seeds", "not decided by one seed"

TOLD = (
    "Conclusions of the thesis as ratios of two errors of ours; errors within a tenth of each other count as alike, "
    "and bounds without a figure of the thesis are ours. Both rows have the same seeds, splits and sensors: a claim "
    "holds, or does not, where all seeds agree."
)


@dataclass(frozen=True)
class Claim:
    """One sentence of the thesis.

    Parameters
    ----------
    section
        Whose rows judge it.
    said
        In the thesis's words, or close to them.
    row, beside
        Names of two rows; the ratio is the error of `row` over that of `beside`.
    least, most
        Bounds of the ratio within which the claim holds.
    protocol
        Under which: the thesis's own, unless its test cases taught one of the rows.
    figure
        Which error.
    unit
        Of that error.
    """

    section: str
    said: str
    row: str
    beside: str
    least: float = 0.0
    most: float = inf
    protocol: str = "thesis"
    figure: str = "mean_mm"
    unit: str = "mm"

    @property
    def asks(self) -> str:
        """The bounds in words."""
        if isfinite(self.most) and self.least:
            return f"{number(self.least)} to {number(self.most)} times"
        return f"at most {number(self.most)} times" if isfinite(self.most) else f"at least {number(self.least)} times"


@dataclass(frozen=True)
class Verdict:
    """What came of a claim, and the errors that say so."""

    claim: Claim
    verdict: str
    evidence: str


_STRESS = {"most": 0.5, "figure": "von_mises_mean_mpa", "unit": "MPa"}
CLAIMS = (
    Claim(
        "meshes",
        "'There is no need for a huge mesh', both trained for as many steps",
        "343 nodes, right",
        "8 nodes, right",
        least=1 / ALIKE,
    ),
    Claim(
        "6.2.1",
        "The same, the small one trained for more steps, which are cheaper",
        "gen_thesis_343",
        "gen_thesis_8",
        least=1 / ALIKE,
    ),
    Claim(
        "meshes",
        "Both meshes have the same accuracy, trained for as many steps",
        "343 nodes, right",
        "8 nodes, right",
        least=1 / ALIKE,
        most=ALIKE,
    ),
    Claim(
        "meshes",
        "The same, with the sign of listing 5.2",
        "343 nodes, legacy_sign",
        "8 nodes, legacy_sign",
        least=1 / ALIKE,
        most=ALIKE,
    ),
    Claim(
        "6.2.1",
        "'A small loss of accuracy compared to the benchmark models' (2.5 times there), both on the skin, on "
        "activations that taught neither",
        "gen_thesis_343",
        "feed_forward",
        most=2.5,
        protocol="strict",
        figure="skin_mean_mm",
    ),
    Claim(
        "6.2.2",
        "Direction vectors are learned 'very similar' to coordinates",
        "gen_thesis_343, displacement",
        "gen_thesis_343, coordinates",
        least=1 / ALIKE,
        most=ALIKE,
    ),
    Claim(
        "6.2.3",
        "'The concept can also be used on different kind of metrics': at most half the error of doing nothing",
        "gen_thesis_343, stress at sensors",
        "do_nothing",
        **_STRESS,
    ),
    Claim(
        "6.2.3",
        "The same, told only where the sensors come to",
        "gen_thesis_343",
        "do_nothing",
        **_STRESS,
    ),
    Claim("6.2.4", "Width 16 'doesn't affect the results very much'", "16, latent 16", "32-32, latent 32", most=ALIKE),
    Claim("6.2.4", "Width 8 is worse", "8-8, latent 16", "32-32, latent 32", least=ALIKE),
    Claim("6.2.4", "Width 8 is worse, with one layer and latent 8", "8, latent 8", "32-32, latent 32", least=ALIKE),
    Claim("6.2.4", "A latent space of 8 is enough, with width 16", "16, latent 8", "32-32, latent 32", most=ALIKE),
    Claim("6.2.4", "A latent space of 1 is worse", "16, latent 1", "32-32, latent 32", least=ALIKE),
)


def judged(sections: Mapping[str, Sequence[Row]]) -> list[Verdict]:
    """All claims whose rows are there."""
    found = []
    for claim in CLAIMS:
        row, beside = (_row(sections.get(claim.section, ()), name, claim) for name in (claim.row, claim.beside))
        if row is not None and beside is not None and beside[claim.figure] > 0:
            found.append(_judge(claim, row, beside))
    return found


def _row(rows: Sequence[Row], name: str, claim: Claim) -> Row | None:
    there = (r for r in rows if r["name"] == name and r.get("protocol") == claim.protocol and claim.figure in r)
    return next(there, None)


def _judge(claim: Claim, row: Row, beside: Row) -> Verdict:
    ratios = _ratios(row, beside, claim.figure)
    within = {claim.least <= ratio <= claim.most for ratio in ratios}
    verdict = ALONE if len(ratios) == 1 else OPEN if len(within) > 1 else HOLDS if within == {True} else FAILS
    own, other = (number(each[claim.figure]) for each in (row, beside))
    spread = f" ({number(min(ratios))} to {number(max(ratios))} over {len(ratios)} seeds)" if len(ratios) > 1 else ""
    told = f"{own} {claim.unit} ({claim.row}), {other} {claim.unit} ({claim.beside}), {claim.protocol}: "
    ratio = row[claim.figure] / beside[claim.figure]
    return Verdict(claim, verdict, f"{told}{number(ratio)} times{spread}; holds for {claim.asks}")


def _ratios(row: Row, beside: Row, figure: str) -> list[float]:
    """Seed by seed; that of the means where one of both rows has other seeds."""
    each, other = (told.get(f"{figure}_seeds", [told[figure]]) for told in (row, beside))
    if len(each) != len(other):
        return [row[figure] / beside[figure]]
    return [mine / theirs for mine, theirs in zip(each, other, strict=True)]
