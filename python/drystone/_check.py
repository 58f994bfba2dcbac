"""The functions :func:`check` and :func:`check_many`, which analyse one scene, or many scenes on all cores."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Any

from . import _drystone
from ._errors import SceneError
from ._figure import request_json
from ._result import Result, Results
from ._scene import AnyScene, Scene, as_scene

Margins = bool | str | Iterable[str]
Capacity = str | tuple[Any, ...]


def check(
    scene: AnyScene,
    *,
    margins: Margins = False,
    wedging: bool = False,
    placement: bool = False,
    removable: bool = False,
    placed: Iterable[str] | None = None,
    verdict_only: bool = False,
    accuracy: str = "standard",
    time_limit: float | None = None,
    contact_tolerance: float | None = None,
    notes: bool = True,
    capacity: Capacity | None = None,
    for_all: str | None = None,
    sensitivity: str | None = None,
) -> Result:
    """Analyses a scene and returns, for each frame, the verdict with its proof, the forces, and the failures.

    ``margins`` is ``True`` for all margins, or one or several of "friction", "friction_factor", "tilt",
    "horizontal_load", "kernel", "load_factor", "sliding", "overturning", "middle_third" and "robots". ``wedging=True``
    tests whether a frame stands only by wedging. ``placement=True`` computes how accurately the blocks must be placed;
    ``placed`` names the only blocks that are off their places. ``removable=True`` finds out for each block whether the
    rest stands without it, and how hard a robot must hold it or the rest. ``verdict_only=True`` leaves out all results
    that the verdict does not need. ``accuracy`` is "standard", "proved" or "exact": with "exact", a verdict that exact
    arithmetic does not prove is undecided. ``time_limit`` is in seconds, and ``contact_tolerance`` is in metres.
    ``notes=False`` leaves out the notes on values of the scene that are allowed but probably not intended.

    ``capacity`` computes all forces that a block can carry: ``"lintel"`` at its centroid (or at the grip point, if a
    robot holds the block), ``("lintel", (2, 3))`` at a point, ``("lintel", (1, 3), (3, 3))`` at a contact between two
    points. ``for_all``, such as ``"tilt=±2,friction=0.5..0.7"``, restricts the capacity to forces that the block can
    carry for all values in these ranges.

    ``sensitivity`` computes how one margin changes with every corner, weight, friction coefficient and load. The margin
    is "load_factor", "tilt", "horizontal_load", "friction_factor", "friction" or "kernel".

    Raises :class:`SceneError` if the scene is not valid.

    >>> brick = Scene(friction=0.5).ground([(0, -1), (9, -1), (9, 0), (0, 0)]).block("a", [(1, 0), (4, 0), (4, 2), (1, 2)])
    >>> check(brick).stands
    True
    """
    scene = as_scene(scene)
    options = analysis_options(
        margins,
        wedging=wedging,
        placement=placement,
        removable=removable,
        placed=None if placed is None else list(placed),
        verdict_only=verdict_only,
        accuracy=accuracy,
        time_limit=time_limit,
        contact_tolerance=contact_tolerance,
        no_notes=not notes,
        located=scene._located,
        capacity=capacity,
        for_all=for_all,
        sensitivity=sensitivity,
    )
    return Result(_drystone.check(scene._json(), options), scene)


def check_many(
    scenes: Iterable[AnyScene],
    *,
    margins: Margins = False,
    wedging: bool = False,
    placement: bool = False,
    removable: bool = False,
    placed: Iterable[str] | None = None,
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
    """Analyses many scenes on all cores; the results are in the order of the scenes.

    With ``errors="raise"``, a scene that is not valid raises its :class:`SceneError`. With ``errors="keep"``, the
    results contain this error in place of the result of the scene. ``progress`` is a function that is called with the
    number of scenes that are done; an exception in ``progress`` ends the analysis. ``threads`` is the number of
    threads, or 0 for one per core. All other arguments are those of :func:`check`.
    """
    if errors not in ("raise", "keep"):
        raise ValueError(f'errors is "raise" or "keep", not {errors!r}')
    given = [as_scene(scene) for scene in scenes]
    options = analysis_options(
        margins,
        wedging=wedging,
        placement=placement,
        removable=removable,
        placed=None if placed is None else list(placed),
        verdict_only=verdict_only,
        accuracy=accuracy,
        time_limit=time_limit,
        contact_tolerance=contact_tolerance,
        no_notes=not notes,
        located=all(scene._located for scene in given),
        capacity=capacity,
        for_all=for_all,
        sensitivity=sensitivity,
    )
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


def analysis_options(margins: Margins = False, *, located: bool = False, **options: Any) -> _drystone.Options:
    """Converts the arguments of an analysis to an ``Options`` object. Recently used objects are cached.

    ``located`` is true if problems have lines and columns, because the scene was read from text. ``options`` have the
    names of the options of ``drystone check``.
    """
    if not isinstance(margins, (bool, str)):
        margins = list(margins) or True
    return _options(request_json({"margins": margins, "located": located, **options}))


_options = lru_cache(maxsize=64)(_drystone.Options)
