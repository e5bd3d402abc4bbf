"""Followers that come to end elsewhere on boundary curves: which these are, and what stays known.

Such a line has another course there than its image, so it is cut wholly anew.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.births_and_deaths import ONE_PLACE
from assoc_hull.edit.followup.tangencies import NO_ROOT, touch_rows, without_double
from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.edit.recut.driver_image import Roots
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.evaluation import derivative, evaluate
from assoc_hull.model.align_intersections import align_roots
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.state import HullState, Meets

__all__ = ["doubles", "ends_change", "pairs_of", "recognise", "runs_along"]

_ALONG = 0.02
"""A curve that rises through a plane by a smaller part of its length runs along it."""


def pairs_of(
    work: Carried, curve: int, line: int, local: int, roots: Roots
) -> tuple[IntArray, IntArray, list[tuple[int, int]]]:
    """Align the old meetings of a driver with a plane with the new ones of its image."""
    meets: Meets = work.state.curves.meets.data[curve]
    old = np.flatnonzero(meets.line == line)
    new = np.flatnonzero(roots.curve == local)
    touch = work.touches.get((curve, line))
    new = new[without_double(roots.xyz[new], touch.xyz if touch else None)]
    carried = work.space.places(meets.xyz[old]) if len(old) else np.zeros((0, 3))
    return old, new, align_roots(meets.sign[old], carried, roots.sign[new], roots.xyz[new])


def doubles(state: HullState, curve: int, line: int) -> set[int]:
    """Give the crossings at double roots: they have no meeting.

    A line may end squarely on a meeting of sign 0 as well.
    """
    meets: Meets = state.curves.meets.data[curve]
    return set(touch_rows(state, curve, line)) - set(meets.row[meets.sign != 0].tolist())


def ends_change(work: Carried, curve: int, line: int, local: int, roots: Roots) -> bool:
    """Tell whether a follower would end on a boundary curve more or fewer times, or far off."""
    state = work.state
    if state.lines.boundary.data[state.line_of(curve)] != BoundaryKind.END:
        return False
    meets: Meets = state.curves.meets.data[curve]
    if bool(doubles(state, curve, line)) != ((curve, line) in work.touches):
        return True
    old, new, pairs = pairs_of(work, curve, line, local, roots)
    lost = np.setdiff1d(np.arange(len(old)), [one for one, _ in pairs])
    if len(pairs) < len(new) or bool((meets.row[old[lost]] >= 0).any()):
        return True
    slip = [work.space.places(meets.xyz[old[[i]]])[0] - roots.xyz[new[j]] for i, j in pairs]
    far = [float((step * step).sum()) > ONE_PLACE * ONE_PLACE for step in slip]
    ends = new[[j for (_, j), away in zip(pairs, far, strict=True) if away]]
    return bool(runs_along(work, curve, line, roots.t[ends]).any())


def runs_along(work: Carried, curve: int, line: int, t: FloatArray) -> np.typing.NDArray[np.bool_]:
    """Tell where the image of a curve runs along the plane of a line, or nearly: it touches it.

    An end that has slid there stands anywhere along the touch, as rounding has it.
    """
    spline, none = work.state.spline(curve), np.zeros(len(t), np.int64)
    slope = derivative(spline, none, t)
    turned = (work.space.jacobians(evaluate(spline, none, t)) * slope[:, None, :]).sum(axis=2)
    rise = (turned * work.planes.normal[line]).sum(axis=1)
    return np.asarray(np.abs(rise) <= _ALONG * np.sqrt((turned * turned).sum(axis=1)))


def recognise(work: Carried, curve: int, line: int, local: int, roots: Roots) -> None:
    """Note which crossings of a line that is cut anew are which meetings of a driver."""
    meets: Meets = work.state.curves.meets.data[curve]
    old, _, pairs = pairs_of(work, curve, line, local, roots)
    for one, other in pairs:
        row = int(meets.row[old[one]])
        if row >= 0:
            work.anew[line][curve, other] = row
    if (curve, line) in work.touches:
        for row in touch_rows(work.state, curve, line):
            work.anew[line][curve, NO_ROOT] = row
