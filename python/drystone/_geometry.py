"""Converts outlines and numbers to lists and numbers for a scene file: from lists, numpy, shapely and GeoJSON."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any

from ._errors import DrystoneError

Point = Any
"""A point ``[x, y]`` in metres: any sequence of two numbers."""

Outline = Any
"""Corners in metres: a sequence of ``[x, y]``, an n × 2 array, or an object with ``__geo_interface__``."""


def plain(value: object) -> Any:
    """Converts a value, such as a numpy array, to a value that JSON can represent. Used as ``default`` of ``json``."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    for method in ("tolist", "item"):
        convert = getattr(value, method, None)
        if convert is not None:
            return convert()
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, Iterable):
        return list(value)
    raise DrystoneError(f"a {type(value).__name__} is not a number, text, list or dict, so a scene file cannot contain it: {value!r}")


def ring(corners: Any) -> list[list[float]]:
    """Returns corners as a list of ``[x, y]``, without the last corner if it is equal to the first."""
    listed = corners.tolist() if hasattr(corners, "tolist") else corners
    points: list[list[float]] = []
    corner: Any = listed
    try:
        for corner in listed:
            x, y = corner
            points.append([float(x), float(y)])
    except (TypeError, ValueError):
        raise DrystoneError(f"corner {len(points)} is {corner!r}; a corner is [x, y], two numbers") from None
    if len(points) > 1 and points[0] == points[-1]:
        points.pop()
    return points


def rings(outline: Any) -> list[list[list[float]]]:
    """Returns the outer ring of an outline, followed by the rings of its holes."""
    geometry = getattr(outline, "__geo_interface__", outline)
    if not isinstance(geometry, Mapping):
        return [ring(geometry)]
    kind = geometry.get("type")
    if kind == "Feature":
        return rings(geometry["geometry"])
    parts = geometry.get("coordinates")
    if kind == "MultiPolygon" and parts is not None and len(parts) == 1:
        kind, parts = "Polygon", parts[0]
    if kind != "Polygon" or not parts:
        count = "" if kind != "MultiPolygon" or parts is None else f" of {len(parts)} polygons"
        raise DrystoneError(f"a body has one polygon as its outline, not a {kind}{count}; give one body for each polygon")
    return [ring(one) for one in parts]


def outline(polygon: Outline | None, holes: Iterable[Outline] | None) -> tuple[list[list[float]] | None, list[list[list[float]]]]:
    """Returns the outer ring of ``polygon`` (``None`` without a polygon), and the rings of its holes and ``holes``."""
    found = [] if polygon is None else rings(polygon)
    inner = found[1:] + [ring(one) for one in holes or ()]
    return found[0] if found else None, inner


def body(polygon: Outline | None, holes: Iterable[Outline] | None, keys: dict[str, Any]) -> dict[str, Any]:
    """Returns the entry of a body in a scene file: its outline, and the keys whose value is not ``None``."""
    entry: dict[str, Any] = {key: value for key, value in keys.items() if value is not None}
    outer, inner = outline(polygon, holes)
    if outer is not None:
        entry["polygon"] = outer
    if inner or holes is not None:
        entry["holes"] = inner
    return entry


def block(
    id: str | None,
    polygon: Outline | None,
    holes: Iterable[Outline] | None,
    keys: dict[str, Any],
) -> dict[str, Any]:
    """Returns the entry of a block in a scene file."""
    return body(polygon, holes, {"id": None if id is None else str(id), **keys})


def capacity_word(capacity: str | tuple[Any, ...]) -> str:
    """Returns the value of the option ``--capacity``, such as ``lintel@2,3``.

    ``capacity`` is the name of a block, or a tuple of the name and of one or two points.
    """
    if isinstance(capacity, str):
        return capacity
    block, *points = capacity
    if not points:
        return str(block)
    return f"{block}@" + "..".join(f"{float(x)!r},{float(y)!r}" for x, y in points)
