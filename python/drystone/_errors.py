"""What the package raises."""

from __future__ import annotations

import json
from dataclasses import dataclass


class DrystoneError(Exception):
    """Something drystone was asked and cannot do; the message says what to change."""


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with a scene.

    ``line`` and ``column`` count from 1; both are ``None`` for a scene that was made in Python.
    """

    code: str
    path: str
    line: int | None
    column: int | None
    message: str
    hint: str


class SceneError(DrystoneError):
    """A scene that is not valid, with everything that is wrong with it in ``problems``."""

    problems: tuple[Problem, ...]

    def __init__(self, message: str, problems: str = '{"problems": []}') -> None:
        super().__init__(message, problems)
        self.problems = tuple(Problem(**one) for one in json.loads(problems)["problems"])

    def __str__(self) -> str:
        return str(self.args[0])
