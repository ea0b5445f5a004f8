"""The page about pairs: its examples run, and its tables name what there is."""

import re
from dataclasses import fields
from pathlib import Path

from myograph.ensemble.pairs.features import WIDTH
from myograph.ensemble.pairs.protocols import PROTOCOLS
from myograph.ensemble.pairs.question import Question
from myograph.ensemble.store import reading
from tests.ensemble.pairs.made_up import made_up

PAGE = (Path(__file__).parents[3] / "docs" / "pairs.md").read_text()


def test_the_examples_run(monkeypatch, capsys):
    monkeypatch.setattr(reading, "read_muscle", lambda store, muscle: made_up(32, 4))
    names = {"store": Path("runs/arm")}
    for example in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(example, names)
    assert re.fullmatch(r"\d+\.\d\d mm\n", capsys.readouterr().out)


def test_every_feature_has_a_row_with_its_width():
    for kind, width in WIDTH.items():
        assert re.search(rf"^\| {kind} \| {width} \|", PAGE, re.MULTILINE), kind


def test_every_protocol_and_every_part_of_a_question_has_a_row():
    for protocol in PROTOCOLS:
        assert re.search(rf"^\| {protocol} \|", PAGE, re.MULTILINE), protocol
    for part in fields(Question):
        assert part.name == "convention" or re.search(rf"^\| .*\b{part.name}\b.* \|", PAGE, re.MULTILINE), part.name
