"""Draw a knuckle line through points of neighbouring sections, and take one away again.

The line is a boundary curve in space. On each section it has a contact, at which the section is
split; lines that pass it between sections are split where it comes to their plane. Taken away, all
are smooth again, and crossings that gave a section its knuckle define it as before.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.arguments import line_name
from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.crossings.settle_crossings import make_latent, one_place
from assoc_hull.edit.lines.plane_intersections import remove_line_plane
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, BlockedRunError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.address import address
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.links import generates
from assoc_hull.model.loft_hull import attach_curves
from assoc_hull.model.make_objects import CrossingSpec, PointSpec
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.node import Node
from assoc_hull.model.tables import CurveIntersections, Ends, HullState

__all__ = ["knuckle_line", "remove_knuckle_line"]

_LEAST = 3
"""A knuckle line passes so many sections at least."""

_HERE = 1e-6
"""Times `Tolerances.factor`: places as near as this (m) are one."""

_OFF = 0.25
"""Of the distance within which intersections are one place: so far a line that passes a knuckle
line may lie off it, and is drawn to it."""


def knuckle_line(edit: Transaction, name: object, points: Sequence[int]) -> int:
    """Draw a knuckle line, and give its number.

    Parameters
    ----------
    edit : Transaction
        The edit.
    name : str
        Of the new line.
    points : sequence of int
        A point of each of three or more neighbouring sections: a placed or an adopted one, or a
        crossing that is shared or that the section drives.

    Raises
    ------
    NameTakenError
        There is such a line.
    BadInputError
        Too few points, points of no section or two of one, a section left out between two, or a
        hull whose boundary curves and sections do not shape one another.
    BlockedRunError
        A point that is the end of a section, on a flat or another boundary curve, or watched.
    """
    state, title = edit.state, line_name(name)
    where = f"in knuckle_line {title!r}"
    on = _sections(state, points, where)
    _refuse_unfit(state, title, on)
    group = _boundary_group(state, on, where)
    edit.refuse_moved(np.array([row for row, _ in on]))
    edit.pending.structural = True
    line = edit.maker.line(group, title, None, BoundaryKind.KNUCKLE)
    curve = edit.maker.curve(line, Ends())
    places = state.rows.xyz[np.array([row for row, _ in on])]
    specs = [
        CrossingSpec(
            curve, section, place, Role.SHARED, 1,
            contact=True, kind_b=PointKind.KNUCKLE,
        )
        for place, (_, section) in zip(places, on, strict=True)
    ]  # fmt: skip
    contacts = edit.maker.crossings(specs)
    for (row, section), contact in zip(on, contacts.tolist(), strict=True):
        _turn_section(edit, row, section, contact)
    edit.maker.define(curve, contacts)
    edit.document.refresh()
    network = HullNetwork(state, edit.document.index)
    network.evaluate(Node.curve(np.array([curve])), edit.journal)
    _split_passing(edit, curve, [row for row, _ in on], where)
    attach_curves(state, np.array([curve]), edit.journal)
    edit.pending.fresh.append(curve)
    edit.pending.born += sorted(
        str(state.rows.key[row]) for row in _contacts(state, curve).tolist()
    )
    return line


def _sections(state: HullState, points: Sequence[int], where: str) -> list[tuple[int, int]]:
    """Give the points with the section curves that they lie on, from aft forward."""
    if len(points) < _LEAST:
        what = f"{len(points)} points"
        raise BadInputError(what, where, f"give points of {_LEAST} sections or more")
    found = list[tuple[float, int, int]]()
    for row in points:
        curves = [curve for curve in state.rows.curve[row].tolist() if curve >= 0
                  and state.family(state.line_of(curve)).axis == 0]  # fmt: skip
        if not curves:
            remedy = "give crossings of sections, or points on sections"
            raise BadInputError(f"{address(state, row)} lies on no section", where, remedy)
        found.append((float(state.lines.offset[state.line_of(curves[0])]), row, curves[0]))
    found.sort()
    offsets = np.array([at for at, _, _ in found])
    again = np.flatnonzero(np.diff(offsets) == 0.0)
    if len(again):
        names = " and ".join(address(state, found[again[0] + i][1]) for i in (0, 1))
        raise BadInputError(f"{names} lie on one section", where, "give one point of each section")
    group = state.lines.group[state.line_of(found[0][2])]
    lines = state.live("lines")
    between = lines[(state.lines.group[lines] == group)]
    at = state.lines.offset[between]
    left = between[(at > offsets[0]) & (at < offsets[-1]) & ~np.isin(at, offsets)]
    if len(left):
        names = ", ".join(str(state.lines.name[line]) for line in left[:3].tolist())
        raise BadInputError(f"it would pass {names} without a point", where, "give one of each")
    return [(row, curve) for _, row, curve in found]


def _refuse_unfit(state: HullState, title: str, on: Sequence[tuple[int, int]]) -> None:
    """Refuse points that cannot become knuckles of their sections."""
    rows = state.rows
    ends = [row for row, curve in on if row in state.curves.rows[curve][[0, -1]]]
    contacts = [row for row, _ in on if rows.contact[row] or rows.kind[row].any()]
    watched = [row for row, curve in on if rows.sort[row] == Sort.CROSSING
               and rows.driver[row] != curve and rows.role[row] != Role.SHARED]  # fmt: skip
    for bad, why, remedy in (
        (ends, "these are ends of sections", "choose points between their ends"),
        (contacts, "these lie on a boundary curve, or are knuckles or tangent points already",
         "choose others, or make them smooth first (edit.set_kind)"),
        (watched, "these crossings do not define their sections, nor are they driven by them",
         "make them shared (edit.set_role), or choose others"),
    ):  # fmt: skip
        if bad:
            raise BlockedRunError(title, tuple(address(state, row) for row in bad), why, remedy)


def _boundary_group(state: HullState, on: Sequence[tuple[int, int]], where: str) -> int:
    """Give the group of boundary curves; these and the sections must shape one another."""
    families = state.groups.family.data
    number = families.index("boundary") if "boundary" in families else -1
    mine = str(state.groups.name[int(state.lines.group[state.line_of(on[0][1])])])
    name = str(state.groups.name[number]) if number >= 0 else "boundary"
    if not any(link.two_way and {link.a, link.b} == {name, mine} for link in state.associations):
        what = f"the groups {name!r} and {mine!r} do not shape one another in this hull"
        remedy = "that is declared when a hull is made; make single points knuckles (edit.set_kind)"
        raise BadInputError(what, where, remedy)
    return number


def _turn_section(edit: Transaction, row: int, section: int, contact: int) -> None:
    """Let a section turn at a contact in the place of a point; a crossing is driven from now on."""
    state = edit.state
    rows: IntArray = state.curves.rows[section]
    if row in rows:
        edit.maker.define(section, np.where(rows == row, contact, rows))
    else:
        insert_defining_point(edit.maker, section, contact)
    edit.pending.curves.add(section)
    edit.pending.by_hand.add((contact, section))
    if state.rows.sort[row] != Sort.CROSSING:
        edit.maker.remove_rows([row])
        return
    side = int(state.rows.curve[row, 1] == section)
    if state.rows.role[row] == Role.SHARED:
        role = Role.DRIVES_A if side else Role.DRIVES_B
        edit.maker.roles(np.array([row]), np.array([int(role)]))
        edit.journal.put(state.rows.override, [row], int(role))
    _pass(edit, row, 1 - side, PointKind.KNUCKLE)


def _pass(edit: Transaction, row: int, side: int, kind: PointKind) -> None:
    """Let a curve pass one of its points in a knuckle, or smoothly."""
    state = edit.state
    kinds = state.rows.kind[row].copy()
    kinds[side] = kind
    edit.journal.put(state.rows.kind, [row], kinds[None])
    curve = int(state.rows.curve[row, side])
    edit.pending.curves.add(curve)
    edit.pending.by_hand.add((row, curve))


def _split_passing(edit: Transaction, curve: int, named: Sequence[int], where: str) -> None:
    """Split the lines that pass a new knuckle line where it comes to their planes."""
    state = edit.state
    meets: CurveIntersections = state.curves.meets[curve]
    taken = [
        (state.line_of(int(each)), state.rows.xyz[row])
        for row in named for each in state.rows.curve[row] if each >= 0
    ]  # fmt: skip
    limit, specs = _OFF * one_place(state), list[CrossingSpec]()
    for spot, line in enumerate(meets.line.tolist()):
        place = meets.xyz[spot]
        here = _HERE * state.tolerances.factor
        known = any(each == line and np.abs(at - place).max() < here for each, at in taken)
        if known or state.family(line).axis == 0:
            continue
        if not generates(state, state.line_of(curve), line)[0]:
            continue
        other, off = _nearest(state, line, place)
        if off <= limit:
            specs.append(
                CrossingSpec(
                    curve, other, place, Role.DRIVES_B, int(meets.sign[spot]),
                    contact=True, kind_b=PointKind.KNUCKLE,
                )
            )  # fmt: skip
        elif off <= one_place(state):
            what = f"it passes {state.lines.name[line]} {off:.3g} m off"
            remedy = "choose points that lie on one line of the hull"
            raise BadInputError(what, where, remedy)
    for contact, spec in zip(edit.maker.crossings(specs).tolist(), specs, strict=True):
        insert_defining_point(edit.maker, spec.b, contact)
        edit.pending.curves.add(spec.b)
        edit.pending.by_hand.add((contact, spec.b))


def _nearest(state: HullState, line: int, place: FloatArray) -> tuple[int, float]:
    """Give the curve of a line that passes a place most nearly, and how far off, m."""
    off = {
        curve: float(closest_points(state.spline(curve), 0, place[None])[2][0])
        for curve in state.curves_of(line)
    }
    best = min(off, key=lambda curve: off[curve])
    return best, off[best]


def _contacts(state: HullState, curve: int) -> IntArray:
    """Give the contacts of a boundary curve."""
    rows = state.rows
    found: IntArray = np.flatnonzero(
        rows.alive.data & rows.contact.data & (rows.curve.data[:, 0] == curve)
    )
    return found


# --------------------------------------------------------------------------------------
# Taking one away.


def remove_knuckle_line(edit: Transaction, line: int) -> None:
    """Take a knuckle line away: what it split is smooth again, and has its points back.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The knuckle line.

    Raises
    ------
    BadInputError
        It is none.
    """
    state = edit.state
    name = str(state.lines.name[line])
    if state.lines.boundary[line] != BoundaryKind.KNUCKLE:
        what, remedy = f"{name} is no knuckle line", "use edit.remove_line for other lines"
        raise BadInputError(what, "in remove_knuckle_line", remedy)
    edit.pending.structural = True
    for curve in state.lines.curves[line]:
        contacts = _contacts(state, int(curve))
        edit.refuse_moved(contacts)
        edit.pending.gone += sorted(str(state.rows.key[row]) for row in contacts.tolist())
        for row in contacts.tolist():
            _smooth(edit, row)
        mine = state.rows.alive.data & (state.rows.curve.data == curve).any(axis=1)
        edit.maker.remove_rows(np.flatnonzero(mine))
        edit.journal.put(state.curves.alive, [curve], False)
        edit.pending.curves.discard(int(curve))
    remove_line_plane(edit, line)
    edit.journal.put(state.lines.alive, [line], False)


def _smooth(edit: Transaction, contact: int) -> None:
    """Let the line at a contact be smooth there again, through what was there before it."""
    state, curve = edit.state, int(edit.state.rows.curve[contact, 1])
    rows: IntArray = state.curves.rows[curve]
    for each in state.rows.curve[contact].tolist():
        make_latent(edit.maker, each, contact)
    edit.pending.curves.add(curve)
    if state.family(state.line_of(curve)).axis != 0:
        edit.maker.define(curve, rows[rows != contact])
        return
    back = -1
    for row in _driven_there(state, curve, contact):
        side = int(state.rows.curve[row, 1] == curve)
        _pass(edit, row, 1 - side, PointKind.SMOOTH)
        if state.rows.override[row] >= 0 and back < 0:
            back = row
            edit.maker.roles(np.array([row]), np.array([int(Role.SHARED)]))
            edit.journal.put(state.rows.override, [row], -1)
            edit.journal.put(state.rows.xyz, [row], state.rows.xyz[[contact]])
    if back < 0:
        spec = PointSpec(curve, state.rows.xyz[contact].copy(), Sort.ADOPTED)
        back = int(edit.maker.points([spec])[0])
    edit.maker.define(curve, np.where(rows == contact, back, rows))


def _driven_there(state: HullState, curve: int, contact: int) -> list[int]:
    """Give the crossings that a section drives at a contact of it."""
    table = state.rows
    near = (
        np.abs(table.xyz.data - table.xyz.data[contact]).max(axis=1)
        < _HERE * state.tolerances.factor
    )
    driven = table.alive.data & near & (table.driver.data == curve)
    found: list[int] = np.flatnonzero(driven).tolist()
    return found
