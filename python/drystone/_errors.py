"""The exceptions of the package."""

from __future__ import annotations

import json
from dataclasses import dataclass


class DrystoneError(Exception):
    """A request that drystone cannot fulfil. The message says what is wrong or what to change."""


@dataclass(frozen=True)
class Problem:
    """One problem of a scene.

    ``code`` is the kind of problem, and ``path`` is its place in the scene. ``line`` and ``column`` are its position in
    the text of the scene, from 1; both are ``None`` if the scene was made in Python, or if the problem has no position.
    """

    code: str
    path: str
    line: int | None
    column: int | None
    message: str
    hint: str


class SceneError(DrystoneError):
    """The exception for a scene that is not valid. ``problems`` contains all problems of the scene."""

    problems: tuple[Problem, ...]

    def __init__(self, message: str, problems: str = '{"problems": []}') -> None:
        super().__init__(message, problems)
        self.problems = tuple(Problem(**one) for one in json.loads(problems)["problems"])

    def __str__(self) -> str:
        return str(self.args[0])
