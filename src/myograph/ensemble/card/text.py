"""The words of a card: facts in, Markdown out. All of it follows from the store, and the last part from who made it."""

from collections.abc import Callable, Iterable, Sequence

from myograph.case import MUSCLES
from myograph.ensemble.card.facts import StoreFacts
from myograph.ensemble.card.ranges import Range
from myograph.ensemble.card.words import EQUATIONS, LICENCE, LIMITS, ORIGINS, TRUNCATED
from myograph.fields import FIELDS
from myograph.units import degrees

MOST_REASONS = 10
FIGURE = "card.png"


def card_text(facts: StoreFacts, name: str) -> str:
    """The card of a store of that name."""
    parts = (
        [f"# {name}", "", *_what(facts), "", f"![Elbow angles, activations, a muscle in two states]({FIGURE})", ""],
        ["## Muscles", "", *_muscles(facts), ""],
        ["## Equations and parameters", "", *_equations(facts), ""],
        ["## Design and cases", "", *_cases(facts), ""],
        ["## Fields and units", "", *_fields(facts), ""],
        ["## Ranges", "", *_ranges(facts), ""],
        ["## Known limits", "", *(f"- {limit}" for limit in LIMITS[_kind(facts)]), ""],
        ["## Licence", "", LICENCE[_kind(facts)], ""],
        ["## Cost, versions, command", "", *_provenance(facts)],
    )
    return "\n".join(line for part in parts for line in part) + "\n"


def _kind(facts: StoreFacts) -> str:
    kind = facts.plan.simulator.kind
    return kind if kind in ORIGINS else "own"


def _what(facts: StoreFacts) -> list[str]:
    plan = facts.plan
    text = ORIGINS[_kind(facts)].format(kind=plan.simulator.kind, preset=plan.simulator.preset)
    return [
        f"The deformed shape and the stress of {_list(plan.muscles)} for {plan.size:,} combinations of the activations"
        f" of five elbow muscles ({_list(MUSCLES)}). {text}"
    ]


def _muscles(facts: StoreFacts) -> list[str]:
    return _table(("muscle", "nodes"), ((name, f"{facts.plan.nodes[name]:,}") for name in facts.plan.muscles))


def _equations(facts: StoreFacts) -> list[str]:
    described = facts.plan.described
    lines = [EQUATIONS[_kind(facts)], ""]
    lines += [
        f"- {key.replace('_', ' ')}: {_value(value)}" for key, value in described.items() if value not in ("", {})
    ]
    if facts.plan.simulator.arm:
        lines.append("- the arm with all its parameters: `ensemble.json`, key `simulator.arm`")
    return lines


def _cases(facts: StoreFacts) -> list[str]:
    lines = [
        f"{facts.done:,} of {facts.plan.size:,} cases are done, {facts.failed:,} failed, {facts.missing:,} missing.",
        "",
    ]
    lines += _table(("design", "cases"), ((word, f"{count:,}") for word, count in facts.designs.items()))
    if facts.reasons:
        lines += ["", "Why cases failed:", ""]
        lines += [f"- {count} x {_one_line(reason)}" for reason, count in list(facts.reasons.items())[:MOST_REASONS]]
        rest = len(facts.reasons) - MOST_REASONS
        lines += [f"- and {rest} other reasons; see `myograph ensemble status`"] if rest > 0 else []
    return lines


def _fields(facts: StoreFacts) -> list[str]:
    names = (*facts.plan.fields, "reference_position", "activation", "hand_load", "elbow_angle", "moment")
    rows = ((n, FIELDS[n].unit, " ".join(FIELDS[n].components) or "—", FIELDS[n].meaning) for n in names)
    return _table(("field", "unit", "components", "meaning"), rows)


def _ranges(facts: StoreFacts) -> list[str]:
    rows = [("elbow flexion, all cases", "degrees", *_three(facts.angle, degrees))] if facts.angle else []
    for muscle, fields in facts.fields.items():
        for name, found in fields.items():
            unit = FIELDS[name].unit if name in FIELDS else "mm"
            rows.append((f"{muscle}: {name.replace('_', ' ')} of its nodes", unit, *_three(found)))
    lines = _table(("what", "unit", "least", "mean", "largest"), rows)
    if facts.unreadable:
        lines += ["", TRUNCATED.format(count=facts.unreadable)]
    if facts.raw:
        size = f"{facts.stored / 1e6:,.1f} MB on disk, {facts.stored / facts.raw:.2f} of the same in float32"
        lines += ["", f"All fields: {size}."]
    return lines


def _three(found: Range, of: Callable[[float], float] = float) -> tuple[str, str, str]:
    numbers = (found.least, found.mean, found.largest)
    low, middle, high = (f"{of(number):.4g}" for number in numbers)
    return low, middle, high


def _provenance(facts: StoreFacts) -> list[str]:
    known = dict(facts.provenance)
    seconds, runs = known.pop("seconds", None), known.pop("runs", "1")
    cost = f"{float(seconds):,.1f} s in {runs} runs that came to their end" if seconds else "not known"
    lines = [f"- time: {cost}"]
    return lines + [f"- {key.replace('_', ' ')}: `{_one_line(value)}`" for key, value in sorted(known.items())]


def _table(names: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    lines = [names, ["---"] * len(names), *rows]
    return ["| " + " | ".join(_one_line(cell) for cell in line) + " |" for line in lines]


def _value(value: object) -> str:
    if isinstance(value, list):
        return ", ".join(map(str, value)) or "none"
    if isinstance(value, dict):
        return ", ".join(f"{key} {str(inner)[:16]}" for key, inner in value.items())
    return f"`{value}`"


def _one_line(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def _list(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
