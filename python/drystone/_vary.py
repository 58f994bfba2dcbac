"""The function :func:`vary`: for which values of one number, or of two, a structure stands."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import _drystone
from ._check import analysis_options
from ._errors import DrystoneError
from ._scene import AnyScene, as_scene


@dataclass(frozen=True)
class Variation:
    """What was found: the data of ``drystone vary --json``, and its picture as SVG. A notebook displays it."""

    data: dict[str, Any]
    svg: str

    @property
    def intervals(self) -> list[dict[str, Any]]:
        """Of one number: its intervals, with "state" ("holds", "fails", "undecided" or "no_scene"), "from" and "to"."""
        found: list[dict[str, Any]] = self._part("intervals", "two numbers have a region")
        return found

    @property
    def stands(self) -> list[tuple[float, float]]:
        """Of one number: the intervals in which the structure stands, or the goal is reached."""
        return [(i["from"], i["to"]) for i in self.intervals if i["state"] == "holds"]

    @property
    def region(self) -> list[list[tuple[float, float]]]:
        """Of two numbers: the outlines of the region in which the structure stands, holes clockwise."""
        return [[(x, y) for x, y in ring] for ring in self._part("region", "one number has intervals")]

    def column(self, name: str) -> list[Any]:
        """Returns a value of every sample: of a number that varies by its name, "state", or "value" of the curve."""
        names = [entry["name"] for entry in self.data["ranges"]]
        if name in names:
            return [sample["at"][names.index(name)] for sample in self.data["samples"]]
        if name not in ("state", "value"):
            raise DrystoneError(f'there is no column "{name}"; a column is one of {", ".join([*names, "state", "value"])}')
        return [sample[name] for sample in self.data["samples"]]

    def _part(self, key: str, otherwise: str) -> Any:
        if key not in self.data:
            raise DrystoneError(otherwise)
        return self.data[key]

    def _repr_svg_(self) -> str:
        return self.svg


def vary(
    scene: AnyScene | str,
    numbers: Mapping[str, tuple[float, float] | float],
    *,
    goal: str | None = None,
    curve: str | None = None,
    isolines: str | None = None,
    digits: int = 4,
    accuracy: str = "standard",
    time_limit: float | None = None,
    contact_tolerance: float | None = None,
) -> Variation:
    """Finds for which values of one number, or of two, a structure stands.

    ``scene`` is a scene, or the name of a structure of ``drystone new``, such as "arch". ``numbers`` maps names to
    ``(from, to)`` for the numbers that vary, and to a value for numbers that are set. ``goal`` asks whether a number of
    the result is reached, such as ``"load_factor>=2"``. ``curve`` names the number of the result that is computed for
    every value of one number; ``isolines`` names the one whose lines of equal values a map shows.

    >>> vary("arch", {"voussoirs": 31, "thickness": (0.1, 0.6)}).stands
    [(0.2264, 0.6)]
    """
    typed = [f"{name}={value[0]}..{value[1]}" if isinstance(value, tuple) else f"{name}={value}" for name, value in numbers.items()]
    if goal is not None:
        typed.append(goal)
    own = None if isinstance(scene, str) else as_scene(scene)
    options = analysis_options(
        accuracy=accuracy,
        time_limit=time_limit,
        contact_tolerance=contact_tolerance,
        located=own is not None and own._located,
    )
    name = scene if isinstance(scene, str) else "the scene"
    data, svg = _drystone.vary(name, None if own is None else own._json(), typed, (curve, isolines), digits, options)
    return Variation(json.loads(data), svg)
