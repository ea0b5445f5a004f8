"""Errors that say what was expected, what came, and what to do.

`InputError` is the caller's mistake (exit code 2); `NotConvergedError` is a method that failed (exit code 3).
"""

from dataclasses import dataclass


class MyographError(Exception):
    """Anything that this package raises on purpose."""

    exit_code = 1


class InputError(MyographError):
    """The caller asked for something that cannot be: the message says what was expected, what came, what to do."""

    exit_code = 2


class MissingPackageError(InputError):
    """An optional package is not installed; the message names the extra that brings it."""

    def __init__(self, package: str, extra: str, purpose: str) -> None:
        super().__init__(f"{purpose} needs the package '{package}': install it with  pip install 'myograph[{extra}]'")


@dataclass(frozen=True)
class SolvePoint:
    """Where a solve stood: muscle by name, activation [-], elbow angle [rad]."""

    muscle: str
    activation: float
    angle: float


class NotConvergedError(MyographError):
    """A method failed. Carries where it was and the residuals of its last attempt [N], newest last."""

    exit_code = 3

    def __init__(self, message: str, where: SolvePoint | None = None, residuals: tuple[float, ...] = ()) -> None:
        super().__init__(message)
        self.where = where
        self.residuals = residuals
