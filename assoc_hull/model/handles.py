"""Handles: points, curves, lines, groups and crossings as a designer sees them.

A handle holds no geometry. It knows the tables of its hull and the number of its object,
looks everything up when asked, and gives out frozen values. Two handles on one object are
equal; a handle whose object has gone says so.

Reference: Choi & Lee, "A Study on the Hull Form Design System on the Basis of the
Associative Geometry Objects", J. SNAK 36(4), 1999.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.handles import handle
>>> point = handle(wigley(), "WL 2.5 x ST 7")
>>> point, point.parent_curve, point.free, point.role
(<Point WL 2.5 x ST 7>, <Curve ST 7>, ('y',), 'defining')
"""

from __future__ import annotations

from assoc_hull.model.address import Place, resolve
from assoc_hull.model.curve import Curve, Touch
from assoc_hull.model.handle import Handle
from assoc_hull.model.line import Group, Line
from assoc_hull.model.point import Crossing, Point
from assoc_hull.model.state import HullState

__all__ = ["Crossing", "Curve", "Group", "Handle", "Line", "Point", "Touch", "handle", "place_of"]


def handle(state: HullState, text: str) -> Group | Line | Curve | Point:
    """Give the handle that an address leads to.

    Parameters
    ----------
    state : HullState
        The tables.
    text : str
        An address, see `assoc_hull.model.address`, or a key.

    Returns
    -------
    Group, Line, Curve or Point
        The deepest object that the address names.

    Raises
    ------
    UnknownNameError
        Nothing has this address; near ones are named.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.handles import handle
    >>> handle(wigley(), "waterlines"), handle(wigley(), "ST 7 [1]")
    (<Group waterlines>, <Curve ST 7>)
    """
    place = resolve(state, text)
    if place.row >= 0:
        return Point(state, place.row, state.rows.key.data[place.row], place.side)
    if place.curve >= 0:
        return Curve.of(state, place.curve)
    if place.line >= 0:
        return Line.of(state, place.line)
    return Group.of(state, place.group)


def place_of(thing: Group | Line | Curve | Point | Crossing) -> Place:
    """Give the numbers of what a handle stands for, as its address would.

    Raises
    ------
    ForeignPointError
        It has gone.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.handles import handle, place_of
    >>> place_of(handle(wigley(), "sections"))
    Place(group=1, line=-1, curve=-1, row=-1, side=-1)
    """
    number, state = thing.row, thing.tables
    if isinstance(thing, Group):
        return Place(number)
    row = number if isinstance(thing, Point | Crossing) else -1
    side = thing.side if isinstance(thing, Point) else 0
    if isinstance(thing, Line):
        return Place(int(state.lines.group.data[number]), number)
    curve = number if row < 0 else int(state.rows.curve.data[row, side])
    line = state.line_of(curve)
    return Place(int(state.lines.group.data[line]), line, curve, row, side if row >= 0 else -1)
