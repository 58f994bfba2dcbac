"""The directive ``drystone`` of Sphinx, which draws scenes in its pages.

Add ``"drystone.sphinx"`` to ``extensions`` in ``conf.py``. The argument of the directive is a scene file; without it, the
content is the scene. In reStructuredText::

    .. drystone:: arch.json
       :kind: thrust
       :theme: auto

In Markdown with MyST the first line is ````` ```{drystone} arch.json ````` instead.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective

from . import figure_kinds
from ._check import check
from ._errors import DrystoneError
from ._scene import Scene

if TYPE_CHECKING:
    from sphinx.application import Sphinx


class Drystone(SphinxDirective):
    """A figure with a caption. Its options are ``kind``, ``block``, ``theme``, ``width-mm``, ``amounts``, ``caption`` (an
    own one, which is also the text for screen readers), ``nocaption`` and ``name``.
    """

    has_content = True
    optional_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar[dict[str, Any]] = {
        "kind": lambda word: directives.choice(word, tuple(figure_kinds())),
        "block": directives.unchanged_required,
        "theme": directives.unchanged_required,
        "width-mm": float,
        "amounts": directives.flag,
        "caption": directives.unchanged_required,
        "nocaption": directives.flag,
        "name": directives.unchanged_required,
    }

    def run(self) -> list[nodes.Node]:
        """Returns the figure, whose pictures are in the folder of the doctrees: an SVG, and a PDF for LaTeX."""
        options = self.options
        try:
            if self.arguments:
                name, path = self.env.relfn2path(self.arguments[0], self.env.docname)
                self.env.note_dependency(name)
                scene = Scene.from_file(path)
            else:
                scene = Scene.from_json("\n".join(self.content))
            result = check(scene)
            look = {"block": options.get("block"), "amounts": True if "amounts" in options else None}
            figure = result.figure(
                options.get("kind", "forces"), theme=options.get("theme"), width_mm=options.get("width-mm"), **look
            )
            pictures = {"svg": figure.svg().encode(), "pdf": figure.pdf()}
        except (OSError, DrystoneError) as problem:
            raise self.error(str(problem)) from None
        stem = Path(self.env.doctreedir) / "drystone" / hashlib.sha256(pictures["svg"]).hexdigest()[:16]
        stem.parent.mkdir(parents=True, exist_ok=True)
        for ending, picture in pictures.items():
            stem.with_suffix(f".{ending}").write_bytes(picture)
        caption = options.get("caption") or result._native.caption()
        uri = Path("/", os.path.relpath(stem, self.env.srcdir)).as_posix()
        drawn = nodes.figure("", nodes.image(uri=f"{uri}.*", alt=caption), classes=["drystone"])
        if "nocaption" not in options:
            drawn += nodes.caption("", caption)
        self.set_source_info(drawn)
        self.add_name(drawn)
        return [drawn]


def setup(app: Sphinx) -> dict[str, Any]:
    """Adds the directive to Sphinx."""
    app.add_directive("drystone", Drystone)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
