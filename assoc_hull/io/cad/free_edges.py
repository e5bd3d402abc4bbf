"""Edges that one face alone has: the rim of a shell, or seams that nobody sewed.

Of a hull the deck edge, the rim of a transom and, of a half, the centre line are free. Where one
free edge lies along another, two faces meet that are not joined.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import permutations
from typing import Any

__all__ = ["free_edges", "lie_along"]

_NEAR = 0.1
"""Edges nearer than this (mm) run along one another."""

_PLACES = (0.2, 0.45, 0.7)
"""Where on an edge it is looked whether another is there."""


def free_edges(shape: Any) -> tuple[list[Any], int]:
    """Give the free edges of a shape, and how many edges join two faces.

    Parameters
    ----------
    shape : TopoDS_Shape
        Faces; sides that are points count as no edges.
    """
    from OCP.BRep import BRep_Tool
    from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    known, count = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher(), Counter[int]()
    faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        edges = TopExp_Explorer(faces.Current(), TopAbs_ShapeEnum.TopAbs_EDGE)
        while edges.More():
            edge = TopoDS.Edge(edges.Current())
            if not BRep_Tool.Degenerated_s(edge):
                count[known.Add(edge)] += 1
            edges.Next()
        faces.Next()
    free = [TopoDS.Edge(known.FindKey(key)) for key, times in count.items() if times == 1]
    return free, len(count) - len(free)


def lie_along(edges: Sequence[Any]) -> int:
    """Count the edges that run along another one, wholly or over most of their length.

    Parameters
    ----------
    edges : sequence of TopoDS_Edge
        Free edges.
    """
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    boxes = []
    for edge in edges:
        box = Bnd_Box()
        BRepBndLib.Add_s(edge, box)
        box.Enlarge(_NEAR)
        boxes.append(box)
    found = {
        one
        for one, other in permutations(range(len(edges)), 2)
        if not boxes[one].IsOut(boxes[other]) and _lies_along(edges[one], edges[other])
    }
    return len(found)


def _lies_along(edge: Any, other: Any) -> bool:
    """Tell whether places within an edge lie on another."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.Extrema import Extrema_ExtPC

    curve, target = BRepAdaptor_Curve(edge), BRepAdaptor_Curve(other)
    first, length = curve.FirstParameter(), curve.LastParameter() - curve.FirstParameter()
    for place in _PLACES:
        feet = Extrema_ExtPC(curve.Value(first + place * length), target)
        squares = [feet.SquareDistance(i) for i in range(1, feet.NbExt() + 1)]
        if min(squares, default=_NEAR**2) >= _NEAR**2:
            return False
    return True
