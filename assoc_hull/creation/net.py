"""The net of a design: what the definitions draw, and the lines that are cut from it.

Everything is associated one way: boundary curves give ends to all lines, sections give points to
waterlines and buttocks, waterlines to buttocks. So definitions shape the hull and nothing that is
edited runs back against them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.creation.design import Design
from assoc_hull.creation.drawn import Drawn, boundary_curves, section_curves
from assoc_hull.creation.straight import go_straight
from assoc_hull.edit.adoption.adopt import adopt
from assoc_hull.edit.adoption.report import AdoptionReport
from assoc_hull.edit.document import Document
from assoc_hull.edit.newline.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.graph.journal import Journal
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.state import Association, HullState

__all__ = ["LINKS", "build_net"]

LINKS = tuple(
    Association(a, b, two_way=False)
    for a, b in (
        ("boundary", "sections"),
        ("boundary", "waterlines"),
        ("boundary", "buttocks"),
        ("sections", "waterlines"),
        ("sections", "buttocks"),
        ("waterlines", "buttocks"),
    )
)
"""Which lines give points to which."""


def build_net(design: Design) -> tuple[HullState, AdoptionReport]:
    """Make the net of a design.

    Parameters
    ----------
    design : Design
        The design.

    Returns
    -------
    HullState, AdoptionReport
        The net with its definitions; how its sections and boundary curves were adopted.

    Raises
    ------
    BadInputError, OutOfRangeError
        Definitions of which no section can be made at some station; the error names both.
    RefusedEditError
        A waterline or a buttock that cannot be cut.
    """
    forms = Forms.of(design.definitions, design.particulars)
    boundary = boundary_curves(design, forms)
    drawn = [*boundary, *section_curves(design, forms, boundary)]
    state, report = adopt(
        [each.source for each in drawn], design.particulars, LINKS, design.tolerances
    )
    _hand_over(state, design, drawn)
    document = Document(state)
    for z in design.waterlines:
        with Transaction(document, f"cut waterline {z:g}") as edit:
            go_straight(edit, forms, add_line(edit, "waterlines", z))
    for y in design.buttocks:
        with Transaction(document, f"cut buttock {y:g}") as edit:
            add_line(edit, "buttocks", y)
    return state, report


def _hand_over(state: HullState, design: Design, drawn: Sequence[Drawn]) -> None:
    """Let the points of drawn curves be those of definitions: adopted, no longer placed."""
    maker = Maker(state, Journal())
    maker.definitions(design.definitions)
    names = {name: number for number, name in enumerate(state.groups.name.data)}
    lines = {
        (int(state.lines.group.data[line]), state.lines.name.data[line]): line
        for line in state.live("lines").tolist()
    }
    parts: dict[int, list[Drawn]] = {}
    for each in drawn:
        line = lines[names[each.source.group], each.source.name]
        parts.setdefault(line, []).append(each)
    made = []
    for line, several in parts.items():
        for each, curve in zip(several, _from_below(maker, line), strict=True):
            rows_of = state.curves.rows.data[curve].tolist()
            made.append(each.generated(state.curves.key.data[curve], curve, rows_of))
    rows = np.array(sorted(row for each in made for row in each.rows), np.int64)
    maker.journal.put(state.rows.sort, rows, int(Sort.ADOPTED))
    maker.generated(made)


def _from_below(maker: Maker, line: int) -> list[int]:
    """Give the curves of a line from below, and let their order and their keys be this one."""
    state = maker.state
    curves: tuple[int, ...] = state.lines.curves.data[line]
    foot = [float(state.rows.xyz.data[state.curves.rows.data[curve][0], 2]) for curve in curves]
    ordered = [curve for _, curve in sorted(zip(foot, curves, strict=True))]
    if tuple(ordered) != curves:
        keys = sorted(state.curves.key.data[curve] for curve in curves)
        maker.journal.set(state.curves.key, ordered, keys)
        maker.journal.set(state.lines.curves, [line], [tuple(ordered)])
    return ordered
