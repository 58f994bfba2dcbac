"""Makes scenes from assemblies of ``compas_assembly``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from ._errors import DrystoneError

if TYPE_CHECKING:
    from ._scene import Scene

S = TypeVar("S", bound="Scene")

_PLANES = {"xz": (0, 2, 1), "yz": (1, 2, 0), "xy": (0, 1, 2)}
"""For each plane: the indices of the axes that point right, up, and perpendicular to the plane (0: x, 1: y, 2: z)."""


def scene_of(cls: type[S], assembly: Any, plane: str, keys: dict[str, Any]) -> S:
    """Makes a scene of the class ``cls`` from an assembly. ``keys`` are the keyword arguments of the scene."""
    if plane not in _PLANES:
        raise DrystoneError(f'plane is "xz", "yz" or "xy", not {plane!r}')
    right, up, across = _PLANES[plane]
    supports, blocks, depths = [], [], []
    for node, block in _blocks(assembly):
        outline, depth = _prism(block, node, right, up, across)
        depths.append(depth)
        if _is_support(assembly, node, block):
            supports.append(outline)
        else:
            blocks.append((str(node), outline))
    if not blocks:
        raise DrystoneError("all blocks of the assembly are supports; a scene needs a block that is not a support")
    if "thickness" not in keys:
        if max(depths) - min(depths) > 1e-6 * max(depths):
            raise DrystoneError(
                f"the blocks are {min(depths):.6g} to {max(depths):.6g} m thick, but a scene has only one thickness; "
                "give it in metres with thickness="
            )
        keys = {**keys, "thickness": depths[0]}
    scene = cls(**keys)
    for outline in supports:
        scene.ground(outline)
    for name, outline in blocks:
        scene.block(name, outline)
    return scene


def _blocks(assembly: Any) -> list[tuple[Any, Any]]:
    """Returns the blocks of an assembly as pairs (node, block), for every version of ``compas_assembly``."""
    graph = getattr(assembly, "graph", assembly)
    pairs = []
    for node in graph.nodes():
        block = graph.node_attribute(node, "block")
        pairs.append((node, block if block is not None else assembly.node_block(node)))
    return pairs


def _is_support(assembly: Any, node: Any, block: Any) -> bool:
    graph = getattr(assembly, "graph", assembly)
    return bool(graph.node_attribute(node, "is_support")) or bool(getattr(block, "is_support", False))


def _prism(block: Any, node: Any, right: int, up: int, across: int) -> tuple[list[list[float]], float]:
    """Returns the outline of a prism, and its thickness perpendicular to the plane of the scene, in metres.

    ``right``, ``up`` and ``across`` are the axes in ``_PLANES``. Raises :class:`DrystoneError` if the block is not a
    prism.
    """
    ends = []
    for face in block.faces():
        corners = [block.vertex_coordinates(vertex) for vertex in block.face_vertices(face)]
        depths = [corner[across] for corner in corners]
        if max(depths) - min(depths) < 1e-9 + 1e-6 * max(abs(c) for corner in corners for c in corner):
            ends.append((sum(depths) / len(depths), corners))
    seen = [sorted((round(c[right], 6), round(c[up], 6)) for c in corners) for _, corners in ends]
    if len(ends) != 2 or seen[0] != seen[1]:
        raise DrystoneError(
            f"block {node} is not a prism perpendicular to the plane of the scene: it has {len(ends)} faces parallel to the "
            "plane, but a prism has two with the same outline; choose another plane= or rotate the assembly"
        )
    (near, corners), (far, _) = sorted(ends, key=lambda end: end[0])
    return [[float(corner[right]), float(corner[up])] for corner in corners], float(far - near)
