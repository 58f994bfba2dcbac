"""Results of an analysis. The attributes of a result have the names of the keys of the JSON result."""

from __future__ import annotations

import hashlib
import html
import json
import os
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, overload

from . import _drystone
from ._errors import DrystoneError, SceneError
from ._figure import Figure, animate, html_image
from ._matplotlib import draw
from ._scene import Scene
from ._table import Record, Table

if TYPE_CHECKING:
    import numpy


class _Answer:
    """The base class of :class:`Result` (all frames) and :class:`Frame` (one frame)."""

    _native: _drystone.Analysis
    _frame: int | None

    @property
    def contacts(self) -> Table:
        """A table of the contacts between bodies, with the forces on ``body_0`` in N."""
        return self._table("contacts")

    @property
    def failures(self) -> Table:
        """A table of the failures: the missing forces and torques with which the blocks would stand, in N and N·m."""
        return self._table("failures")

    @property
    def blocks(self) -> Table:
        """A table of the placed blocks: weight in N, area in m², centroid in m, and motion as the collapse begins."""
        return self._table("blocks")

    @property
    def robots(self) -> Table:
        """A table of the robots that hold a block, with their forces on the block in N and their torques in N·m."""
        return self._table("robots")

    def _table(self, name: str) -> Table:
        return Table(self._native.table(name, self._frame), name)

    def signed_margin(self, kind: str = "tilt") -> float:
        """Returns one number that is positive if the structure stands and negative if it falls, as a reward of a search.

        It is the distance of the present value of a margin from the nearest limit, as a share: 0 at the limit, at most 1,
        and at least -1. If the structure stands at no value, it is between -1 and -2, and less if more force is missing.
        ``kind`` is "tilt" (a share of 90 degrees), "load_factor", "friction_factor", "horizontal_load", "kernel",
        "sliding", "overturning" or "middle_third"; the last three are positive if the structure stands in this condition. The margin must have been computed: ``check(scene, margins="tilt")``. Of
        several frames, the least number counts. It is not a number (``nan``) if a verdict that it needs is undecided, and
        for a structure that falls, with ``verdict_only=True``.
        """
        return self._native.signed_margin(kind, self._frame)

    def figure(self, kind: str = "forces", *, theme: str | None = None, width_mm: float | None = None, **options: Any) -> Figure:
        """Returns a figure of a kind in ``drystone.figure_kinds()``, in a theme in ``drystone.themes()``.

        ``width_mm`` is the printed width: 84 for one column of a journal, 174 for two columns. ``options`` are options
        of ``drystone render``, such as ``amounts=True``, ``block="a"`` and ``no_title=True``. ``style`` is the path of a
        style file, or a dict with what such a file has: ``style={"failure": "#d00", "widths": {"force": 0.06}}``.

        For the kind "mechanism", the argument ``at``, such as ``at="tilt"``, selects the margin beyond which it falls, or
        another motion. For the kind "sensitivity", the argument ``margin`` selects the margin. For the kind "capacity", the argument ``capacity`` selects the block and the point, as in
        :func:`drystone.check`. If the result lacks values that a figure shows, these values are computed for the
        figure.
        """
        return Figure.of_analysis(self._native, self._frame, {"kind": kind, "theme": theme, "width_mm": width_mm, **options})

    def animate(self, path: str | os.PathLike[str], *, seconds: float = 1.0, kind: str = "forces", **options: Any) -> None:
        """Writes an animation of the frames as a ``.gif`` or an animated ``.png``.

        Each frame is shown for ``seconds``.
        """
        animate(self._native, self._frame, path, {"kind": kind, "animate": seconds, **options})

    def draw(self, ax: Any = None, *, forces: bool = True, labels: bool = True) -> Any:
        """Draws one frame on axes of matplotlib, in metres, and returns the axes.

        A result of several frames draws the last frame. If ``ax`` is ``None``, new axes are made. Blocks are patches
        and forces are arrows in ``ax.patches``. The ``gid`` of a patch or an arrow is "ground", "block:NAME",
        "force:NAME" or "failure:NAME", so that a script can find and change it.
        """
        frame = self._frame if self._frame is not None else len(self._native.verdicts()) - 1
        return draw(self._native, frame, ax, forces=forces, labels=labels)


class Frame(_Answer):
    """The result for one frame. Every key of an entry of ``frames`` in the JSON result is an attribute."""

    def __init__(self, result: Result, number: int) -> None:
        self._result = result
        self._native = result._native
        self._frame = number

    @property
    def number(self) -> int:
        """The index of this frame in the list of frames, from 0."""
        assert self._frame is not None
        return self._frame

    @property
    def verdict(self) -> str:
        """The verdict for this frame: "stable", "unstable" or "undecided"."""
        return self._native.verdicts()[self.number]

    @property
    def stands(self) -> bool:
        """Whether this frame is proved to stand."""
        return self.verdict == "stable"

    @property
    def margins(self) -> Any:
        """The margins of this frame, which show how far it is from collapse. ``None`` if no margins were requested."""
        return self._record().get("margins")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._record(), name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._record()]

    def __bool__(self) -> bool:
        raise TypeError("a frame cannot be used as a truth value; use .stands")

    def to_dict(self, *, timing: bool = True) -> dict[str, Any]:
        """Returns the entry of this frame in the list ``frames`` of :meth:`Result.to_dict`."""
        made: dict[str, Any] = self._result.to_dict(timing=timing)["frames"][self.number]
        return made

    def _record(self) -> Record:
        record: Record = self._result._record()["frames"][self.number]
        return record

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return f"<Frame {self.number}{title}: {_WORDS[self.verdict]}>"

    def _repr_html_(self) -> str:
        return f"<p><b>{html.escape(repr(self)[1:-1])}</b></p>{self.figure()._repr_html_()}"


class Result(_Answer):
    """The result for a scene. Every key of the output of ``drystone check --json`` is an attribute.

    A result can be copied and pickled, like its frames and figures. A copy costs nothing. A pickle contains the scene and
    the options, and unpickling solves the scene again: send a table, a dict or a verdict between processes where this
    takes too long.
    """

    def __init__(self, native: _drystone.Analysis, scene: Scene) -> None:
        self._native = native
        self._frame = None
        self._scene = scene._frozen()
        self._path = scene._path
        self._read: Record | None = None

    @property
    def scene(self) -> Scene:
        """The scene as it was when it was analysed."""
        return self._scene

    @property
    def stands(self) -> bool:
        """Whether every frame is proved to stand."""
        return self._native.stands()

    @property
    def verdict(self) -> str:
        """The worst verdict of all frames: "stable", "unstable" or "undecided"."""
        verdicts = self._native.verdicts()
        return next((word for word in ("unstable", "undecided") if word in verdicts), "stable")

    @property
    def frames(self) -> list[Frame]:
        """The frames of the result: one for each step, or a single frame if the scene has no steps."""
        return [Frame(self, number) for number in range(len(self._native.verdicts()))]

    @property
    def margins(self) -> Any:
        """The margins of the only frame. If the scene has several frames, use ``frames[i].margins``."""
        frames = self.frames
        if len(frames) != 1:
            raise DrystoneError(f"the scene has {len(frames)} frames, each with its own margins; use frames[i].margins")
        return frames[0].margins

    def to_json(self, *, timing: bool = True) -> str:
        """Returns the result as JSON, as ``drystone check --json`` prints it.

        ``timing=False`` leaves out solving times.
        """
        return self._native.to_json(self._path, timing, True)

    def to_dict(self, *, timing: bool = True) -> dict[str, Any]:
        """Returns the result of ``drystone check --json`` as a dict. ``timing=False`` leaves out solving times."""
        made: dict[str, Any] = json.loads(self._native.to_json(self._path, timing, False))
        return made

    def certificate(self) -> str:
        """Returns the JSON that ``drystone check --certificate`` writes: proofs that anybody can check exactly.

        It proves the verdicts, and the margins and the capacity if they were computed. It contains the hash of the scene
        file that ``scene.save`` writes.
        """
        return self._native.certificate(hashlib.sha256(self._scene.to_json().encode()).hexdigest())

    def report(self, path: str | os.PathLike[str], *, title: str | None = None, theme: str | None = None) -> None:
        """Writes a report on the scene to a ``.html``, ``.pdf``, ``.md`` or ``.json`` file."""
        text = self.scene.to_json()
        self._native.report(os.fspath(path), self._path or "scene.json", text, title, theme)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_read": None}

    def _record(self) -> Record:
        if self._read is None:
            self._read = json.loads(self._native.to_json(self._path, True, False), object_hook=Record)
        return self._read

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._record(), name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._record()]

    def __bool__(self) -> bool:
        raise TypeError("a result cannot be used as a truth value; use .stands")

    def __repr__(self) -> str:
        verdicts = self._native.verdicts()
        if len(verdicts) == 1:
            return f"<Result: {_WORDS[verdicts[0]]}>"
        return f"<Result: {len(verdicts)} frames, {_counted(verdicts)}>"

    def _repr_svg_(self) -> str:
        return self.figure().svg()

    def _repr_html_(self) -> str:
        frames = self.frames
        rows = "".join(
            f"<tr><td>{frame.number}</td><td style='text-align:left'>{html.escape(frame.title)}</td>"
            f"<td>{_WORDS[frame.verdict]}</td><td>{frame.weight:.4g} N</td><td>{frame.total_sticking:.4g} N</td></tr>"
            for frame in frames
        )
        head = "<tr><th>frame</th><th>title</th><th>verdict</th><th>weight</th><th>missing</th></tr>"
        table = f"<table><thead>{head}</thead><tbody>{rows}</tbody></table>"
        return html_image(self.figure().svg()) + table


class Results(Sequence["Result | SceneError"]):
    """The results of many scenes, in the order of the scenes."""

    def __init__(self, results: list[Result | SceneError]) -> None:
        self._results = results

    @overload
    def __getitem__(self, index: int) -> Result | SceneError: ...
    @overload
    def __getitem__(self, index: slice) -> Results: ...
    def __getitem__(self, index: int | slice) -> Result | SceneError | Results:
        if isinstance(index, slice):
            return Results(self._results[index])
        return self._results[index]

    def __len__(self) -> int:
        return len(self._results)

    def __iter__(self) -> Iterator[Result | SceneError]:
        return iter(self._results)

    @property
    def verdicts(self) -> list[str]:
        """The verdict for each scene, or "refused" for a scene that is not valid."""
        return ["refused" if isinstance(one, SceneError) else one.verdict for one in self._results]

    @property
    def table(self) -> Table:
        """A table with a row for each frame of each valid scene: verdict, sums of forces, margins and signed margins.

        For each robot that holds a block somewhere, the column ``force_NAME`` has the size of its force in N, and ``nan``
        where it holds nothing.
        """
        natives = [None if isinstance(one, SceneError) else one._native for one in self._results]
        return Table(_drystone.summary(natives), "results")

    def to_pandas(self) -> Any:
        """Returns the table as a pandas DataFrame."""
        return self.table.to_pandas()

    def to_numpy(self) -> numpy.ndarray[Any, Any]:
        """Returns the table :attr:`table` as a structured array."""
        return self.table.to_numpy()

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return self.table.__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        counts = _counted(self.verdicts)
        return f"<Results: {len(self)} scenes{': ' if counts else ''}{counts}>"

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(repr(self)[1:-1])}</p>{self.table._repr_html_()}"


_WORDS = {"stable": "stands", "unstable": "falls", "undecided": "undecided"}


_PLURALS = {"stable": "stand", "unstable": "fall", "undecided": "undecided", "refused": "not valid"}


def _counted(verdicts: list[str]) -> str:
    """Returns the number of scenes or frames with each verdict in words, such as "2 stand, 1 falls"."""
    counts = [(verdicts.count(word), word, plural) for word, plural in _PLURALS.items() if word in verdicts]
    return ", ".join(f"{count} {_WORDS.get(word, plural) if count == 1 else plural}" for count, word, plural in counts)
