"""The class :class:`Scene`, which builds a scene. Its keyword arguments have the names of the keys of a scene file."""

from __future__ import annotations

import copy
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from . import _compas, _drystone, _geometry
from ._errors import DrystoneError, SceneError
from ._figure import Figure
from ._geometry import Outline, Point


class Scene:
    """A structure of blocks, ground and robots, and the steps in which it is built.

    Lengths are in metres and forces in newtons, unless ``units`` sets other units. Masses are in kilograms, angles are
    in degrees anticlockwise, and y points up. The names of arguments are the keys of a scene file. Arguments that are
    not given have the defaults of the file format. Methods that add a part to a scene change this scene and return it.

    A scene is checked when it is analysed; :meth:`validate` checks a scene immediately, and :meth:`from_dict` too.

    >>> scene = Scene(friction=0.6).ground([(-1, -1), (7, -1), (7, 0), (-1, 0)])
    >>> scene.block("post", [(0, 0), (1, 0), (1, 3), (0, 3)], density=2400)
    <Scene: 1 block, 1 part of the ground>
    """

    def __init__(
        self,
        title: str | None = None,
        *,
        author: str | None = None,
        project: str | None = None,
        date: str | None = None,
        units: Mapping[str, str] | None = None,
        friction: float | None = None,
        friction_factor_on: Sequence[str] | None = None,
        density: float | None = None,
        thickness: float | None = None,
        gravity: Point | None = None,
        kernel: float | None = None,
        contact_tolerance: float | None = None,
        corner_contacts: bool | Literal["on_edges"] | None = None,
        grid: Mapping[str, Any] | None = None,
        vehicle: Mapping[str, Any] | None = None,
        expect: str | None = None,
        silence: Sequence[str] | None = None,
    ) -> None:
        keys = _without(locals(), "self")
        self._file: dict[str, Any] | None = {"drystone": 1, **keys, "blocks": []}
        # The text of the scene file; None if it has to be written from `_file`.
        self._text: str | None = None
        # True if the text was read from a file or a string. Only then do problems have lines and columns.
        self._located = False
        self._path: str | None = None

    @classmethod
    def from_json(cls, text: str) -> Scene:
        """Makes a scene from the text of a scene file. The problems of such a scene have lines and columns."""
        scene = cls()
        scene._file, scene._text, scene._located = None, text, True
        return scene

    @classmethod
    def _of_text(cls, text: str) -> Scene:
        """Makes a scene from text that nobody wrote, so that its problems have no lines and columns."""
        scene = cls.from_json(text)
        scene._located = False
        return scene

    @classmethod
    def from_dict(cls, file: Mapping[str, Any]) -> Scene:
        """Makes a scene from a dict with the keys of a scene file; ``drystone: 1`` and ``blocks`` may be left out.

        Raises :class:`SceneError` with all problems if the scene is not valid. A scene that becomes valid later is built
        with the methods of this class.
        """
        return cls._of_dict(file).validate()

    @classmethod
    def _of_dict(cls, file: Mapping[str, Any]) -> Scene:
        scene = cls()
        made = json.loads(_dumps({"drystone": 1, **file}))
        made.setdefault("blocks", [])
        scene._file = made
        return scene

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a scene from a scene file. Raises :class:`DrystoneError` if the file is not UTF-8 text."""
        try:
            text = Path(path).read_text(encoding="utf-8-sig")
        except UnicodeDecodeError as error:
            raise DrystoneError(f"{os.fspath(path)} is not UTF-8 text: {error}; save the file as UTF-8") from None
        scene = cls.from_json(text)
        scene._path = os.fspath(path)
        return scene

    @classmethod
    def from_compas(cls, assembly: Any, *, plane: str = "xz", **keys: Any) -> Scene:
        """Makes a scene from an assembly of prismatic blocks of ``compas_assembly``.

        Each block must be a prism perpendicular to ``plane`` ("xz", "yz" or "xy"). The scene has the outlines of the
        prisms in this plane. Supports become parts of the ground. ``keys`` are keyword arguments of :class:`Scene`; the
        default of ``thickness`` is the thickness of the blocks.
        """
        scene = cls(**keys)
        sections = json.loads(_drystone.compas(_compas.to_json(assembly), plane, keys.get("thickness")))
        scene._file = {**sections, **scene._loaded(), "ground": sections.get("ground", []), "blocks": sections["blocks"]}
        return scene

    def ground(
        self,
        polygon: Outline | None = None,
        *,
        id: str | None = None,
        holes: Iterable[Outline] | None = None,
        cells: Sequence[Sequence[Any]] | None = None,
        circle: Mapping[str, Any] | None = None,
        shape: str | None = None,
        at: Point | None = None,
        angle: float | None = None,
        friction: float | None = None,
        material: str | None = None,
        fill: str | None = None,
    ) -> Scene:
        """Adds a part of the ground, which supports any load. ``id`` names it in results and for :meth:`movement`."""
        keys = _without(locals(), "self", "polygon", "holes")
        return self._add("ground", _geometry.body(polygon, holes, keys))

    def block(
        self,
        id: str | None = None,
        polygon: Outline | None = None,
        *,
        holes: Iterable[Outline] | None = None,
        cells: Sequence[Sequence[Any]] | None = None,
        circle: Mapping[str, Any] | None = None,
        shape: str | None = None,
        at: Point | None = None,
        angle: float | None = None,
        centre: Point | None = None,
        weight: float | None = None,
        mass: float | None = None,
        density: float | None = None,
        friction: float | None = None,
        material: str | None = None,
        fill: str | None = None,
        placement: float | None = None,
    ) -> Scene:
        """Adds a rigid block.

        One of ``polygon``, ``cells``, ``circle`` and ``shape`` gives its outline. A circle is a dict with ``centre`` and
        ``radius``. ``centre`` replaces an outline, or is the centre of
        mass beside one. ``placement`` multiplies its errors when the placement tolerance is computed.
        """
        keys = _without(locals(), "self", "id", "polygon", "holes")
        return self._add("blocks", _geometry.block(id, polygon, holes, keys))

    def blocks(self, features: Any, *, id: str = "id", **keys: Any) -> Scene:
        """Adds a block for each feature of a FeatureCollection, such as a GeoDataFrame.

        ``features`` is a dict, or an object with ``__geo_interface__``. A column with the name of a key of a block,
        such as ``density`` or ``fill``, sets this key. ``id`` is the name of the column with the names of the blocks;
        without such a column, the blocks are numbered. ``keys`` are keys of all added blocks; a column takes
        precedence.
        """
        collection = getattr(features, "__geo_interface__", features)
        if not isinstance(collection, Mapping) or "features" not in collection:
            raise DrystoneError("blocks() needs a FeatureCollection, such as a GeoDataFrame; add a single block with block()")
        known = _drystone_keys("BlockEntry") - {"id", "polygon", "holes", "cells"}
        for feature in collection["features"]:
            columns = {key: value for key, value in (feature.get("properties") or {}).items() if not _is_missing(value)}
            own = {key: value for key, value in columns.items() if key in known and key != id}
            name = columns.get(id)
            self._add("blocks", _geometry.block(None if name is None else str(name), feature, None, {**keys, **own}))
        return self

    def shape(
        self,
        name: str,
        polygon: Outline | None = None,
        *,
        holes: Iterable[Outline] | None = None,
        cells: Sequence[Sequence[Any]] | None = None,
        circle: Mapping[str, Any] | None = None,
    ) -> Scene:
        """Adds a shape. The argument ``shape`` of blocks and of the ground refers to it by its name."""
        return self._name("shapes", name, _geometry.body(polygon, holes, {"cells": cells, "circle": circle}))

    def material(
        self,
        name: str,
        *,
        density: float | None = None,
        friction: float | None = None,
        fill: str | None = None,
    ) -> Scene:
        """Adds a material. The argument ``material`` of blocks and of the ground refers to it by its name."""
        return self._name("materials", name, _without(locals(), "self", "name"))

    def friction_pair(self, first: str, second: str, friction: float) -> Scene:
        """Sets the friction coefficient between the materials with the names ``first`` and ``second``."""
        return self._add("friction_pairs", {"between": [first, second], "friction": friction})

    def joint_set(
        self,
        id: str,
        *,
        direction: str | None = None,
        bodies: tuple[str, str] | None = None,
        materials: tuple[str, str] | None = None,
        friction: float | None = None,
    ) -> Scene:
        """Adds a set of joints, by their ``direction`` (``"bed"`` or ``"head"``), two ``bodies`` or two ``materials``.

        ``friction`` is the coefficient of its joints. The keyword ``friction_factor_on`` of a scene lists the names of the sets
        that the margin ``friction_factor`` multiplies.
        """
        return self._add("joint_sets", _without(locals(), "self"))

    def robot(
        self,
        id: str | None = None,
        *,
        limits: Mapping[str, float] | None = None,
        holds: str | None = None,
        at: Point | None = None,
    ) -> Scene:
        """Adds a robot. ``limits`` is a dict that may contain ``force``, ``fx`` and ``fy`` in N, and ``torque`` in N·m.

        ``holds`` is the block that the robot holds in a scene without steps, and ``at`` is the grip point on this
        block.
        """
        return self._add("robots", _without(locals(), "self"))

    def load(
        self,
        block: str | None = None,
        force: Point | None = None,
        *,
        at: Point | None = None,
        torque: float | None = None,
        id: str | None = None,
        pressure: float | Point | Mapping[str, float] | None = None,
        side: str | None = None,
        between: Sequence[Point] | None = None,
        fixed: bool | str | None = None,
    ) -> Scene:
        """Adds a load: a force in N, a torque in N·m or both on a block, or a pressure in N/m² on sides of blocks.

        ``pressure`` is a number, a pair of numbers at both ends, or a dict with ``surface``, ``unit_weight``,
        ``coefficient`` and ``friction_angle``. It acts on the ``side`` of the block ("left", "right", "top" or
        "bottom"), or on the free edges ``between`` two points. A ``fixed`` load keeps its amount when the load factor
        changes; with ``fixed="vertical"`` or ``"horizontal"`` only its part along gravity, or across it, does.
        """
        return self._add("loads", _without(locals(), "self"))

    def case(
        self,
        id: str,
        *,
        weights: float | None = None,
        loads: Mapping[str, float] | None = None,
    ) -> Scene:
        """Adds a load case: factors on all ``weights`` and on each of the ``loads`` that act, by their ids."""
        return self._add("cases", _without(locals(), "self"))

    def movement(
        self,
        ground: str,
        translation: Point | None = None,
        *,
        rotation: float | None = None,
        about: Point | None = None,
    ) -> Scene:
        """Asks how the structure follows a small movement of the part of the ground with the id ``ground``.

        The part is moved by ``translation`` and turned by ``rotation``, in degrees anticlockwise, about the point
        ``about`` (its centroid by default).
        """
        return self._add("movements", _without(locals(), "self"))

    def contact(
        self,
        bodies: Sequence[str],
        at: Point,
        normal: float,
        *,
        friction: float | None = None,
    ) -> Scene:
        """Adds a contact between two bodies at the point ``at``.

        ``normal`` is the direction of the normal, which points into the first body, in degrees anticlockwise from the x
        axis. If a scene lists contacts, drystone does not search for other contacts.
        """
        return self._add("contacts", _without(locals(), "self"))

    def step(
        self,
        title: str | None = None,
        *,
        release: Sequence[str] | None = None,
        remove: Sequence[str] | None = None,
        place: Sequence[str] | None = None,
        hold: Mapping[str, Any] | None = None,
        plan: Mapping[str, str] | None = None,
        expect: str | None = None,
    ) -> Scene:
        """Adds a step of the assembly.

        Robots first release blocks; then blocks are removed, placed and held, in this order.
        """
        return self._add("steps", _without(locals(), "self"))

    def validate(self) -> Scene:
        """Checks the scene without an analysis, and returns the scene.

        Raises :class:`SceneError` with all problems if the scene is not valid.
        """
        _drystone.read(self._json(), self._located)
        return self

    def to_dict(self) -> dict[str, Any]:
        """Returns the scene file as a dict."""
        made: dict[str, Any] = json.loads(_dumps(self._loaded()))
        return made

    def to_json(self) -> str:
        """Returns the text of the scene file.

        The text is returned as it was read. If the scene was made or changed in Python, drystone formats the text.
        """
        return self._json() if self._located else _drystone.formatted(self._json())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the scene to a scene file."""
        Path(path).write_text(self.to_json(), encoding="utf-8")

    def copy(self) -> Scene:
        """Returns an independent scene with the same content."""
        return copy.deepcopy(self)

    def __eq__(self, other: object) -> bool:
        return self.to_dict() == other.to_dict() if isinstance(other, Scene) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        try:
            file = self._loaded()
        except SceneError:
            return "<Scene: not valid JSON>"
        counted = [
            _counted(file, "blocks", "block", "blocks", always=True),
            _counted(file, "ground", "part of the ground", "parts of the ground"),
            _counted(file, "robots", "robot", "robots"),
            _counted(file, "steps", "step", "steps"),
        ]
        title = f" {file['title']!r}" if file.get("title") else ""
        return f"<Scene{title}: {', '.join(part for part in counted if part)}>"

    def _repr_svg_(self) -> str:
        """Returns an SVG figure of the forces, or of the problems if the scene is not valid."""
        return self._picture().svg()

    def _repr_html_(self) -> str:
        return self._picture()._repr_html_()

    def _picture(self) -> Figure:
        try:
            analysis = _drystone.check(self._json(), _drystone.Options("{}"))
        except SceneError:
            return Figure.of_problems(self._json())
        return Figure.of_analysis(analysis, None, {"kind": "forces"})

    def _json(self) -> str:
        """Returns the text of the scene file that an analysis reads."""
        if self._text is None:
            self._text = _dumps(self._file)
        return self._text

    def _frozen(self) -> Scene:
        """Returns a copy with the present content. Later changes of this scene do not change the copy."""
        made = object.__new__(type(self))
        made._file, made._text, made._located, made._path = None, self._json(), self._located, self._path
        return made

    def _loaded(self) -> dict[str, Any]:
        """Returns the scene file as a dict. If there is only the text so far, the dict is read from the text."""
        if self._file is None:
            text = self._json()
            try:
                self._file = json.loads(text)
            except ValueError:
                _drystone.read(text, self._located)
                raise
            if not isinstance(self._file, dict):
                self._file = None
                _drystone.read(text, self._located)
        assert self._file is not None
        return self._file

    def _changed(self) -> dict[str, Any]:
        file = self._loaded()
        self._text, self._located = None, False
        return file

    def _add(self, key: str, entry: dict[str, Any]) -> Scene:
        self._changed().setdefault(key, []).append(entry)
        return self

    def _name(self, key: str, name: str, entry: dict[str, Any]) -> Scene:
        self._changed().setdefault(key, {})[name] = entry
        return self


AnyScene = Scene | Mapping[str, Any] | os.PathLike[str]


def as_scene(scene: AnyScene) -> Scene:
    """Converts a scene, a dict with the keys of a scene file, or the path of a scene file to a scene."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, Mapping):
        return Scene._of_dict(scene)
    if isinstance(scene, os.PathLike):
        return Scene.from_file(scene)
    kind = type(scene).__name__
    raise TypeError(f"a {kind} is not a scene; give a Scene, a dict or a pathlib.Path, and read text with Scene.from_json")


_encode = json.JSONEncoder(default=_geometry.plain, separators=(",", ":"), allow_nan=False).encode


def _dumps(value: object) -> str:
    try:
        return _encode(value)
    except ValueError as error:
        raise DrystoneError(f"a number of the scene is infinite or not a number: {error}") from None


def _without(names: dict[str, Any], *left_out: str) -> dict[str, Any]:
    given = {name: value for name, value in names.items() if value is not None}
    for name in left_out:
        given.pop(name, None)
    return given


def _is_missing(value: object) -> bool:
    return value is None or value != value


def _counted(file: dict[str, Any], key: str, one: str, several: str, *, always: bool = False) -> str:
    count = len(file.get(key) or ())
    return f"{count} {one if count == 1 else several}" if count or always else ""


def _drystone_keys(name: str) -> set[str]:
    """Returns the keys of one type of object in a scene file, from the JSON Schema.

    ``name`` is, for example, "BlockEntry".
    """
    schema = json.loads(_drystone.schema())
    return set(schema["$defs"][name]["properties"])
