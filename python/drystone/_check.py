"""Analyses: one scene, or many on all cores."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any

from . import _drystone
from ._errors import SceneError
from ._result import Result, Results
from ._scene import Scene

Margins = bool | str | Iterable[str]
Capacity = str | tuple[Any, ...]
AnyScene = Scene | Mapping[str, Any] | os.PathLike[str]


def check(
    scene: AnyScene,
    *,
    margins: Margins = False,
    wedging: bool = False,
    verdict_only: bool = False,
    accuracy: str = "standard",
    time_limit: float | None = None,
    contact_tolerance: float | None = None,
    notes: bool = True,
    capacity: Capacity | None = None,
    for_all: str | None = None,
    sensitivity: str | None = None,
) -> Result:
    """Says whether a scene stands, with the forces, what fails and the proof.

    ``margins`` is ``True`` for all margins, or some of "friction", "tilt", "horizontal_load", "kernel", "load_factor" and
    "robots". ``wedging`` finds out whether a frame stands only by wedging. ``verdict_only`` leaves out what the verdict
    does not need. ``accuracy`` is "standard" or "proved". ``time_limit`` is in seconds, ``contact_tolerance`` in metres.
    ``notes`` are about input that is allowed but probably not intended.

    ``capacity`` computes all forces that a block can carry: ``"lintel"`` at its centroid, ``("lintel", (2, 3))`` at a point,
    ``("lintel", (1, 3), (3, 3))`` at two points. ``for_all``, such as ``"tilt=±2,friction=0.5..0.7"``, leaves the forces that
    are carried in every case of these ranges.

    ``sensitivity`` computes how one margin changes with every corner, weight, friction coefficient and load: "load_factor",
    "tilt", "horizontal_load", "friction" or "kernel".

    Raises :class:`SceneError` where the scene is not valid.

    >>> brick = Scene(friction=0.5).ground([(0, -1), (9, -1), (9, 0), (0, 0)]).block("a", [(1, 0), (4, 0), (4, 2), (1, 2)])
    >>> check(brick).stands
    True
    """
    scene = as_scene(scene)
    options = asked(margins, wedging, verdict_only, accuracy, time_limit, contact_tolerance, notes, scene._located, capacity, for_all, sensitivity)
    return Result(_drystone.check(scene._json(), options), scene)


def check_many(
    scenes: Iterable[AnyScene],
    *,
    margins: Margins = False,
    wedging: bool = False,
    verdict_only: bool = False,
    accuracy: str = "standard",
    time_limit: float | None = None,
    contact_tolerance: float | None = None,
    notes: bool = True,
    capacity: Capacity | None = None,
    for_all: str | None = None,
    sensitivity: str | None = None,
    errors: str = "raise",
    progress: Callable[[int], object] | None = None,
    threads: int = 0,
) -> Results:
    """Checks scenes on all cores; the results are in the order of the scenes.

    ``errors`` is "raise", or "keep" to get the :class:`SceneError` of an invalid scene in its place. ``progress`` is called
    with the number of scenes that are done; what it raises ends the work. ``threads`` is 0 for one per core. The other
    options are those of :func:`check`.
    """
    if errors not in ("raise", "keep"):
        raise ValueError(f'errors is "raise" or "keep", not {errors!r}')
    given = [as_scene(scene) for scene in scenes]
    located = all(scene._located for scene in given)
    options = asked(margins, wedging, verdict_only, accuracy, time_limit, contact_tolerance, notes, located, capacity, for_all, sensitivity)
    answers = _drystone.check_many([scene._json() for scene in given], options, progress, threads)
    results: list[Result | SceneError] = []
    for number, (scene, answer) in enumerate(zip(given, answers)):
        if not isinstance(answer, SceneError):
            results.append(Result(answer, scene))
        elif errors == "keep":
            results.append(answer)
        else:
            if hasattr(answer, "add_note"):
                answer.add_note(f"scene number {number} of check_many, counted from 0")
            raise answer
    return Results(results)


def as_scene(scene: AnyScene) -> Scene:
    """A scene, a dict of a scene file, or the path of one."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, Mapping):
        return Scene.from_dict(scene)
    if isinstance(scene, os.PathLike):
        return Scene.from_file(scene)
    kind = type(scene).__name__
    raise TypeError(f"a {kind} is no scene; give a Scene, a dict or a pathlib.Path. Text is read by Scene.from_json")


def asked(
    margins: Margins,
    wedging: bool,
    verdict_only: bool,
    accuracy: str,
    time_limit: float | None,
    contact_tolerance: float | None,
    notes: bool,
    located: bool,
    capacity: Capacity | None = None,
    for_all: str | None = None,
    sensitivity: str | None = None,
) -> _drystone.Options:
    """The options of an analysis; the same options are read only once."""
    names: tuple[str, ...] | None
    if isinstance(margins, str):
        names = (margins,)
    elif isinstance(margins, bool):
        names = () if margins else None
    else:
        names = tuple(margins)
    if for_all is not None and capacity is None:
        raise ValueError("for_all limits the forces that a block can carry, so it needs capacity too")
    where = None if capacity is None else place(capacity)
    return _options(names, wedging, verdict_only, accuracy, time_limit, contact_tolerance, notes, located, where, for_all, sensitivity)


def place(capacity: Capacity) -> str:
    """The block and the point of ``--capacity``."""
    if isinstance(capacity, str):
        return capacity
    block, *points = capacity
    if not points:
        return str(block)
    return f"{block}@" + "..".join(f"{float(x)!r},{float(y)!r}" for x, y in points)


@lru_cache(maxsize=64)
def _options(names: tuple[str, ...] | None, *others: Any) -> _drystone.Options:
    return _drystone.Options(None if names is None else list(names), *others)
