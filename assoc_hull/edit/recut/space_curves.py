"""Drivers that a mapping bends out of their planes: they become curves in space.

A space curve has no plane that other lines could be cut with. What it crosses passes
through it as through a knuckle line without a knuckle: the crossing lies on the space curve
where that meets the other line's plane, with two freedoms, and always defines the line.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.newline.plane_intersections import strike_line
from assoc_hull.edit.recut.carried_points import Carried
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.kinds import Role, Sort

__all__ = ["bend_lines", "let_go"]

_SAME = 1e-3
"""Two points of a boundary curve as near as this (m) are one."""


def bend_lines(work: Carried) -> None:
    """Give the crossings of lines that become space curves the roles they can have.

    Raises
    ------
    BadInputError
        A bent line is cut from one of lower rank that stays in its plane.
    """
    state = work.state
    for line in _bent(work):
        for row in _crossings(work, line).tolist():
            a, b = (state.line_of(c) for c in state.rows.curve.data[row].tolist())
            role = int(state.rows.role.data[row])
            if state.lines.boundary.data[a] >= 0:
                _share(work, row)
            elif b == line and a not in work.planes.bent:
                _refuse(work, line, int(state.rows.curve.data[row, 0]))
            elif role == Role.DRIVES_A or (role == Role.DRIVES_B and b in work.planes.bent):
                work.gone.add(row)
            else:
                work.maker.journal.put(state.rows.contact, [row], role != Role.WATCHED)


def _bent(work: Carried) -> list[int]:
    """Give the lines that become space curves, but for boundary curves, by key."""
    lines = work.state.lines
    inner = [line for line in work.planes.bent if lines.boundary.data[line] < 0]
    return sorted(inner, key=lambda line: str(lines.key.data[line]))


def _crossings(work: Carried, line: int) -> IntArray:
    table = work.state.rows
    mine = np.isin(table.curve.data, work.state.lines.curves.data[line]).any(axis=1)
    found: IntArray = np.flatnonzero(table.alive.data & mine & (table.sort.data == Sort.CROSSING))
    return found


def _share(work: Carried, row: int) -> None:
    """Let a contact define its boundary curve too, which cannot meet the line's plane now.

    An adopted point of the boundary curve in the same place gives way, with its kind.
    """
    table, put = work.state.rows, work.maker.journal.put
    if table.role.data[row] == Role.SHARED:
        return
    boundary = int(table.curve.data[row, 0])
    rows: IntArray = work.state.curves.rows.data[boundary]
    step = table.xyz.data[rows] - table.xyz.data[row]
    near = rows[np.sqrt((step * step).sum(axis=1)) < _SAME]
    for other in near.tolist():
        if table.sort.data[other] != Sort.ADOPTED:
            _refuse(work, work.state.line_of(int(table.curve.data[row, 1])), boundary)
        side = int(table.curve.data[other, 0] != boundary)
        kind, direction = table.kind.data[row].copy(), table.direction.data[row].copy()
        kind[0], direction[0] = table.kind.data[other, side], table.direction.data[other, side]
        put(table.kind, [row], [kind])
        put(table.direction, [row], [direction])
        work.gone.add(other)
    work.extra.setdefault(boundary, []).append((float(table.parameter.data[row, 0]), row))
    work.maker.roles(np.array([row]), np.array([int(Role.SHARED)]))


def _refuse(work: Carried, line: int, curve: int) -> None:
    names = work.state.lines.name.data
    other = names[work.state.line_of(curve)]
    raise BadInputError(
        f"the mapping bends {names[line]} {work.planes.bent[line]:.3g} m out of its plane, and "
        f"{other} cannot meet it as a curve in space", "in transform",
        f"leave {names[line]} a follower, or use a mapping that keeps its plane",
    )  # fmt: skip


def let_go(edit: Transaction, work: Carried) -> None:
    """Take out the planes of bent lines, and the crossings that only they measured."""
    table = edit.state.rows
    for line in sorted(work.planes.bent):
        strike_line(edit, line)
        if edit.state.lines.boundary.data[line] < 0:
            rows = _crossings(work, line)
            watched = rows[table.role.data[rows] == Role.WATCHED]
            work.gone |= set(watched.tolist())
            if len(watched):
                edit.pending.notes.append(
                    f"{edit.state.lines.name.data[line]}: {len(watched)} watched crossings are "
                    "watched no more: a curve in space has no plane to measure them by"
                )
