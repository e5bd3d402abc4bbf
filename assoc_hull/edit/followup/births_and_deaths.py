"""Crossings that come and go when a plane meets a curve more or fewer times than before."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.followup.tangencies import slips
from assoc_hull.edit.followup.thread import thread
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.closest import closest
from assoc_hull.model.align_intersections import Alignment
from assoc_hull.model.gaps import crossing_normals, tangents
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import CrossingSpec, Maker
from assoc_hull.model.roles import Candidates, choose, role_of
from assoc_hull.model.state import HullState, Meets

__all__ = [
    "ONE_PLACE", "Change", "bear", "generates", "latent_meetings", "meeting_gap", "role_by_rule",
    "settle", "unmeet",
]  # fmt: skip

ONE_PLACE = 2.0
"""Meetings farther apart than this (m) are not one place, whatever the gap between them."""


@attrs.frozen
class Change:
    """What settling did: keys that came and went, and curves whose points changed."""

    born: tuple[str, ...]
    gone: tuple[str, ...]
    curves: tuple[int, ...]


def latent_meetings(state: HullState, curves: IntArray) -> list[tuple[int, int]]:
    """Give the meetings of curves at which the other line did not pass so far.

    Returns
    -------
    list of (int, int)
        Curve, and index of the meeting on it.
    """
    met = [state.curves.meets.data[curve].row for curve in curves.tolist()]
    if not met or np.concatenate(met).min(initial=0) >= 0:
        return []
    return [
        (curve, spot)
        for curve, row in zip(curves.tolist(), met, strict=True)
        for spot in np.flatnonzero(row < 0).tolist()
    ]


def settle(
    maker: Maker, alignments: list[Alignment], latent: list[tuple[int, int]], edited: set[int]
) -> Change:
    """Take out crossings that have no place any more, and make those that have come.

    A crossing exists only where both curves reach each other's plane at one place; where
    only one does, the relation stays latent, until the curves come near one another there.
    """
    born: list[str] = []
    gone: list[str] = []
    curves: set[int] = set()
    keys = maker.state.curves.key.data
    for alignment in sorted(alignments, key=lambda each: str(keys[each.curve])):
        for row in alignment.gone.tolist():
            if maker.state.rows.alive.data[row] and not _holds(maker.state, row, alignment.curve):
                gone.append(maker.state.rows.key.data[row])
                curves |= _remove(maker, row)
    for curve, spot in sorted(latent, key=lambda each: (str(keys[each[0]]), each[1])):
        row = bear(maker, curve, spot, edited)
        if row is not None:
            born.append(maker.state.rows.key.data[row])
            curves |= {int(each) for each in maker.state.rows.reader.data[row] if each >= 0}
    return Change(tuple(sorted(born)), tuple(sorted(gone)), tuple(sorted(curves)))


def _holds(state: HullState, row: int, curve: int) -> bool:
    """Tell whether a curve is made through a crossing: then it is there by construction."""
    return bool((state.rows.reader.data[row] == curve).any())


def _remove(maker: Maker, row: int) -> set[int]:
    """Take a crossing out of the curves it defines and of the meetings of both."""
    state = maker.state
    touched: set[int] = set()
    for curve in state.rows.reader.data[row].tolist():
        if curve >= 0:
            rows = state.curves.rows.data[curve]
            maker.define(curve, rows[rows != row])
            touched.add(curve)
    for curve in state.rows.curve.data[row].tolist():
        if curve >= 0:
            unmeet(maker, curve, row)
    maker.remove_rows([row])
    return touched


def unmeet(maker: Maker, curve: int, row: int) -> None:
    """Make the meeting of a curve at a crossing latent."""
    meets: Meets = maker.state.curves.meets.data[curve]
    if (meets.row == row).any():
        left = np.where(meets.row == row, -1, meets.row)
        maker.journal.set(maker.state.curves.meets, [curve], [attrs.evolve(meets, row=left)])


def bear(
    maker: Maker, curve: int, spot: int, edited: set[int], *, watch: bool = False
) -> int | None:
    """Make the crossing at a new meeting, if the other line passes there too.

    Parameters
    ----------
    maker : Maker
        Writes it.
    curve, spot : int
        The curve, and the index of the meeting on it.
    edited : set of int
        Curves that the designer edited; a birth takes its value from these.
    watch : bool
        Whether it is to define neither curve, whatever the role rule says.

    Returns
    -------
    int or None
        The new point; None while the relation stays latent.
    """
    state = maker.state
    meets: Meets = state.curves.meets.data[curve]
    if meets.row[spot] >= 0 or slips(state, curve, spot):
        return None
    best: tuple[float, int, int] | None = None
    least = 0.0
    for other in state.lines.curves.data[int(meets.line[spot])]:
        theirs: Meets = state.curves.meets.data[other]
        free = np.flatnonzero((theirs.line == state.line_of(curve)) & (theirs.row < 0))
        for there in free.tolist():
            gap, apart = meeting_gap(state, (curve, spot), (other, there))
            near = gap <= 2.0 * state.tolerances.adoption and apart <= ONE_PLACE
            near = near and not slips(state, other, there)
            if near and (best is None or gap + 0.01 * apart < best[0]):
                best, least = (gap + 0.01 * apart, other, there), gap
    if best is None:
        return None
    return _make(maker, (curve, spot), (best[1], best[2]), least, edited, watch)


def meeting_gap(
    state: HullState, one: tuple[int, int], other: tuple[int, int]
) -> tuple[float, float]:
    """Give the gap along the hull's normal, and how far the places lie apart, m."""
    places, slopes = [], []
    for curve, spot in (one, other):
        meets: Meets = state.curves.meets.data[curve]
        places.append(meets.xyz[spot])
        slopes.append(_tangent(state, curve, float(meets.parameter[spot])))
    normal = crossing_normals(slopes[0][None], slopes[1][None])[0]
    step = places[0] - places[1]
    return abs(float((step * normal).sum())), float(np.sqrt((step * step).sum()))


def _tangent(state: HullState, curve: int, at: float) -> FloatArray:
    found: FloatArray = tangents(state, np.array([curve]), np.array([at]))[0]
    return found


def _make(
    maker: Maker,
    one: tuple[int, int],
    other: tuple[int, int],
    gap: float,
    edited: set[int],
    watch: bool,
) -> int:
    """Make a crossing of two meetings, with the role the rule gives it now."""
    state = maker.state
    (a, spot_a), (b, spot_b) = sorted((one, other), key=lambda each: state.rank(each[0]))
    meets_a: Meets = state.curves.meets.data[a]
    meets_b: Meets = state.curves.meets.data[b]
    at = float(meets_a.parameter[spot_a]), float(meets_b.parameter[spot_b])
    line_a, line_b = state.line_of(a), state.line_of(b)
    role = Role.WATCHED if watch else _role(state, (a, b), (line_a, line_b), at)
    spots = meets_a.xyz[spot_a], meets_b.xyz[spot_b]
    value = spots[1] if b in edited and a not in edited and role is Role.SHARED else spots[0]
    row = int(
        maker.crossings([CrossingSpec(a, b, value, role, int(meets_a.sign[spot_a]), spots)])[0]
    )
    for curve, spot in ((a, spot_a), (b, spot_b)):
        meets: Meets = state.curves.meets.data[curve]
        marked = meets.row.copy()
        marked[spot] = row
        maker.journal.set(state.curves.meets, [curve], [attrs.evolve(meets, row=marked)])
    for curve in (a, b):
        if (state.rows.reader.data[row] == curve).any():
            thread(maker, curve, row)
    maker.journal.put(state.rows.limit, [row], [max(2.0 * state.tolerances.adoption, 1.5 * gap)])
    maker.journal.put(state.rows.gap, [row], [gap])
    maker.journal.put(state.rows.parameter, [row], [at])
    return row


def _role(
    state: HullState,
    curves: tuple[int, int],
    lines: tuple[int, int],
    at: tuple[float, float],
    row: int = -1,
) -> Role:
    return role_of(
        _may_define(state, curves[0], lines[1], at[0], row),
        _may_define(state, curves[1], lines[0], at[1], row),
        generates(state, *lines),
    )


def _spot(state: HullState, row: int, side: int) -> FloatArray:
    """Give where a crossing lies on a curve: its one value, unless it is watched."""
    watched = state.rows.role.data[row] == Role.WATCHED
    spot: FloatArray = state.rows.spot.data[row, side] if watched else state.rows.xyz.data[row]
    return spot


def role_by_rule(state: HullState, row: int) -> Role:
    """Give the role that the rule chooses for a crossing, the rest of its curves as it is."""
    a, b = state.rows.curve.data[row].tolist()
    places = [
        float(closest(state.spline(curve), 0, _spot(state, row, side)[None])[0][0])
        for side, curve in enumerate((a, b))
    ]
    lines = state.line_of(a), state.line_of(b)
    if state.rows.contact.data[row]:
        both_ways = generates(state, *lines)[1]
        shared = both_ways and _may_define(state, a, lines[1], places[0], row)
        return Role.SHARED if shared else Role.DRIVES_B
    return _role(state, (a, b), lines, (places[0], places[1]), row)


def _may_define(state: HullState, curve: int, partner: int, at: float, row: int = -1) -> bool:
    """Apply the role rule to one crossing; what else defines the curve already stays."""
    knots, rows = state.spline(curve).knot, state.curves.rows.data[curve]
    if len(knots) == len(rows):
        # A point adopted where the crossing is stands in for it, and goes when it defines.
        adopted = state.rows.sort.data[rows] == Sort.ADOPTED
        stands_in = adopted & (np.abs(knots - at) < 1e-3) & (row >= 0)
        knots = knots[(rows != row) & ~stands_in]
    if float(np.abs(knots - at).min()) < 1e-3:
        return False
    position = int(np.searchsorted(knots, at))
    places = np.insert(knots, position, at)
    slopes = tangents(state, np.full(len(places), curve), places)
    fixed = np.ones(len(places), bool)
    fixed[position] = False
    sine = abs(float((slopes[position] * state.lines.normal.data[partner]).sum()))
    angle = np.full(len(places), 90.0)
    angle[position] = float(np.degrees(np.arcsin(min(1.0, sine))))
    return bool(choose(Candidates(places, angle, slopes, fixed), state.tolerances)[position])


def generates(state: HullState, line_a: int, line_b: int) -> tuple[bool, bool]:
    """Tell whether line a generates points on line b, and b on a."""
    names = [state.groups.name.data[int(state.lines.group.data[line])] for line in (line_a, line_b)]
    for link in state.associations:
        if [link.a, link.b] == names:
            return True, link.two_way
        if [link.b, link.a] == names:
            return link.two_way, True
    return False, False
