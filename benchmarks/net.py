"""The benchmark net as a hull: 130 lines and all their crossings, alone or many side by side.

The points of the sections are placed; sections drive waterlines and buttocks through
one-way associations. Waterlines and buttocks are associated both ways, but every crossing of
the two is set to be watched: then the edit of one section re-lofts that section and the 70
lines that cross it, each once, and nothing else.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.loft_hull import loft_all, set_limits
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import Association, HullState, Particulars
from assoc_hull.tolerance import Tolerances
from benchmarks.shape import FAMILIES, SECTIONS, Shape, shape

__all__ = ["MIDSHIP", "make_net", "section_rows"]

MIDSHIP = len(SECTIONS) // 2
"""The section that is edited: all 70 lines cross it."""


def make_net(lines: Shape | None = None) -> HullState:
    """Adopt the net, and set the roles."""
    given = (lines or shape()).families()
    sources = [
        LineSource.make(name, f"{name} {number}", points, placed=name == "sections")
        for (name, _, _), family in zip(FAMILIES, given, strict=True)
        for number, points in enumerate(family)
    ]
    links = [
        Association("sections", "waterlines", two_way=False),
        Association("sections", "buttocks", two_way=False),
        Association("waterlines", "buttocks"),
    ]
    ship = Particulars("benchmark net", 100.0, 16.0, 10.0, 8.0)
    # So close may crossings stand that all those with sections define.
    state, _ = adopt(sources, ship, links, Tolerances(spacing=1e-3, transversal_deg=1.0))
    _watch(state)
    return state


def _watch(state: HullState) -> None:
    """Let the crossings of waterlines and buttocks define neither."""
    journal = Journal()
    maker = Maker(state, journal)
    family = state.lines.group[state.curves.line.data]
    curve = state.rows.curve.data
    sections = state.groups.name.data.index("sections")
    of_two = (curve[:, 1] >= 0) & (family[curve] != sections).all(axis=1)
    rows = np.flatnonzero(of_two & (state.rows.sort.data == Sort.CROSSING))
    maker.roles(rows, np.full(len(rows), int(Role.WATCHED)))
    journal.put(state.rows.override, rows, int(Role.WATCHED))
    for number in np.flatnonzero(family != sections).tolist():
        defining: IntArray = state.curves.rows[number]
        maker.define(number, defining[~np.isin(defining, rows)])
    loft_all(state, journal)
    set_limits(state, journal)


def section_rows(state: HullState, number: int = MIDSHIP) -> IntArray:
    """Give the placed points of a section, upward."""
    title = state.lines.name.data.index(f"sections {number}")
    (curve,) = state.lines.curves[title]
    rows: IntArray = state.curves.rows[curve]
    return rows
