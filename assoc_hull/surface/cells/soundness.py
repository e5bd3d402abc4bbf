"""Whether the lines of a net part a hull into cells; if not, which of them are at fault."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.net.gather import Net
from assoc_hull.errors import OpenNetError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.surface.cells.net_graph import NetGraph
from assoc_hull.surface.cells.stops import united
from assoc_hull.surface.cells.unnoted import REACH, unnoted_crossings

__all__ = ["check_faces", "check_lines", "check_outline", "missed_crossings"]

_FAR = 5e-3
"""So far apart (lengths of the hull) lines are named that may have been meant to cross."""


def check_lines(graph: NetGraph) -> None:
    """Refuse lines that enclose nothing, that end nowhere, and that do not hang together.

    Raises
    ------
    OpenNetError
        With the lines.
    """
    if not len(graph.edge):
        raise OpenNetError(
            "they cross nowhere, or enclose nothing", (),
            "a profile, a deck edge and sections are the least",
        )  # fmt: skip
    if len(graph.loose):
        raise OpenNetError(
            "lines end on no other line", _ends(graph.net, graph.loose),
            "draw the line that they end on, or lead them to one",
        )  # fmt: skip
    part = united(len(graph.place), graph.edge)
    if (part != part[0]).any():
        size = np.bincount(part)
        lost = np.unique(graph.curve[part[graph.edge[:, 0]] != size.argmax()])
        raise OpenNetError(
            f"they fall into {np.count_nonzero(size)} parts that do not meet",
            tuple(graph.net.name[c] for c in lost.tolist()),
            "draw lines that cross both, or leave these out",
        )  # fmt: skip


def check_faces(graph: NetGraph, faces: int) -> None:
    """Refuse edges that cannot be drawn on half a hull without crossing one another.

    Raises
    ------
    OpenNetError
        With crossings that the table does not hold.
    """
    euler = len(graph.place) - len(graph.edge) + faces
    if euler != 2:
        raise OpenNetError(
            f"nodes - edges + faces is {euler}, not 2, as where a crossing is missing",
            missed_crossings(graph, _FAR),
            "associate the groups of these lines, or leave one of them out",
        )


def missed_crossings(graph: NetGraph, reach: float = REACH) -> tuple[str, ...]:
    """Name the lines that cross where the table holds no crossing, each pair once.

    Borders of flats and knuckles are not looked at: their crossings are searched for anyway.

    Parameters
    ----------
    graph : NetGraph
        The net.
    reach : float
        Lines no farther apart cross, in lengths of the hull.
    """
    net = graph.net
    keep = np.isin(np.arange(net.batch.count), graph.curve)
    plain = keep & ~net.flat & ~net.knuckle
    found = unnoted_crossings(net, keep, np.flatnonzero(plain), reach)
    told: dict[tuple[int, ...], str] = {}
    for i in np.lexsort((found.pair[:, 1], found.pair[:, 0], found.gap)).tolist():
        a, b = sorted(found.pair[i].tolist())
        where = f"near {_told(found.xyz[i])}, {found.gap[i]:.3f} m apart"
        told.setdefault((a, b), f"{net.name[a]} x {net.name[b]} {where}")
    return tuple(told.values())


def check_outline(graph: NetGraph, outline: IntArray) -> None:
    """Refuse a half hull with more than one border.

    Raises
    ------
    OpenNetError
        With the boundary lines that lie within it.
    """
    inside = np.setdiff1d(np.flatnonzero(graph.net.end[graph.curve]), outline >> 1)
    if len(inside):
        curves = np.unique(graph.curve[inside]).tolist()
        raise OpenNetError(
            "there is more than one outer face; lines at which the hull ends lie within it",
            tuple(graph.net.name[c] for c in curves),
            "join them to the outer border, or make them knuckles",
        )  # fmt: skip


def _ends(net: Net, loose: IntArray) -> tuple[str, ...]:
    knot = np.where(
        loose[:, 1] == 1, net.batch.start[loose[:, 0] + 1] - 1, net.batch.start[loose[:, 0]]
    )
    return tuple(
        f"{net.name[c]} at {_told(place)}"
        for c, place in zip(loose[:, 0].tolist(), net.batch.xyz[knot], strict=True)
    )


def _told(place: FloatArray) -> str:
    x, y, z = place.tolist()
    return f"({x:.3f}, {y:.3f}, {z:.3f}) m"
