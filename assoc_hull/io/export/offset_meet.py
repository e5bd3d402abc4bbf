"""Lines of a hull by planes, and where they meet other planes: what a table of offsets holds.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.export.offset_meet import lines_in_planes, spread
>>> sections = lines_in_planes(wigley(), "sections", 0)
>>> spread(sections.curves[:2], np.eye(3)[2], np.array([2.5, 5.0]), 1).high.round(4).tolist()
[[0.608, 0.912], [1.152, 1.728]]
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.io.lines.line_points import splines_of
from assoc_hull.model.state import HullState

__all__ = [
    "APART", "LinesInPlanes", "Spread", "boundary_curves", "keel_and_deck", "line_at",
    "lines_in_planes", "spread", "station_places", "with_ends", "with_levels",
]  # fmt: skip

_SAME = 1e-6
"""Places closer than this (m) are one."""

APART = 1e-3
"""Offsets farther apart than this (m) are two of one line, of which a table holds one."""

_ACROSS = np.eye(3)[0]


@attrs.frozen(eq=False)
class LinesInPlanes:
    """The lines of one family in planes: places ascending, names and splines."""

    at: FloatArray
    names: list[str]
    curves: list[SplineBatch]


def lines_in_planes(state: HullState, family: str, axis: int) -> LinesInPlanes:
    """Give the lines of a family in planes across an axis, by place.

    Parameters
    ----------
    state : HullState
        The hull.
    family : str
        Such as "sections".
    axis : int
        0 for x, 1 for y, 2 for z; lines in oblique planes are left out.

    Raises
    ------
    BadInputError
        A curve of theirs has failed.
    """
    live = [i for i in state.live("lines").tolist() if state.family(i).name == family]
    table = state.lines
    found = [
        (float(table.offset.data[i]), str(table.name.data[i]), splines_of(state, i))
        for i in live if table.planar.data[i] and table.normal.data[i][axis] == 1.0
    ]  # fmt: skip
    found.sort(key=lambda each: each[:2])
    return LinesInPlanes(
        np.array([each[0] for each in found]), [each[1] for each in found],
        [SplineBatch.join(each[2]) for each in found],
    )  # fmt: skip


def boundary_curves(state: HullState) -> list[SplineBatch]:
    """Give the boundary curves, one batch a line."""
    live = [i for i in state.live("lines").tolist() if state.family(i).name == "boundary"]
    return [SplineBatch.join(splines_of(state, i)) for i in live]


def with_ends(sections: LinesInPlanes, boundary: list[SplineBatch]) -> LinesInPlanes:
    """Put boundary curves in planes across, beyond all sections, among them: a transom."""
    found = list(zip(sections.at.tolist(), sections.names, sections.curves, strict=True))
    for curve in boundary:
        x = float(curve.xyz[0, 0])
        flat = np.ptp(curve.xyz[:, 0]) < _SAME and np.ptp(curve.xyz[:, 2]) > _SAME
        if flat and not (sections.at.min() - _SAME < x < sections.at.max() + _SAME):
            found.append((x, "", curve))
    found.sort(key=lambda each: each[:2])
    return LinesInPlanes(
        np.array([e[0] for e in found]), [e[1] for e in found], [e[2] for e in found]
    )


def with_levels(waterlines: LinesInPlanes, boundary: list[SplineBatch]) -> LinesInPlanes:
    """Put boundary curves in level planes, such as a level deck edge, among the waterlines.

    The plane of the base line is one of them if the hull stands on it: there a table has the
    border of its flat of bottom.
    """
    found = list(zip(waterlines.at.tolist(), waterlines.names, waterlines.curves, strict=True))
    for curve in boundary:
        z = curve.xyz[:, 2]
        if np.ptp(z) < _SAME:
            found.append((_snapped(float(z[0])), "", curve))
    lowest = min((float(curve.xyz[:, 2].min()) for curve in boundary), default=np.nan)
    if abs(lowest) < _SAME and boundary:
        found.append((0.0, "", SplineBatch.join(boundary)))
    found.sort(key=lambda each: (each[0], each[1] == ""))
    kept = [found[k] for k in range(len(found)) if not k or found[k][0] - found[k - 1][0] > _SAME]
    return LinesInPlanes(
        np.array([each[0] for each in kept]), [each[1] for each in kept],
        [each[2] for each in kept],
    )  # fmt: skip


def _snapped(value: float) -> float:
    return 0.0 if abs(value) < _SAME else value


def station_places(
    state: HullState, sections: LinesInPlanes, boundary: list[SplineBatch]
) -> FloatArray:
    """Give x of the sections, and of the perpendiculars that the hull reaches."""
    ends = np.concatenate([curve.xyz[:, 0] for curve in boundary] or [np.zeros(0)])
    at = sections.at
    for x in (0.0, state.particulars.length):
        reached = len(ends) and ends.min() - _SAME <= x <= ends.max() + _SAME
        if reached and not (np.abs(at - x) < _SAME).any():
            at = np.append(at, x)
    return np.sort(at)


@attrs.frozen(eq=False)
class Spread:
    """The least and the largest of a coordinate where lines meet planes, (lines, planes)."""

    low: FloatArray
    high: FloatArray


def spread(
    curves: list[SplineBatch], normal: FloatArray, planes: FloatArray, column: int,
    levels: FloatArray | None = None,
) -> Spread:  # fmt: skip
    """Meet lines with planes; a defining point in a plane counts as a meeting.

    Parameters
    ----------
    curves : list of SplineBatch
        One batch a line.
    normal, planes : (3,), (p,) m
        The planes, ascending.
    column : int
        The coordinate.
    levels : (lines,) or None, m
        Meetings count at this height only.
    """
    low, high = (np.full((len(curves), len(planes)), each) for each in (np.inf, -np.inf))
    for i, curve in enumerate(curves):
        met = meet_planes(curve, normal, planes)
        on, knot = np.nonzero(np.abs(curve.xyz @ normal - planes[:, None]) < _SAME)
        plane = np.concatenate([met.plane, on])
        xyz = np.concatenate([met.xyz, curve.xyz[knot]])
        kept = slice(None) if levels is None else np.abs(xyz[:, 2] - levels[i]) < APART
        np.minimum.at(low[i], plane[kept], xyz[kept][:, column])
        np.maximum.at(high[i], plane[kept], xyz[kept][:, column])
    none = low > high
    low[none], high[none] = np.nan, np.nan
    return Spread(low, high)


def keel_and_deck(
    x: FloatArray, sections: LinesInPlanes, every: list[SplineBatch]
) -> tuple[FloatArray, FloatArray]:
    """Give the local height of the keel, (s,), and edge of the deck, (s, 2): y and z, m."""
    across = SplineBatch.join(every)
    met = meet_planes(across, _ACROSS, x)
    at, knot = np.nonzero(np.abs(across.xyz[:, 0] - x[:, None]) < _SAME)
    plane = np.concatenate([met.plane, at])
    xyz = np.concatenate([met.xyz, across.xyz[knot]])
    keel, deck = np.full(len(x), np.nan), np.full((len(x), 2), np.nan)
    for i, place in enumerate(x.tolist()):
        k = line_at(sections.at, place)
        own = sections.curves[k].xyz if k >= 0 else np.zeros((0, 3))
        found = np.concatenate([own, xyz[plane == i]])
        if len(found):
            keel[i] = _snapped(float(found[:, 2].min()))
            deck[i] = found[int(np.lexsort((found[:, 1], found[:, 2]))[-1]), 1:]
    return keel, deck


def line_at(places: FloatArray, place: float) -> int:
    """Give the number of the line at a place, -1 if there is none."""
    near = np.flatnonzero(np.abs(places - place) < _SAME)
    return int(near[0]) if len(near) else -1
