"""Writes assemblies of ``compas_assembly`` as JSON, which drystone reads."""

from __future__ import annotations

import json
from typing import Any


def to_json(assembly: Any) -> str:
    """Returns the nodes of an assembly with their blocks, as ``compas.json_dumps`` of any version writes them."""
    graph = getattr(assembly, "graph", assembly)
    nodes = {}
    for node in graph.nodes():
        block = graph.node_attribute(node, "block")
        block = block if block is not None else assembly.node_block(node)
        is_support = graph.node_attribute(node, "is_support") or getattr(block, "is_support", False)
        nodes[str(node)] = {"block": _mesh(block), "is_support": bool(is_support)}
    return json.dumps({"node": nodes})


def _mesh(block: Any) -> dict[str, Any]:
    faces = {str(face): [str(vertex) for vertex in block.face_vertices(face)] for face in block.faces()}
    vertices = {}
    for face in block.faces():
        for vertex in block.face_vertices(face):
            at = block.vertex_coordinates(vertex)
            vertices[str(vertex)] = {axis: float(x) for axis, x in zip("xyz", at)}
    return {"vertex": vertices, "face": faces}
