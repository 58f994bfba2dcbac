"""Computes whether a structure of dry-laid blocks stands, and which forces act in it. Draws figures of the results.

>>> import drystone as ds
>>> scene = ds.Scene(friction=0.6).ground([(-1, -1), (7, -1), (7, 0), (-1, 0)])
>>> scene = scene.block("a", [(0, 0), (2, 0), (2, 1), (0, 1)], density=2400)
>>> ds.check(scene).stands
True
"""

from ._check import check, check_many
from ._drystone import __version__, kinds, schema, themes
from ._errors import DrystoneError, Problem, SceneError
from ._figure import Figure
from ._playground import playground
from ._result import Frame, Result, Results
from ._scene import Scene
from ._session import Session
from ._table import Record, Table
from ._vary import Variation, vary


def figure_kinds() -> dict[str, str]:
    """Returns a dict from each kind of figure to a line of help.

    The kind ``freebody``, the figure of one block, is not in this dict.
    """
    return dict(kinds())


__all__ = [
    "DrystoneError",
    "Figure",
    "Frame",
    "Problem",
    "Record",
    "Result",
    "Results",
    "Scene",
    "SceneError",
    "Session",
    "Table",
    "Variation",
    "__version__",
    "check",
    "check_many",
    "figure_kinds",
    "playground",
    "schema",
    "themes",
    "vary",
]
