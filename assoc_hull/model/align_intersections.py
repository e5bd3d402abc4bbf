"""Which root is which: meetings of a curve before and after it changed.

A plane may meet a curve many times. New roots are aligned with the old ones by sign and
order, with the fewest births and deaths, ties by the least total displacement, then the
lower position along the curve. Ordinals along the curve would be wrong after every birth.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.tables import CurveIntersections

__all__ = ["Alignment", "align_curve", "align_plane_roots"]


@attrs.frozen(eq=False)
class Alignment:
    """How the meetings of one curve follow from the old ones.

    Attributes
    ----------
    curve : int
        Number of the curve.
    row : (k,) int
        For each new meeting the crossing it is, -1 if none.
    gone : (g,) int
        Crossings that have no meeting on this curve any more.
    come : (b,) int
        New meetings that no old one corresponds to.
    """

    curve: int
    row: IntArray
    gone: IntArray
    come: IntArray


def align_curve(curve: int, old: CurveIntersections, new: CurveIntersections) -> Alignment:
    """Align all meetings of a curve, plane by plane."""
    row = np.full(len(new.line), -1)
    known = np.zeros(len(new.line), bool)
    before, after = (np.argsort(each.line, kind="stable") for each in (old, new))
    odd = _odd_lines(old, before, new, after)
    # Of all other planes each meeting is the one that stood in its place.
    kept = after[~np.isin(new.line[after], odd)]
    row[kept], known[kept] = old.row[before[~np.isin(old.line[before], odd)]], True
    gone: list[int] = []
    for line in odd.tolist():
        first, then = np.flatnonzero(old.line == line), np.flatnonzero(new.line == line)
        match = align_plane_roots(old.sign[first], old.xyz[first], new.sign[then], new.xyz[then])
        for one, other in match:
            row[then[other]], known[then[other]] = old.row[first[one]], True
        lost = set(range(len(first))) - {one for one, _ in match}
        gone += [int(old.row[first[i]]) for i in lost if old.row[first[i]] >= 0]
    return Alignment(curve, row, np.array(sorted(gone), np.int64), np.flatnonzero(~known))


def _odd_lines(
    old: CurveIntersections, before: IntArray, new: CurveIntersections, after: IntArray
) -> IntArray:
    """Give the lines whose planes are met more or less often than before, or in other senses.

    `before` and `after` are the orders of the meetings by lines.
    """
    was, now = old.line[before], new.line[after]
    lines = np.union1d(was, now)
    counts = [each.searchsorted(lines, "right") - each.searchsorted(lines) for each in (was, now)]
    odd: IntArray = lines[counts[0] != counts[1]]
    one, other = ~np.isin(was, odd), ~np.isin(now, odd)
    turned = old.sign[before[one]] != new.sign[after[other]]
    return np.union1d(odd, was[one][turned])


def align_plane_roots(
    old_sign: np.typing.NDArray[np.int8],
    old_xyz: FloatArray,
    new_sign: np.typing.NDArray[np.int8],
    new_xyz: FloatArray,
) -> list[tuple[int, int]]:
    """Pair old with new roots of one curve and one plane, both in order along the curve.

    Parameters
    ----------
    old_sign, new_sign : (k,), (l,)
        +1 or -1.
    old_xyz, new_xyz : (k, 3), (l, 3), m
        Where they lie.

    Returns
    -------
    list of (int, int)
        Pairs of equal sign, both ascending: the most pairs; among these, the least sum of
        distances; among these, the pairs that come first along the curve.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.model.align_intersections import align_plane_roots
    >>> at = np.array([[0.0, 0, 0], [1, 0, 0], [5, 0, 0]])
    >>> align_plane_roots(np.array([1]), at[2:], np.array([1, -1, 1]), at)
    [(0, 2)]
    """
    if np.array_equal(old_sign, new_sign):
        return [(i, i) for i in range(len(old_sign))]
    before, after = len(old_sign), len(new_sign)
    offset = old_xyz[:, None, :] - new_xyz[None, :, :]
    distance = np.sqrt((offset * offset).sum(axis=2))
    cost = [[(0, 0.0)] * (after + 1) for _ in range(before + 1)]
    for i in range(before - 1, -1, -1):
        for j in range(after - 1, -1, -1):
            best = min(cost[i + 1][j], cost[i][j + 1])
            if old_sign[i] == new_sign[j]:
                pairs, length = cost[i + 1][j + 1]
                best = min(best, (pairs - 1, length + float(distance[i, j])))
            cost[i][j] = best
    return _walk(cost, distance, old_sign, new_sign)


def _walk(
    cost: list[list[tuple[int, float]]],
    distance: FloatArray,
    old_sign: np.typing.NDArray[np.int8],
    new_sign: np.typing.NDArray[np.int8],
) -> list[tuple[int, int]]:
    """Read the best pairing off the table, taking a pair as early as it is as good."""
    i = j = 0
    pairs: list[tuple[int, int]] = []
    while i < len(old_sign) and j < len(new_sign):
        if old_sign[i] == new_sign[j]:
            count, length = cost[i + 1][j + 1]
            if (count - 1, length + float(distance[i, j])) == cost[i][j]:
                pairs.append((i, j))
                i, j = i + 1, j + 1
                continue
        if cost[i + 1][j] <= cost[i][j + 1]:
            i += 1
        else:
            j += 1
    return pairs
