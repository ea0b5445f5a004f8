"""`card.md`: what a saved model is, for people."""

from myograph.case import MUSCLES
from myograph.inference.model_file import ModelFile, Origin
from myograph.inference.signature import RESIDUAL, Signature
from myograph.inference.ways import ways

_CONVENTIONS = {
    "initial": "the position in the initial state (S)",
    "material": "the place in the reference body (X)",
}
_LICENCE = "MIT, as myograph. The body and the data come from finite-element simulations, not from a person."


def card(told: ModelFile, nodes: int) -> str:
    """The text, in Markdown; the body has so many nodes."""
    sections = {
        "Use": f'```python\nimport myograph\n\nanswer = myograph.load("FOLDER").{_call(told.signature)}\n```',
        "Trained on": _trained_on(told, nodes),
        "Errors": _errors(told),
        "Limits": _limits(told),
        "Licence": _LICENCE,
    }
    head = f"A `{told.method}` model of {told.parameters:,} trained parameters. {_what(told.signature, told.fields)}"
    body = "\n\n".join(f"## {heading}\n\n{text}" for heading, text in sections.items())
    return f"# {told.name}: {told.muscle}\n\n{head}\n\n{body}\n"


def _what(signature: Signature, fields: dict[str, str]) -> str:
    asked = ", ".join(f"{name} [{unit}]" for name, unit in fields.items())
    points = f"at any points of the muscle; a point is named by {_CONVENTIONS[signature.convention]}"
    if "query_nodes" in signature.inputs:
        points = "at the nodes of its body"
    return f"From {_given(signature)} it answers {asked} {points}. Lengths are mm, stresses MPa, loads N."


def _given(signature: Signature) -> str:
    told = ["the activations of all muscles"] if "activation" in signature.inputs else []
    told += ["the load in the hand"] if "hand_load" in signature.inputs else []
    others = " (in training; others will do)" if signature.any_sensors and RESIDUAL in signature.outputs else ""
    sensors = f"{len(signature.sensors)} sensors{others}"
    groups = [" and ".join(told)] if told else []
    groups += [sensors] if signature.takes_sensors else []
    if ways(signature):
        return f"{', from '.join(groups)}, or from both"
    return " and ".join(groups) or "the initial state"


def _call(signature: Signature) -> str:
    if signature.takes_sensors and signature.least_sensors > 0:
        return f"predict_sensors({list(signature.sensors)}, positions)"
    return "predict_activation([0, 0, 1, 0, 0])"


def _trained_on(told: ModelFile, nodes: int) -> str:
    origin, trained = told.origin, told.trained_range
    box = "\n".join(
        f"| {muscle} | {low:.2f} | {high:.2f} |"
        for muscle, low, high in zip(MUSCLES, trained.activation_low, trained.activation_high, strict=True)
    )
    return (
        f"{origin.cases} cases of a {nodes}-node body ({_simulator(origin)}), training pairs of the protocol "
        f"`{origin.protocol}` (split seed {origin.split_seed}), seed {origin.seed}, {origin.seconds:.0f} s. "
        f"Loads in the hand from {trained.hand_load[0]:g} to {trained.hand_load[1]:g} N.\n\n"
        f"| muscle | least activation | largest activation |\n| --- | --- | --- |\n{box}\n\n"
        f"Data: `{origin.dataset}`. Arm: `{origin.arm_checksum or 'not said'}`. "
        f"Command: `{origin.command or 'not said'}`."
    )


def _simulator(origin: Origin) -> str:
    return ", ".join(word for word in (origin.simulator, origin.preset) if word) or "simulator not said"


def _errors(told: ModelFile) -> str:
    if not told.metrics:
        return "Not measured when it was saved; `myograph evaluate` measures them."
    figures = list(dict.fromkeys(name for row in told.metrics.values() for name in row))
    rows = "\n".join(
        f"| {protocol} | " + " | ".join(f"{row[name]:.4g}" if name in row else "–" for name in figures) + " |"
        for protocol, row in told.metrics.items()
    )
    head = f"| protocol | {' | '.join(figures)} |\n|{' --- |' * (len(figures) + 1)}"
    source = f"On pairs of the same data ({_simulator(told.origin)}); `myograph evaluate` holds it against others."
    return f"{source}\n\n{head}\n{rows}"


def _limits(told: ModelFile) -> str:
    own = (
        "It knows one body; another arm, another size of mesh, or a person's own muscle needs a model of its own.",
        "Answers outside the range above are marked `inside = False`: do not rely on them.",
        "It repeats its simulator, with all that this leaves out; it is no measurement and no medical device.",
    )
    return "\n".join(f"- {sentence}" for sentence in (*told.limits, *own))
