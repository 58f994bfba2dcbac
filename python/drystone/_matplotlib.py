"""Draws structures and forces on axes of matplotlib."""

from __future__ import annotations

import math
from typing import Any

from . import _drystone
from ._errors import DrystoneError
from ._table import Table


_PLATE = {"facecolor": "#e9e4d8", "edgecolor": "none", "alpha": 0.8, "pad": 1.0}
"""The style of the box behind the name of a block. The box keeps the name readable where arrows cross it."""


def draw(analysis: _drystone.Analysis, frame: int, ax: Any, *, forces: bool, labels: bool) -> Any:
    """Draws the frame with the index ``frame`` in metres and returns the axes.

    New axes are made if ``ax`` is ``None``.
    """
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise DrystoneError("draw() needs matplotlib; install it, or use figure()") from None
    if ax is None:
        _, ax = plt.subplots()
    placed = set(analysis.placed(frame))
    number = 0
    corners: list[list[float]] = []
    for name, rings in analysis.outlines():
        if name is None:
            _body(ax, rings, "ground", facecolor="0.75", edgecolor="none", zorder=1)
        else:
            if number in placed:
                corners += rings[0]
                _body(ax, rings, f"block:{name}", facecolor="#e9e4d8", edgecolor="0.25", zorder=2)
            number += 1
    if labels:
        for row in _rows(analysis, "blocks", frame):
            ax.text(row["x"], row["y"], row["id"], ha="center", va="center", zorder=5, bbox=_PLATE, gid=f"label:{row['id']}")
    if forces:
        _forces(ax, analysis, frame, corners)
    ax.set_aspect("equal")
    ax.autoscale_view()
    return ax


def _body(ax: Any, rings: list[list[list[float]]], gid: str, **look: Any) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    points: list[list[float]] = []
    codes: list[Any] = []
    for ring in rings:
        points += [*ring, ring[0]]
        codes += [Path.MOVETO, *[Path.LINETO] * (len(ring) - 1), Path.CLOSEPOLY]
    ax.add_patch(PathPatch(Path(points, codes), gid=gid, **look))


def _forces(ax: Any, analysis: _drystone.Analysis, frame: int, corners: list[list[float]]) -> None:
    """Draws arrows for the forces of contacts, robots and failures, all in the same scale. The longest arrow is a third
    as long as the structure is wide or high, whichever is larger. ``corners`` are the corners of the placed blocks.
    """
    from matplotlib.patches import FancyArrowPatch

    arrows = []
    for row in _rows(analysis, "contacts", frame):
        gid = f"force:{row['body_0']}:{row['body_1']}"
        arrows.append((row["x"], row["y"], row["force_x"], row["force_y"], gid, "#1f5fa8"))
        if row["block_1"] >= 0:
            gid = f"force:{row['body_1']}:{row['body_0']}"
            arrows.append((row["x"], row["y"], -row["force_x"], -row["force_y"], gid, "#1f5fa8"))
    for row in _rows(analysis, "robots", frame):
        arrows.append((row["x"], row["y"], row["force_x"], row["force_y"], f"force:{row['id']}", "#2b8a3e"))
    for row in _rows(analysis, "failures", frame):
        gid = f"failure:{row['body_0']}:{row['body_1'] or row['robot']}"
        arrows.append((row["x"], row["y"], row["force_x"], row["force_y"], gid, "#c92a2a"))
    largest = max((math.hypot(a[2], a[3]) for a in arrows), default=0.0)
    if largest == 0.0 or not corners:
        return
    sides = [max(c[k] for c in corners) - min(c[k] for c in corners) for k in (0, 1)]
    scale = max(sides) / 3.0 / largest
    for x, y, force_x, force_y, gid, colour in arrows:
        if math.hypot(force_x, force_y) > 1e-9 * largest:
            end = (x + scale * force_x, y + scale * force_y)
            look: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 10, "shrinkA": 0, "shrinkB": 0}
            ax.add_patch(FancyArrowPatch((x, y), end, color=colour, zorder=4, gid=gid, **look))
            ax.update_datalim([(x, y), end])


def _rows(analysis: _drystone.Analysis, name: str, frame: int) -> list[dict[str, Any]]:
    return Table(analysis.table(name, frame), name).to_dicts()
