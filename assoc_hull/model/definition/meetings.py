"""Meetings by the keys of lines and crossings, and back into the order the update keeps.

In the tables the meetings of a curve lie group by group, along each group by plane; in a
definition they lie under the keys of the lines.

Examples
--------
>>> from assoc_hull.model.definition.meetings import meet_order
>>> from assoc_hull.model.state import HullState, Particulars
>>> meet_order(HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0)))
{}
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import attrs
import numpy as np

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.filling import wrong
from assoc_hull.model.index import build_index
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.state import HullState, Meets

__all__ = ["check_meetings", "meet_order", "put_meetings", "put_places"]

Record = Mapping[str, Any]


def meet_order(state: HullState) -> dict[int, list[int]]:
    """Give, for each group, the lines its curves are cut with, in the order of `Meets`."""
    partners = build_index(state).partners
    return {
        group: [line for planes in sets for line in planes.lines.tolist()]
        for group, sets in partners.items()
    }


def put_meetings(
    state: HullState,
    journal: Journal,
    curves: list[Record],
    find: Callable[[str, str, str], int],
) -> None:
    """Put the senses and crossings of all meetings into the tables; places are nan.

    Parameters
    ----------
    state : HullState
        Tables that hold groups, lines, curves, points and associations.
    journal : Journal
        Takes the writes.
    curves : list of mapping
        The curves by number; ``meets`` gives per key of a line [sense, key or None] each.
    find : callable
        Gives the number of an object of a kind by its key.

    Raises
    ------
    BadInputError
        If a line cuts no curves of the group, or a crossing is not one of the two lines.
    """
    order = meet_order(state)
    for number, curve in enumerate(curves):
        group = int(state.lines.group.data[state.line_of(number)])
        place = {line: index for index, line in enumerate(order.get(group, []))}
        parts: list[tuple[int, int, list[list[Any]]]] = []
        for key, met in curve["meets"].items():
            line = find("lines", key, curve["key"])
            if line not in place:
                raise wrong(f"the line {key!r} cuts no curves of its group", f"at {curve['key']!r}")
            parts.append((place[line], line, met))
        lines = [line for _, line, met in sorted(parts) for _ in met]
        spots = [spot for _, _, met in sorted(parts) for spot in met]
        rows = [-1 if key is None else find("points", key, curve["key"]) for _, key in spots]
        journal.set(
            state.curves.meets, [number], [_unplaced(lines, [sign for sign, _ in spots], rows)]
        )
    check_meetings(state)


def _unplaced(lines: list[int], signs: list[int], rows: list[int]) -> Meets:
    count = len(lines)
    return Meets(
        np.array(lines, np.int64),
        np.array(signs, np.int8),
        np.array(rows, np.int64),
        np.full(count, np.nan),
        np.full((count, 3), np.nan),
    )


def check_meetings(state: HullState) -> None:
    """Check that each meeting is a crossing of its curve and line, and each crossing one.

    Raises
    ------
    BadInputError
        If a crossing lies elsewhere or twice, or one that is computed or watched has no
        meeting on a curve that it needs one on.
    """
    table = state.rows
    met = np.zeros((table.count, 2), bool)
    for curve in state.live("curves").tolist():
        meets: Meets = state.curves.meets.data[curve]
        actual = np.flatnonzero(meets.row >= 0)
        rows = meets.row[actual]
        side = (table.curve.data[rows, 0] != curve).astype(np.int64)
        other = table.curve.data[rows, 1 - side]
        fits = table.sort.data[rows] == Sort.CROSSING
        fits &= (table.curve.data[rows, side] == curve) & (other >= 0)
        fits &= state.curves.line.data[np.maximum(other, 0)] == meets.line[actual]
        fits &= np.bincount(rows, minlength=table.count)[rows] == 1
        if not fits.all():
            key = table.key.data[int(rows[~fits][0])]
            raise wrong(
                f"{key!r} is no crossing there, or stands twice",
                f"at {state.curves.key.data[curve]!r}",
            )
        met[rows, side] = True
    _check_needed(state, met)


def _check_needed(state: HullState, met: np.typing.NDArray[np.bool_]) -> None:
    table = state.rows
    need = np.zeros_like(met)
    crossing = table.alive.data & (table.sort.data == Sort.CROSSING)
    need[crossing & (table.role.data == Role.DRIVES_B), 0] = True
    need[crossing & (table.role.data == Role.DRIVES_A), 1] = True
    need[crossing & (table.role.data == Role.WATCHED)] = True
    for row, side in np.argwhere(need & ~met).tolist():
        curve = state.curves.key.data[int(table.curve.data[row, side])]
        raise wrong(f"{table.key.data[row]!r} has no meeting on {curve!r}", "in the curves")


def put_places(
    state: HullState,
    journal: Journal,
    curve: int,
    met: Mapping[str, list[list[float]]],
) -> None:
    """Put the stored parameters and places (t, x, y, z; m) of a curve's meetings back.

    Raises
    ------
    BadInputError
        If they are not as many as the meetings, line by line.
    """
    meets: Meets = state.curves.meets.data[curve]
    keys = [state.lines.key.data[line] for line in meets.line.tolist()]
    counts = {key: len(places) for key, places in met.items()}
    if counts != {key: keys.count(key) for key in keys}:
        raise wrong(
            f"there are places for {sum(counts.values())} meetings, and {len(keys)} meetings",
            f"at {state.curves.key.data[curve]!r}",
        )
    spots = np.array([spot for key in dict.fromkeys(keys) for spot in met[key]], np.float64)
    spots = spots.reshape(-1, 4)
    placed = attrs.evolve(meets, parameter=spots[:, 0].copy(), xyz=spots[:, 1:].copy())
    journal.set(state.curves.meets, [curve], [placed])
    _write_spots(state, journal, curve, placed)


def _write_spots(state: HullState, journal: Journal, curve: int, meets: Meets) -> None:
    """Note on the crossings where they lie on the curve."""
    actual = meets.row >= 0
    rows: IntArray = meets.row[actual]
    table = state.rows
    side = (table.curve.data[rows, 0] != curve).astype(np.int64)
    spot, at = table.spot.data[rows].copy(), table.parameter.data[rows].copy()
    spot[np.arange(len(rows)), side] = meets.xyz[actual]
    at[np.arange(len(rows)), side] = meets.parameter[actual]
    journal.put(table.spot, rows, spot)
    journal.put(table.parameter, rows, at)
