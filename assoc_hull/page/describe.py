"""A hull in words and numbers for the browser: lines, points, roles, freedoms; never shapes."""

from __future__ import annotations

from typing import Any

import numpy as np

from assoc_hull.edit.displacement_field import on_flat, on_profile
from assoc_hull.edit.document import Document
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import FAMILIES, Role, Sort
from assoc_hull.model.links import free_axes
from assoc_hull.model.tables import HullState, Particulars

__all__ = ["describe_net", "describe_state", "net_words"]


def describe_net(state: HullState) -> dict[str, Any]:
    """Give what the browser is told of a net: its lines, and its points column by column.

    Points come in the order of their rows. ``role`` is a `Role` and -1 of a point that is no
    crossing; ``driver`` is the curve that computes it, or -1; ``free`` names its coordinates.
    ``held`` is 1 on a flat, 2 on the profile: a pull there is refused.
    """
    book, table = AddressBook(state), state.rows
    rows = state.live("rows")
    crossing = table.sort[rows] == Sort.CROSSING
    role = np.where(crossing, table.role[rows], -1)
    computed = role > Role.SHARED
    numbers = rows.tolist()
    return {
        "t": "net",
        "state": state.number,
        "particulars": _particulars(state.particulars),
        "lines": [_line(state, book, line) for line in state.live("lines").tolist()],
        "points": {
            "row": numbers,
            "name": [book.address(row) for row in numbers],
            "label": [str(table.label[row] or "") for row in numbers],
            "a": table.curve[rows, 0].tolist(),
            "b": table.curve[rows, 1].tolist(),
            "sort": table.sort[rows].tolist(),
            "role": role.tolist(),
            "driver": np.where(crossing, table.driver[rows], -1).tolist(),
            "kind": table.kind[rows].tolist(),
            "held": np.where(on_flat(state), 1, np.where(on_profile(state), 2, 0))[rows].tolist(),
            "free": [
                "" if fixed else "".join(free_axes(state, row))
                for row, fixed in zip(numbers, computed.tolist(), strict=True)
            ],
        },
    }


def net_words(state: HullState) -> tuple[object, ...]:
    """Give what of `describe_net` may change though no line, point or role came or went."""
    rows, labels = state.live("rows"), state.rows.label
    return (
        state.particulars, np.asarray(state.rows.kind[rows]).tobytes(),
        tuple(state.lines.name[line] for line in state.live("lines").tolist()),
        tuple(labels[row] for row in rows.tolist()),
    )  # fmt: skip


def _particulars(ship: Particulars) -> dict[str, Any]:
    return {"name": ship.name, "length": ship.length, "breadth": ship.breadth,
            "depth": ship.depth, "draught": ship.draught}  # fmt: skip


def _line(state: HullState, book: AddressBook, line: int) -> dict[str, Any]:
    """Describe a line; `axis` is the coordinate that is constant on it, at `offset` (m)."""
    table = state.lines
    family = str(state.groups.family[int(table.group[line])])
    axis, offset = FAMILIES[family].axis, float(table.offset[line])
    normal = table.normal[line]
    if not table.planar[line] or axis is None or abs(normal[axis]) != 1.0:
        axis = None
    curves = list(table.curves[line])
    return {
        "id": line,
        "name": book.line_name(line),
        "family": family,
        "axis": axis,
        "offset": None if axis is None else offset * float(normal[axis]),
        "boundary": int(table.boundary[line]),
        "curves": curves,
        "names": [book.curve_name(curve) for curve in curves],
    }


def describe_state(document: Document, author: str) -> dict[str, Any]:
    """Tell which state is published, and what this author could take back or make again.

    ``undo`` is None where there is nothing; ``above`` tells whose edit lies on top, if it is not
    the author's own.
    """
    done, undone = document.history, document.undone
    last = done[-1] if done else None
    theirs = last is not None and last.author != author
    return {
        "t": "state",
        "state": document.state_number,
        "edits": len(done),
        "undo": None if last is None else last.name,
        "above": last.author if last is not None and theirs else None,
        "redo": undone[-1].name if undone else None,
    }
