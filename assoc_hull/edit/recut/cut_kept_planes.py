"""Followers whose planes a mapping keeps for a part: there their images are exact.

A line follows as a whole as soon as the mapping bends its plane anywhere, be it round one
feature. Elsewhere its image lies in its plane, to rounding, and is the hull itself: crossings
with other followers are taken from it, not from what these come to be between their drivers.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.mapped_planes import PLANE, heights, into_planes
from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.edit.recut.driver_image import Image, Roots
from assoc_hull.geometry.curves import IntArray, SplineBatch
from assoc_hull.model.align_intersections import align_roots
from assoc_hull.model.state import Meets

__all__ = ["cut_kept"]


def cut_kept(work: Carried) -> None:
    """Find where images of followers that lie in their planes meet the planes of others."""
    state = work.state
    wanted = {
        curve: rows
        for curve in sorted(_curves(work), key=lambda c: str(state.curves.key.data[c]))
        if len(rows := _unknown(work, curve))
    }
    if not wanted:
        return
    curves = list(wanted)
    batch = SplineBatch.join([state.spline(curve) for curve in curves])
    image = Image.of(work.space, batch, tuple(curves))
    lines = {state.line_of(work.other(row, c)) for c, rows in wanted.items() for row in rows}
    for line in sorted(lines, key=lambda each: str(state.lines.key.data[each])):
        roots = image.meet(work.planes.normal[line], float(work.planes.offset[line]))
        for local, curve in enumerate(curves):
            if any(state.line_of(work.other(row, curve)) == line for row in wanted[curve]):
                _settle(work, curve, line, roots, np.flatnonzero(roots.curve == local))


def _curves(work: Carried) -> list[int]:
    """Give the curves of planar followers that are not cut wholly anew."""
    state = work.state
    return [
        curve for curve in state.live("curves").tolist()
        if not work.drives(curve) and state.line_of(curve) not in work.anew
        and work.planes.planar[state.line_of(curve)]
    ]  # fmt: skip


def _unknown(work: Carried, curve: int) -> list[int]:
    """Give the crossings of a follower with other followers that have no place yet."""
    meets: Meets = work.state.curves.meets.data[curve]
    rows: IntArray = meets.row[meets.row >= 0]
    return [
        row for row in rows[~work.known[rows]].tolist()
        if row not in work.gone and not work.apart(row) and not work.drives(work.other(row, curve))
    ]  # fmt: skip


def _settle(work: Carried, curve: int, line: int, roots: Roots, new: IntArray) -> None:
    """Give crossings of a curve with a line their places where its image lies in its plane."""
    own = work.state.line_of(curve)
    off = heights(roots.xyz[new], work.planes.normal[own]) - work.planes.offset[own]
    meets: Meets = work.state.curves.meets.data[curve]
    old = np.flatnonzero(meets.line == line)
    carried = work.space.places(meets.xyz[old])
    for one, other in align_roots(meets.sign[old], carried, roots.sign[new], roots.xyz[new]):
        row = int(meets.row[old[one]])
        if row >= 0 and not work.known[row] and abs(float(off[other])) <= PLANE:
            place = roots.xyz[[new[other]]]
            work.value[row] = into_planes(work.state, work.planes, np.array([row]), place)[0]
            work.known[row] = work.slid[row] = True
            work.kept.add(row)
