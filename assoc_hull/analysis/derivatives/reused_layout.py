"""A hull whose points have moved, put together as it was before: nothing is laid out anew.

To lay out a surface (which lines bound which cell) takes far longer than to measure it. Where
points only move, as from one trial of many to the next, the old layout serves again: the cells
are put on the lines as they have become, with the rule by which derivatives are taken.

What a full layout would decide otherwise stays as it was. Two knots across a strip that pass
one another, for instance: the smooth pieces there differ from one another by the third power
of how far they pass, which is less than rounding for moves of a trial.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.derivatives.curve_tangents import defining_rows
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.analysis.net.curve_net import CurveNet, CurvePart, gather_net
from assoc_hull.analysis.net.net_surface import NetSurface, move_cells
from assoc_hull.analysis.net.open_ends import with_ends
from assoc_hull.analysis.net.strip_boundaries import StripBoundary
from assoc_hull.analysis.net.surface_layout import open_ends
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, SplineBatch, Strips
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import locate_parameters, segment_start
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.model.network import curve_data
from assoc_hull.model.tables import HullState, Particulars

__all__ = [
    "flotation_at_points",
    "flotation_on_lines",
    "flotation_with_layout",
    "flotation_with_layout_of",
    "same_structure",
]


def flotation_at_points(base: Flotation, data: CurveData, points: FloatArray) -> Flotation:
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
        Its tables are those of the hull as it was: of these only the structure is used.

    Raises
    ------
    CoincidentPointsError
        Two points of a curve have come together.
    """
    batch = loft(data)
    return _put(base, _net(base.net, batch), points)


def flotation_with_layout(base: Flotation, state: HullState) -> Flotation | None:
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
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.derivatives.reused_layout import flotation_with_layout
    >>> hull = ah.examples.wigley()
    >>> before = flotation(hull.state)
    >>> with hull.edit("fuller") as edit:
    ...     edit.move("WL 2.5 x ST 7", y=3.3)
    >>> flotation_with_layout(before, hull.state).layout.frames is before.layout.frames
    False
    """
    net = gather_net(state)
    kinds = curve_data(state, net.curve).kind
    if not same_structure(base, state, net) or not np.array_equal(kinds, base.kinds):
        return None
    return _laid(base, state, net, state.particulars, moved=None)


def flotation_on_lines(
    base: Flotation,
    batch: SplineBatch,
    x: FloatArray,
    place: FloatArray,
    normal: FloatArray,
    particulars: Particulars | None = None,
) -> Flotation | None:
    """Give what `flotation` gives of tables, of lines alone, by the layout of a hull.

    Parameters
    ----------
    base : Flotation
        The hull as it was.
    batch : SplineBatch
        Its m lines as they have become, in the order of `base.net`.
    x : (m,), m
        Where lines in planes across the ship stand; nan for the others.
    place : (k, 2), m
        Where on both its lines each crossing lies.
    normal : (m, 3)
        Of the planes of lines; nan for lines in none.
    particulars : Particulars or None
        Its dimensions; those that it had if None.

    Returns
    -------
    Flotation or None
        It has the tables of the hull as it was: of these only the structure is used. None where
        lines across the ship have passed one another, a crossing has passed a point of its line,
        or an end is closed otherwise.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.analysis.derivatives.reused_layout import flotation_on_lines
    >>> base = flotation(ah.examples.wigley().state)
    >>> net = base.net
    >>> same = flotation_on_lines(base, net.batch, net.x, net.place, net.normal)
    >>> same is not None and (same.strips.aft == base.strips.aft).all()
    np.True_
    """
    net = attrs.evolve(base.net, batch=batch, x=x, place=place, normal=normal)
    ship = base.particulars if particulars is None else particulars
    return _laid(base, base.state, net, ship, moved=ship)


def _laid(
    base: Flotation, state: HullState, net: CurveNet, ship: Particulars, moved: Particulars | None
) -> Flotation | None:
    """Put the layout of a hull on lines; None where it does not fit."""
    if ship.deck != base.particulars.deck:
        return None
    surface = NetSurface.on_lines(base.kept, net)
    if surface is None:
        return None
    ends = open_ends(net, base.layout, ship.length)
    if ends:
        strips = with_ends(surface.strips, net, base.closed, ends)
        surface = NetSurface(surface.layout, strips)
    return Flotation(state, net, surface, base.kinds, ends, moved)


def flotation_with_layout_of(base: HullState, state: HullState) -> Flotation:
    """Make what floats of a hull, by the layout of another one if their structure is the same.

    Parameters
    ----------
    base : HullState
        The hull that it comes from.
    state : HullState
        Its own tables, which keep nothing of this.

    Raises
    ------
    BadInputError
        As `flotation`.
    """
    return flotation_with_layout(flotation(base), state) or flotation(state)


def same_structure(base: Flotation, state: HullState, net: CurveNet) -> bool:
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
        and state.particulars.deck == base.state.particulars.deck
    )


def _put(base: Flotation, net: CurveNet, points: FloatArray) -> Flotation:
    cells = move_cells(base.layout, base.net, net.batch, points)
    frames = _frames(base.layout.frames, base.net.batch, net.batch)
    layout = attrs.evolve(base.layout, cells=cells, frames=frames)
    strips: Strips = CoonsStrips.on(cells, net.batch)
    strips = with_ends(strips, net, base.closed, base.ends) if base.ends else strips
    ship = base.particulars
    surface = NetSurface(layout, strips)
    return Flotation(base.state, net, surface, base.kinds, base.ends, ship)


def _net(net: CurveNet, batch: SplineBatch) -> CurveNet:
    """Give the lines as they have become; a section stands where its first point is."""
    first = batch.start[:-1]
    gone = batch.xyz[first, 0] - net.batch.xyz[first, 0]
    place = _carried(net.batch, batch, net.meets.ravel(), net.place.ravel())
    return attrs.evolve(net, batch=batch, x=net.x + gone, place=place.reshape(net.place.shape))


def _carried(was: SplineBatch, now: SplineBatch, curve: IntArray, t: FloatArray) -> FloatArray:
    """Give parameters at the same parts of the same segments."""
    segment, u = locate_parameters(was, curve, t)
    first = segment_start(was)[segment]
    found: FloatArray = now.knot[first] * (1.0 - u) + now.knot[first + 1] * u
    return found


def _frames(
    frames: Sequence[StripBoundary], was: SplineBatch, now: SplineBatch
) -> Sequence[StripBoundary]:
    """Give strips whose sides run between the same places of the lines as they have become."""
    parts = [part for each in frames for side in _sides(each) for part in side]
    if not parts:
        return frames
    curve = np.array([part[0] for part in parts]).repeat(2)
    t = np.array([part[1:] for part in parts]).ravel()
    ends = iter(_carried(was, now, curve, t).reshape(-1, 2).tolist())
    found = []
    for each in frames:
        aft, fore, keel, deck = (
            tuple(_between(part[0], *next(ends)) for part in side) for side in _sides(each)
        )
        found.append(attrs.evolve(each, aft=aft, fore=fore, keel=keel, deck=deck))
    return tuple(found)


def _between(curve: int, low: float, high: float) -> CurvePart:
    return curve, low, high


def _sides(frame: StripBoundary) -> tuple[tuple[CurvePart, ...], ...]:
    return frame.aft, frame.fore, frame.keel, frame.deck
