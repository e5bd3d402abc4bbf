"""A new line, cut from the lines that are there: adding one is no change of shape.

The new plane meets boundary curves (contacts) and the curves of lower rank (crossings);
the role rule chooses which of these define the new line. A crossing defines the old curve
too only if that stays within 0.1 mm; else the old curve drives the new one.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.chain import chain
from assoc_hull.edit.keep import deviation_with
from assoc_hull.edit.remeet import enter_line
from assoc_hull.edit.ride import ride_links
from assoc_hull.edit.thread import thread
from assoc_hull.edit.topology import generates
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, NoMeetingError, UnknownNameError
from assoc_hull.geometry.crossing import meet_planes
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.spline import derivative, loft
from assoc_hull.model.family import FAMILIES, BoundaryKind, Role, Sort
from assoc_hull.model.gaps import tangents
from assoc_hull.model.make import CrossingSpec, PointSpec
from assoc_hull.model.roles import Candidates, choose
from assoc_hull.model.state import Ends, HullState

__all__ = ["add_line", "new_plane"]


@attrs.frozen(eq=False)
class _Marks:
    """Where the new plane meets what is there.

    Attributes
    ----------
    curve : (k,) int
        The curve met.
    at : (k,), m
        Parameter on it.
    xyz : (k, 3), m
        The place, exactly in both planes.
    sign : (k,) int
        Sense in which it passes the new plane.
    boundary : (k,) int
        A `BoundaryKind`, or -1 on other lines.
    """

    curve: IntArray
    at: FloatArray
    xyz: FloatArray
    sign: IntArray
    boundary: IntArray

    def take(self, chosen: IntArray) -> _Marks:
        return _Marks(
            self.curve[chosen], self.at[chosen], self.xyz[chosen], self.sign[chosen], self.boundary[chosen]
        )


def new_plane(state: HullState, group: str, position: float) -> tuple[int, FloatArray]:
    """Check a group and position for a new line; give the group's number and the normal.

    Raises
    ------
    UnknownNameError
        No such group.
    BadInputError
        A family without parallel planes, a number that is not finite, or a plane that is
        taken.
    """
    names = state.groups.name.data
    if group not in names:
        raise UnknownNameError("group", group, tuple(names))
    number = names.index(group)
    axis = FAMILIES[state.groups.family.data[number]].axis
    if axis is None:
        raise BadInputError(
            f"the lines of {group} have no common direction", "in add_line", "give a plane family"
        )
    if not np.isfinite(position):
        raise BadInputError(f"the position is {position}", f"for a line of {group}", "give metres")
    mine = state.lines.alive.data & (state.lines.group.data == number) & state.lines.planar.data
    near = np.abs(state.lines.offset.data[mine] - position)
    if len(near) and near.min() < 1e-6:
        raise BadInputError(
            f"there is a line at {position:g} m already", f"in {group}", "choose another position"
        )
    return number, np.eye(3)[axis]


def add_line(
    edit: Transaction,
    group: str,
    position: float,
    name: str | None = None,
    keep: float | None = None,
) -> int:
    """Cut a new line and give its number.

    Parameters
    ----------
    edit : Transaction
        The edit.
    group : str
        The group it joins.
    position : float, m
        Place of its plane along the family's axis.
    name : str or None
        Prefix and position if None.
    keep : float or None, m
        Its crossings define the old curves only where these move by no more than this;
        `Tolerances.keep` if None.

    Raises
    ------
    NoMeetingError
        If the plane meets fewer than two places.
    """
    state = edit.state
    number, normal = new_plane(state, group, position)
    marks = _find(state, number, normal, position)
    if len(marks.curve) < 2:
        raise _misses(state, number, normal, position)
    edit.pending.structural = True
    family = FAMILIES[state.groups.family.data[number]]
    title = name or _free_name(state, number, f"{family.prefix} {position:g}")
    line = edit.maker.line(number, title, (normal, position))
    axis = 2 if family.axis == 0 else 0
    for piece in chain(marks.xyz, marks.boundary == BoundaryKind.END, axis):
        _make_piece(edit, line, _spread(marks.take(piece)), keep or state.tolerances.keep)
    enter_line(edit, line)
    return line


def _free_name(state: HullState, group: int, wish: str) -> str:
    taken = {
        state.lines.name.data[i] for i in state.live("lines") if state.lines.group.data[i] == group
    }
    return wish if wish not in taken else f"{wish} m"


def _sources(state: HullState, group: int) -> list[int]:
    """Give the groups a new line is cut from: lower ranks, or all if there is but one."""
    names = state.groups.name.data
    mine = names[group]
    linked = {pair.b for pair in state.associations if pair.a == mine}
    linked |= {pair.a for pair in state.associations if pair.b == mine}
    rank = {i: FAMILIES[state.groups.family.data[i]].rank for i in range(len(names))}
    others = sorted((i for i in range(len(names)) if names[i] in linked), key=lambda i: (rank[i], names[i]))
    lower = [i for i in others if rank[i] < rank[group]]
    plain = [i for i in lower if rank[i] > 0]
    if plain:
        return lower
    return lower + [i for i in others if rank[i] > rank[group]][:1]


def _find(state: HullState, group: int, normal: FloatArray, position: float) -> _Marks:
    """Meet every source curve with the new plane."""
    curves = state.live("curves")
    wanted = np.isin(state.lines.group.data[state.curves.line.data[curves]], _sources(state, group))
    curves = curves[wanted]
    none = np.zeros(0, np.int64)
    if not len(curves):
        return _Marks(none, np.zeros(0), np.zeros((0, 3)), none, none)
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    met = meet_planes(batch, normal, np.array([position]))
    owner = curves[met.curve]
    lines = state.curves.line.data[owner]
    xyz = met.xyz.copy()
    own = (state.lines.normal.data[lines] == 1.0) & state.lines.planar.data[lines][:, None]
    xyz[own] = np.broadcast_to(state.lines.offset.data[lines][:, None], xyz.shape)[own]
    return _Marks(
        owner, met.t.copy(), xyz, met.sign.astype(np.int64), state.lines.boundary.data[lines].astype(np.int64)
    )


def _misses(
    state: HullState, group: int, normal: FloatArray, position: float
) -> NoMeetingError:
    curves = state.live("curves")
    reach = np.concatenate([state.spline(curve).xyz @ normal for curve in curves.tolist()])
    nearest = max(0.0, float(reach.min() - position), float(position - reach.max()))
    return NoMeetingError(
        f"the plane at {position:g} m of {state.groups.name.data[group]}",
        nearest,
        f"choose a position between {reach.min():.3f} and {reach.max():.3f} m",
    )


def _spread(marks: _Marks) -> _Marks:
    """Drop marks that coincide with one that is kept: contacts first, then lower rank."""
    order = np.lexsort((np.arange(len(marks.curve)), -marks.boundary))
    kept: list[int] = []
    for item in order.tolist():
        away = np.abs(marks.xyz[kept] - marks.xyz[item]).max(axis=1) if kept else np.array([np.inf])
        if away.min() > 1e-3:
            kept.append(item)
    return marks.take(np.array(sorted(kept), np.int64))


def _make_piece(edit: Transaction, line: int, marks: _Marks, keep: float) -> None:
    """Make one curve of the new line from marks in order along it."""
    state = edit.state
    kind, direction = _kinds(state, line, marks)
    spline = loft(CurveData.single(marks.xyz, kind, direction))
    picked = _pick(state, line, marks, spline)
    curve = edit.maker.curve(line, Ends())
    chosen = marks.take(np.flatnonzero(picked))
    roles = _roles(state, line, chosen, keep)
    specs = [
        _spec(state, curve, chosen, i, role, int(kind[picked][i]), direction[picked][i])
        for i, role in enumerate(roles)
    ]
    rows = edit.maker.crossings(specs)
    stand_in = [
        PointSpec(curve, chosen.xyz[i], Sort.ADOPTED)
        for i, role in enumerate(roles)
        if role is Role.WATCHED
    ]
    own = iter(edit.maker.points(stand_in).tolist())
    order = [next(own) if role is Role.WATCHED else int(rows[i]) for i, role in enumerate(roles)]
    edit.maker.define(curve, order)
    ride_links(state, np.array([curve]), edit.journal)
    for i, role in enumerate(roles):
        if role is Role.SHARED:
            thread(edit.maker, int(chosen.curve[i]), int(rows[i]))
            edit.pending.curves.add(int(chosen.curve[i]))


def _kinds(
    state: HullState, line: int, marks: _Marks
) -> tuple[np.typing.NDArray[np.int8], FloatArray]:
    """Give each mark its kind; at the border of a flat the direction lies in the flat."""
    kind = np.zeros(len(marks.curve), np.int8)
    kind[marks.boundary == BoundaryKind.FLAT] = PointKind.TANGENT
    kind[marks.boundary == BoundaryKind.KNUCKLE] = PointKind.KNUCKLE
    direction = np.zeros((len(marks.curve), 3))
    for i in np.flatnonzero(marks.boundary == BoundaryKind.FLAT).tolist():
        flat = state.lines.normal.data[state.line_of(int(marks.curve[i]))]
        along = np.cross(flat, state.lines.normal.data[line])
        chord = marks.xyz[min(i + 1, len(kind) - 1)] - marks.xyz[max(i - 1, 0)]
        direction[i] = along if float(along @ chord) >= 0.0 else -along
    return kind, direction


def _pick(
    state: HullState, line: int, marks: _Marks, spline: SplineBatch
) -> np.typing.NDArray[np.bool_]:
    """Apply the role rule on the new line."""
    slope = derivative(spline, np.zeros(len(marks.curve), np.int64), spline.knot)
    tangent = slope / np.sqrt((slope * slope).sum(axis=1))[:, None]
    normal = state.lines.normal.data[state.curves.line.data[marks.curve]]
    sine = np.minimum(np.abs((tangent * normal).sum(axis=1)), 1.0)
    fixed = marks.boundary >= 0
    fixed[[0, -1]] = True
    return choose(
        Candidates(spline.knot, np.degrees(np.arcsin(sine)), tangent, fixed), state.tolerances
    )


def _roles(state: HullState, line: int, marks: _Marks, keep: float) -> list[Role]:
    """Say of each chosen mark what it does, beside defining the new line."""
    may = _old_may(state, line, marks, keep)
    rank = state.family(line).rank
    roles: list[Role] = []
    for i, curve in enumerate(marks.curve.tolist()):
        old = state.line_of(curve)
        lower = state.family(old).rank < rank
        old_gives, new_gives = generates(state, old, line)
        if may[i] and old_gives and new_gives:
            roles.append(Role.SHARED)
        elif old_gives and (lower or not new_gives):
            roles.append(Role.DRIVES_B if lower else Role.DRIVES_A)
        else:
            roles.append(Role.WATCHED)
    return roles


def _old_may(
    state: HullState, line: int, marks: _Marks, keep: float
) -> np.typing.NDArray[np.bool_]:
    """Tell which old curves may be defined by their mark: transversal, spaced, unmoved."""
    slope = tangents(state, marks.curve, marks.at)
    sine = np.minimum(np.abs(slope @ state.lines.normal.data[line]), 1.0)
    may = np.degrees(np.arcsin(sine)) >= state.tolerances.transversal_deg
    some = np.flatnonzero(may)
    moved, room = deviation_with(state, marks.curve[some], marks.xyz[some])
    may[some] = (moved <= keep) & (room >= state.tolerances.spacing)
    return may


def _spec(
    state: HullState, curve: int, marks: _Marks, i: int, role: Role, kind: int, direction: FloatArray
) -> CrossingSpec:
    other = int(marks.curve[i])
    contact = bool(marks.boundary[i] >= 0)
    if state.rank(other) < state.rank(curve):
        return CrossingSpec(
            other, curve, marks.xyz[i], role, int(marks.sign[i]), None, contact, kind, direction
        )
    return CrossingSpec(curve, other, marks.xyz[i], role, int(marks.sign[i]))

