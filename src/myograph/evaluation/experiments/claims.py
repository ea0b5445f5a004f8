"""What the thesis concludes, held against the rows of our experiments: each as a ratio of two errors and its bounds.

Ratios can be compared where errors of two arms cannot. A claim holds if the ratio lies within the bounds; where rows
have a spread over seeds, and the ratio by its own spread could lie on the other side, it is not decided.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot, inf, isfinite

from myograph.evaluation.experiments.columns import Row, number

ALIKE = 1.1
"""Errors within a tenth of each other are alike."""
HOLDS, FAILS, OPEN = "holds", "does not hold", "not decided by these seeds"

TOLD = (
    "Conclusions of the thesis as ratios of two errors of ours, under its own protocol; errors within a tenth of each "
    "other count as alike. Where the spread over seeds reaches over a bound, nothing is decided. Larger graphs are "
    "trained for fewer steps."
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


CLAIMS = (
    Claim("6.2.1", "'There is no need for a huge mesh'", "gen_thesis_343", "gen_thesis_8", least=1 / ALIKE),
    Claim("6.2.1", "Both meshes have the same accuracy", "gen_thesis_343", "gen_thesis_8", least=1 / ALIKE, most=ALIKE),
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
        "'A small loss of accuracy compared to the benchmark models' (2.5 times there)",
        "gen_thesis_343",
        "feed_forward",
        most=2.5,
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
        "'The concept can also be used on different kind of metrics': half the error of doing nothing",
        "gen_thesis_343",
        "do_nothing",
        most=0.5,
        figure="von_mises_mean_mpa",
        unit="MPa",
    ),
    Claim("6.2.4", "Width 16 'doesn't affect the results very much'", "16, latent 16", "32-32, latent 32", most=ALIKE),
    Claim("6.2.4", "Width 8 is worse", "8-8, latent 16", "32-32, latent 32", least=ALIKE),
    Claim("6.2.4", "A latent space of 8 is enough, with width 16", "16, latent 8", "32-32, latent 32", most=ALIKE),
    Claim("6.2.4", "A latent space of 1 is worse", "16, latent 1", "32-32, latent 32", least=ALIKE),
)


def judged(sections: Mapping[str, Sequence[Row]]) -> list[Verdict]:
    """All claims whose rows are there, under the thesis's own protocol."""
    found = []
    for claim in CLAIMS:
        rows = [_row(sections.get(claim.section, ()), name, claim.figure) for name in (claim.row, claim.beside)]
        if rows[0] is not None and rows[1] is not None and rows[1][claim.figure] > 0:
            found.append(_judge(claim, rows[0], rows[1]))
    return found


def _row(rows: Sequence[Row], name: str, figure: str) -> Row | None:
    return next((r for r in rows if r["name"] == name and r.get("protocol") == "thesis" and figure in r), None)


def _judge(claim: Claim, row: Row, beside: Row) -> Verdict:
    ratio = row[claim.figure] / beside[claim.figure]
    spread = ratio * hypot(*(each.get(f"{claim.figure}_std", 0.0) / each[claim.figure] for each in (row, beside)))
    inside = {claim.least <= value <= claim.most for value in (ratio - spread, ratio, ratio + spread)}
    verdict = OPEN if len(inside) > 1 else HOLDS if inside == {True} else FAILS
    own, other = (number(each[claim.figure]) for each in (row, beside))
    wide = f" ± {number(spread)}" if spread else ""
    told = f"{own} {claim.unit} ({claim.row}), {other} {claim.unit} ({claim.beside}): {number(ratio)}{wide} times"
    return Verdict(claim, verdict, f"{told}; holds for {claim.asks}")
