"""Figures and animations."""

from __future__ import annotations

import base64
import json
import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _drystone, _geometry
from ._errors import DrystoneError
from ._geometry import capacity_word

_FORMATS = ("svg", "png", "pdf", "tikz")


class Figure:
    """A figure of a result or of a scene.

    A figure is drawn when it is converted to a format. A notebook displays it.
    """

    def __init__(
        self,
        analysis: _drystone.Analysis | None,
        frame: int | None,
        options: Mapping[str, Any],
        text: str = "",
    ) -> None:
        self._analysis = analysis
        self._frame = frame
        self._options = dict(options)
        self._text = text

    @classmethod
    def of_analysis(cls, analysis: _drystone.Analysis, frame: int | None, options: Mapping[str, Any]) -> Figure:
        """Makes a figure of one frame of an analysis, or of all frames if ``frame`` is ``None``."""
        warn_of_old_names(options, 4)
        return cls(analysis, frame, options)

    @classmethod
    def of_problems(cls, text: str) -> Figure:
        """Makes a figure of a scene that is not valid, from its text: the outlines, with the problems marked."""
        return cls(None, None, {}, text)

    def svg(self) -> str:
        """Returns the figure as SVG."""
        return self._bytes("svg", {}).decode()

    def png(self, *, width: int | None = None, scale: float | None = None, dpi: float | None = None) -> bytes:
        """Returns the figure as PNG. The size of the picture is given by ``width`` in pixels, by ``scale`` in pixels
        per unit of the drawing, or by ``dpi`` in dots per inch together with the ``width_mm`` of the figure.
        """
        return self._bytes("png", {"width": width, "scale": scale, "dpi": dpi})

    def pdf(self) -> bytes:
        """Returns the figure as PDF with embedded fonts."""
        return self._bytes("pdf", {})

    def tikz(self) -> str:
        """Returns the figure as TikZ, for LaTeX."""
        return self._bytes("tikz", {}).decode()

    def save(self, path: str | os.PathLike[str], **options: Any) -> None:
        """Writes the figure to a ``.svg``, ``.png``, ``.pdf`` or ``.tikz`` file. ``options`` are additional options."""
        ending = Path(path).suffix[1:].lower()
        if ending not in _FORMATS:
            raise DrystoneError(f"{os.fspath(path)}: a figure can be saved as .{', .'.join(_FORMATS)}")
        Path(path).write_bytes(self._bytes(ending, options))

    def _bytes(self, ending: str, options: Mapping[str, Any]) -> bytes:
        request = request_json({**self._options, **options})
        if self._analysis is None:
            return _drystone.sketch(self._text, request, ending)
        return self._analysis.figure(request, ending, self._frame)

    def _repr_svg_(self) -> str:
        return self.svg()

    def _repr_html_(self) -> str:
        return html_image(self.svg())

    def __repr__(self) -> str:
        return f"<Figure: {self._options.get('kind', 'problems')}>"


def request_json(options: Mapping[str, Any]) -> str:
    """Returns options as a JSON object, with the names of the options of ``drystone check`` and ``drystone render``."""
    given = {name: value for name, value in options.items() if value is not None}
    if isinstance(given.get("style"), Mapping):
        given["style"] = json.dumps(given["style"], default=_geometry.plain)
    if "capacity" in given:
        given["capacity"] = capacity_word(given["capacity"])
    return json.dumps(given, default=_geometry.plain)


def warn_of_old_names(options: Mapping[str, Any], level: int) -> None:
    """Warns if an option has a name of the last version, and says the new one."""
    note = _drystone.new_name(options.get("kind"), options.get("fill"))
    if note is not None:
        warnings.warn(note, FutureWarning, stacklevel=level)


def animate(
    analysis: _drystone.Analysis,
    frame: int | None,
    path: str | os.PathLike[str],
    options: Mapping[str, Any],
) -> None:
    """Writes an animation of the frames to a ``.png`` or ``.gif`` file; of one frame if ``frame`` is not ``None``."""
    warn_of_old_names(options, 4)
    ending = Path(path).suffix.lower()
    if ending not in (".png", ".gif"):
        raise DrystoneError(f"{os.fspath(path)}: an animation can be saved as .png or .gif")
    Path(path).write_bytes(analysis.figure(request_json(options), ending[1:], frame))


def html_image(svg: str) -> str:
    """Returns an HTML element ``img`` that contains the SVG.

    In an ``img``, the ids in the SVG cannot conflict with ids of other figures on the page.
    """
    data = base64.b64encode(svg.encode()).decode()
    return f'<img alt="Figure" style="max-width:100%" src="data:image/svg+xml;base64,{data}">'
