"""The class :class:`Session`, which gives a verdict after every step of a construction."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from . import _drystone, _geometry
from ._check import Margins, analysis_options, check
from ._geometry import Outline, Point
from ._result import Result
from ._scene import AnyScene, Scene, _dumps, as_scene
from ._table import Record


class Session:
    """A structure under construction, for planners and training loops.

    A session starts with a scene without steps. The methods :meth:`place`, :meth:`remove`, :meth:`hold` and
    :meth:`release` are the steps of a session. Each step returns the verdict: "stable", "unstable" or "undecided". A
    step that is not possible raises :class:`DrystoneError` and does not change the session.

    A session can be copied and pickled. A pickle contains the start and the steps; unpickling repeats the steps, and
    solves only the last state.

    >>> from drystone import Scene
    >>> session = Session(Scene().ground([(-9, -1), (9, -1), (9, 0), (-9, 0)]).robot("crane"))
    >>> session.place("a", [(0, 0), (3, 0), (3, 1), (0, 1)])
    'stable'
    >>> session.place("b", [(2, 1), (5, 1), (5, 2), (2, 2)])
    'unstable'
    >>> session.hold("crane", "b")
    'stable'
    """

    def __init__(self, scene: AnyScene, *, accuracy: str = "standard", verdict_only: bool = False) -> None:
        start = as_scene(scene)
        options = analysis_options(verdict_only=verdict_only, accuracy=accuracy, located=start._located)
        self._native = _drystone.Session(start._json(), options)

    def place(
        self,
        id: str | None = None,
        polygon: Outline | None = None,
        *,
        holes: Iterable[Outline] | None = None,
        **keys: Any,
    ) -> str:
        """Places a block and returns the verdict; the arguments are those of :meth:`Scene.block`."""
        outer, inner = _geometry.outline(polygon, holes)
        given = {key: value for key, value in keys.items() if value is not None}
        return self._native.place(None if id is None else str(id), outer, inner, _dumps(given) if given else None)

    def remove(self, block: str) -> str:
        """Removes a block and the loads on it, and returns the verdict."""
        return self._native.remove(block)

    def hold(self, robot: str, block: str, at: Point | None = None) -> str:
        """Makes a robot hold a block and returns the verdict.

        ``at`` is the grip point in metres; the default is the centroid of the block.
        """
        return self._native.hold(robot, block, None if at is None else (float(at[0]), float(at[1])))

    def release(self, robot: str) -> str:
        """Makes a robot release the block that it holds, and returns the verdict."""
        return self._native.release(robot)

    @property
    def verdict(self) -> str:
        """The verdict for the placed blocks: "stable", "unstable" or "undecided"."""
        return self._native.verdict

    @property
    def stands(self) -> bool:
        """Whether the placed blocks are proved to stand."""
        return self._native.verdict == "stable"

    @property
    def blocks(self) -> list[str]:
        """The names of the placed blocks, in the order in which they were placed."""
        return self._native.blocks

    @property
    def holds(self) -> dict[str, str]:
        """The names of the robots that hold a block, each with the name of this block."""
        return dict(self._native.holds)

    def check(self, *, margins: Margins = False, wedging: bool = False) -> Result:
        """Returns the complete analysis of the placed blocks. The scene of the result has these blocks and no steps."""
        return check(Scene._of_text(self._native.scene(False)), margins=margins, wedging=wedging, notes=False)

    def margins(self, *kinds: str) -> Any:
        """Returns the margins of the placed blocks: those of the given kinds, or all margins if no kind is given."""
        return self.check(margins=kinds or True).margins

    def signed_margin(self, kind: str = "tilt") -> float:
        """Returns one number that is positive if the placed blocks stand: :meth:`Result.signed_margin`."""
        return self.check(margins=kind).signed_margin(kind)

    def capacity(self, block: str, *points: Point, for_all: str | None = None) -> Any:
        """Returns all forces (Fx, Fy) that a block can carry at a point, in addition to its present loads.

        Without ``points``, the force acts at the centroid of the block; if a robot holds the block, the result instead
        contains the forces that this robot may exert at its grip point. With one point, the force acts at this point.
        With two points, the force acts at a contact between these points. ``for_all`` is that of
        :func:`drystone.check`.
        """
        return json.loads(self._native.capacity(_geometry.capacity_word((block, *points)), for_all), object_hook=Record)

    def scene(self) -> Scene:
        """Returns the session as a scene with steps.

        The first step places the blocks with which the session started, if there are any; then each step of the session
        follows. A block that is placed again in another way after it was removed gets another name, such as "a (2)".
        """
        return Scene._of_text(self._native.scene(True))

    def copy(self) -> Session:
        """Returns an independent session in the same state, in which steps can be tried."""
        made = Session.__new__(Session)
        made._native = self._native.copy()
        return made

    def __copy__(self) -> Session:
        return self.copy()

    def __deepcopy__(self, memo: object) -> Session:
        return self.copy()

    def __repr__(self) -> str:
        count = len(self.blocks)
        return f"<Session: {count} {'block' if count == 1 else 'blocks'}, {self.verdict}>"

    def _repr_svg_(self) -> str:
        return self.check().figure().svg()

    def _repr_html_(self) -> str:
        return self.check().figure()._repr_html_()
