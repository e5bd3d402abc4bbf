"""A section once more, elsewhere along the ship: where the hull is a cylinder, it is the same.

A section that `add_line` cuts goes through the lines that it crosses, and knows nothing of what
lies between them. A copy has all points of its model, with kinds and directions, and its features.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.arguments import line_name
from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.lines.line_planes import new_plane
from assoc_hull.edit.lines.plane_intersections import enter_line_plane
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.features import Feature
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import CrossingSpec, PointSpec
from assoc_hull.model.tables import HullState

__all__ = ["copy_section"]


def copy_section(edit: Transaction, line: int, away: float, name: str) -> int:
    """Copy a section along the ship, and give the number of the copy.

    Lines that pass its model pass the copy at the same half-breadth and height, and those that the
    model's crossings define are defined by the copy's as well.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        The section.
    away : float, m
        How far forward of it the copy stands; negative: abaft.
    name : str

    Raises
    ------
    BadInputError
        There is a line in that plane already, or the name is none.
    """
    state, maker = edit.state, edit.maker
    group = int(state.lines.group[line])
    x = float(state.lines.offset[line]) + away
    cut = new_plane(state, str(state.groups.name[group]), x)
    edit.pending.structural = True
    copy = maker.line(group, line_name(name), (cut.normal, cut.offset), key=cut.key)
    twins = dict[int, int]()
    for curve in state.lines.curves[line]:
        twins |= _copy_curve(edit, curve, copy, x)
    maker.features([*state.features, *_features(state, line, copy, away, twins)])
    enter_line_plane(edit, copy)
    return copy


def _copy_curve(edit: Transaction, curve: int, copy: int, x: float) -> dict[int, int]:
    """Copy one curve of a section; give its points by those of the model."""
    state, maker, put = edit.state, edit.maker, edit.journal.put
    table = state.rows
    new = maker.curve(copy, state.curves.ends[curve])
    mine = table.alive.data & (table.curve.data == curve).any(axis=1)
    crossings = np.flatnonzero(mine & (table.sort.data == Sort.CROSSING)).tolist()
    own = [row for row in state.curves.rows[curve].tolist() if table.sort[row] != Sort.CROSSING]
    made = maker.crossings([_crossing(state, row, curve, new, x) for row in crossings]).tolist()
    put(table.kind, made, table.kind[crossings])
    put(table.direction, made, table.direction[crossings])
    put(table.override, made, table.override[crossings])
    points = maker.points([
        PointSpec(new, _at(table.xyz[row], x), Sort(int(table.sort[row])), int(table.kind[row, 0]),
                  table.direction[row, 0].copy())
        for row in own
    ]).tolist()  # fmt: skip
    twins = dict(zip([*crossings, *own], [*made, *points], strict=True))
    maker.define(new, [twins[row] for row in state.curves.rows[curve].tolist()])
    for row in made:
        for side, other in enumerate(table.curve[row].tolist()):
            if other != new and table.reader[row, side] == other:
                insert_defining_point(maker, other, row)
                edit.pending.curves.add(other)
    edit.pending.born += sorted(str(table.key[row]) for row in made)
    return twins


def _at(place: FloatArray, x: float) -> FloatArray:
    return np.array([x, place[1], place[2]])


def _crossing(state: HullState, row: int, curve: int, new: int, x: float) -> CrossingSpec:
    """Give the crossing of a copied curve that stands for one of its model."""
    table = state.rows
    a, b = (new if each == curve else each for each in table.curve[row].tolist())
    spots = _at(table.spot[row, 0], x), _at(table.spot[row, 1], x)
    return CrossingSpec(
        a, b, _at(table.xyz[row], x), Role(int(table.role[row])), int(table.sign[row]), spots,
        contact=bool(table.contact[row]),
    )  # fmt: skip


def _features(
    state: HullState, line: int, copy: int, away: float, twins: dict[int, int]
) -> list[Feature]:
    """Give the features of a section once more, of those that lie on it alone."""
    keys, names = state.lines.key, state.lines.name
    found = list[Feature]()
    for each in state.features:
        if each.lines != (str(keys[line]),):
            continue
        centre = None if each.centre is None else (each.centre[0] + away, *each.centre[1:])
        x = [float(state.rows.xyz[row, 0]) for row in (each.points[0], twins[each.points[0]])]
        key = each.key.replace(str(keys[line]), str(keys[copy]), 1)
        key = key.replace(f"({x[0]:.4f},", f"({x[1]:.4f},")
        found.append(attrs.evolve(
            each, key=key, name=each.name.replace(str(names[line]), str(names[copy]), 1),
            lines=(str(keys[copy]),), points=tuple(twins[row] for row in each.points),
            centre=centre,
        ))  # fmt: skip
    return found
