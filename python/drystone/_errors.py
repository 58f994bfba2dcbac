"""The exceptions of the package."""

from __future__ import annotations

import json
from dataclasses import dataclass


class DrystoneError(Exception):
    """A request that drystone cannot fulfil. The message says what to change."""


@dataclass(frozen=True)
class Problem:
    """One problem of a scene.

    ``line`` and ``column`` count from 1. Both are ``None`` if the scene was made in Python.
    """

    code: str
    path: str
    line: int | None
    column: int | None
    message: str
    hint: str


class SceneError(DrystoneError):
    """A scene that is not valid. ``problems`` lists all its problems."""

    problems: tuple[Problem, ...]

    def __init__(self, message: str, problems: str = '{"problems": []}') -> None:
        super().__init__(message, problems)
        self.problems = tuple(Problem(**one) for one in json.loads(problems)["problems"])

    def __str__(self) -> str:
        return str(self.args[0])
