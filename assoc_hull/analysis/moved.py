"""A hull whose points have moved, put together as it was before: nothing is laid out anew.

To lay out a surface (which lines bound which cell) takes far longer than to measure it. Where
points only move, as from one trial of many to the next, the old layout serves again: the cells
are put on the lines as they have become, with the rule by which derivatives are taken.

What a full layout would decide otherwise stays as it was. Two knots across a strip that pass
one another, for instance: the smooth pieces there differ from one another by the third power
of how far they pass, which is less than rounding for moves of a trial.
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs
import numpy as np

from assoc_hull.analysis.flotation import Flotation
from assoc_hull.analysis.moving import defining_rows
from assoc_hull.analysis.net.followed import followed
from assoc_hull.analysis.net.gather import Net, Part, gather
from assoc_hull.analysis.net.loops import Frame
from assoc_hull.geometry.coons import CoonsStrips
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.segments import locate, segment_start
from assoc_hull.geometry.spline import loft
from assoc_hull.model.recipe import curve_data
from assoc_hull.model.state import HullState

__all__ = ["moved", "moved_to", "same_structure"]


def moved(base: Flotation, data: CurveData, points: FloatArray) -> Flotation:
    """Give a hull of other places of its points, by the layout that it had.

    Parameters
    ----------
    base : Flotation
        The hull as it was.
    data : CurveData
        Its curves, of points and directions that have moved; in the order of `base.net.curve`.
    points : (n, 3), m
        All points of its tables, where they are now.

    Returns
    -------
    Flotation
        Its tables are those of the hull as it was: what is measured is right, errors are not
        to be estimated.

    Raises
    ------
    CoincidentPointsError
        Two points of a curve have come together.
    """
    batch = loft(data)
    return _put(base, base.state, _net(base.net, batch), points)


def moved_to(base: Flotation, state: HullState) -> Flotation | None:
    """Give what `flotation` gives of tables, but by the layout of a hull of the same structure.

    Parameters
    ----------
    base : Flotation
        The hull as it was.
    state : HullState
        The tables now, of the same hull or of a copy.

    Returns
    -------
    Flotation or None
        None where lines or crossings have come, gone or changed their kind: what was laid out
        says nothing of that hull.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.flotation import flotation
    >>> from assoc_hull.analysis.moved import moved_to
    >>> hull = ah.examples.wigley()
    >>> before = flotation(hull.state)
    >>> with hull.edit("fuller") as edit:
    ...     edit.move("WL 2.5 x ST 7", y=3.3)
    >>> moved_to(before, hull.state).layout.frames is before.layout.frames
    False
    """
    net = gather(state)
    kinds = curve_data(state, net.curve).kind
    if not same_structure(base, state, net) or not np.array_equal(kinds, base.kinds):
        return None
    return _put(base, state, net, state.rows.xyz.data)


def same_structure(base: Flotation, state: HullState, net: Net) -> bool:
    """Tell whether a net has the lines and crossings of a hull, in the same order."""
    was = base.net
    numbers = ("curve", "end", "flat", "knuckle", "centre", "watched", "row")
    shaped = all(np.array_equal(getattr(net, name), getattr(was, name)) for name in numbers)
    return (
        shaped
        and (net.name, net.family) == (was.name, was.family)
        and np.array_equal(net.batch.start, was.batch.start)
        and np.array_equal(net.meets, was.meets)
        and np.array_equal(defining_rows(state, net.curve), defining_rows(base.state, was.curve))
        and np.array_equal(_order(net.x), _order(was.x))
        and state.particulars.deck == base.state.particulars.deck
    )


def _order(x: FloatArray) -> IntArray:
    """Give which stand before which, and which at the same place."""
    return np.unique(x, return_inverse=True)[1]


def _put(base: Flotation, state: HullState, net: Net, points: FloatArray) -> Flotation:
    cells = followed(base.layout, base.net, net.batch, points)
    frames = tuple(_frame(each, base.net.batch, net.batch) for each in base.layout.frames)
    layout = attrs.evolve(base.layout, cells=cells, frames=frames)
    return Flotation(state, net, layout, CoonsStrips.on(cells, net.batch), base.kinds)


def _net(net: Net, batch: SplineBatch) -> Net:
    """Give the lines as they have become; a section stands where its first point is."""
    first = batch.start[:-1]
    gone = batch.xyz[first, 0] - net.batch.xyz[first, 0]
    place = _carried(net.batch, batch, net.meets.ravel(), net.place.ravel())
    return attrs.evolve(net, batch=batch, x=net.x + gone, place=place.reshape(net.place.shape))


def _carried(was: SplineBatch, now: SplineBatch, curve: IntArray, t: FloatArray) -> FloatArray:
    """Give parameters at the same parts of the same segments."""
    segment, u = locate(was, curve, t)
    first = segment_start(was)[segment]
    found: FloatArray = now.knot[first] * (1.0 - u) + now.knot[first + 1] * u
    return found


def _frame(frame: Frame, was: SplineBatch, now: SplineBatch) -> Frame:
    sides = {
        name: _parts(getattr(frame, name), was, now) for name in ("aft", "fore", "keel", "deck")
    }
    return attrs.evolve(frame, **sides)


def _parts(parts: Iterable[Part], was: SplineBatch, now: SplineBatch) -> tuple[Part, ...]:
    given = tuple(parts)
    if not given:
        return given
    curve = np.array([each[0] for each in given]).repeat(2)
    t = np.array([each[1:] for each in given]).ravel()
    ends = _carried(was, now, curve, t).reshape(-1, 2).tolist()
    return tuple((each[0], low, high) for each, (low, high) in zip(given, ends, strict=True))
