"""What the command line makes of errors and of warnings."""

import warnings

import pytest

from myograph.cli import app as command_line
from myograph.errors import InputError


def leaves_with(monkeypatch, verb):
    """The exit code of the program with this in the place of all verbs."""
    monkeypatch.setattr(command_line, "app", lambda standalone_mode: verb())
    with pytest.raises(SystemExit) as left:
        command_line.main()
    return left.value.code


def test_a_warning_is_one_line_and_said_once(monkeypatch, capsys):
    before = warnings.showwarning

    def verb():
        warnings.simplefilter("always")
        for _ in range(3):
            warnings.warn("this network is blind", stacklevel=1)
        return 0

    assert leaves_with(monkeypatch, verb) == 0
    assert capsys.readouterr().err == "myograph: warning: this network is blind\n"
    assert warnings.showwarning is before


def test_a_mistake_is_one_line_and_exits_with_two(monkeypatch, capsys):
    def verb():
        raise InputError("expected a muscle, got 'bicep'")

    assert leaves_with(monkeypatch, verb) == 2
    assert capsys.readouterr().err == "myograph: expected a muscle, got 'bicep'\n"
