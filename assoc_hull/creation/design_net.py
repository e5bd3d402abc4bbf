"""Make the net of a design: boundary curves and sections drawn, other lines cut from them.

Everything is associated one way: boundary curves give ends to all lines, sections give points to
waterlines and buttocks, waterlines to buttocks. So definitions shape the hull, and no edit runs
back against them. `build_net` is the way in.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.creation.design import Design
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.graph.journal import Journal
from assoc_hull.model.form_definition import GeneratedCurve, Mark
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import (
    generated_points,
    marks_for,
    marks_of,
    point_kinds_at,
)
from assoc_hull.model.forms.line_layout import ends_for, layout_at
from assoc_hull.model.generated_curves import end_points, line_offset
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.line_source import LineSource, line_curve_data
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.tables import Association, HullState

__all__ = [
    "LINKS",
    "DrawnCurve",
    "boundary_curves",
    "build_net",
    "section_curves",
    "straighten_on_flat",
]

# --------------------------------------------------------------------------------------
# Curves as the definitions draw them: boundary curves, then the sections that end on them.

_ACROSS, _AHEAD = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)

_NOWHERE = np.full((2, 3), np.nan)
"""The ends of a curve that ends by itself."""

_LEVEL = 1e-9
"""A deck edge whose points lie within this (m) of one height lies in a plane."""

_TOLERANCE = 1e-6
"""How far (m) a curve may pass a point through which it is made: rounding only."""


@attrs.frozen(eq=False)
class DrawnCurve:
    """A curve that comes from definitions, before it is part of a net.

    Attributes
    ----------
    source : LineSource
        The curve, with its ends.
    what, layout : str
        What is generated, and of which pieces.
    marks : tuple of Mark
        Where the generated points lie on the pieces.
    first : int
        Which point of the source is the first generated one: 1 where the ends are crossings.
    """

    source: LineSource
    what: str
    layout: str
    marks: tuple[Mark, ...]
    first: int

    def generated(self, key: str, curve: int, rows: Sequence[int]) -> GeneratedCurve:
        """Give what a hull keeps of it, from all the points that define its curve."""
        last = self.first + len(self.marks)
        return GeneratedCurve(
            key, curve, self.what, self.layout, tuple(rows[self.first : last]), self.marks
        )


def boundary_curves(design: Design, forms: Forms) -> list[DrawnCurve]:
    """Draw profile, deck edge and, where there is one, transom."""
    found = [
        _boundary(forms, "profile", np.nan, (_ACROSS, 0.0)),
        _boundary(forms, "deck edge", np.nan, None),
    ]
    if design.transom is not None:
        plane = (_AHEAD, design.transom)
        found.append(_boundary(forms, "transom", design.transom, plane))
    return found


def _boundary(
    forms: Forms, what: str, place: float, plane: tuple[tuple[float, float, float], float] | None
) -> DrawnCurve:
    layout = layout_at(forms, what, place)
    marks, kind, direction, ends = marks_for(forms, what, layout, place, _NOWHERE)
    points = _points(forms, what, layout, marks, place, _NOWHERE)
    if plane is None and float(np.ptp(points[:, 2])) <= _LEVEL:
        plane = ((0.0, 0.0, 1.0), float(points[0, 2]))
    source = LineSource.make(
        "boundary", what, points, plane=plane, boundary=BoundaryKind.END, kind=kind,
        direction=direction, ends=ends, placed=True, tolerance=_TOLERANCE,
    )  # fmt: skip
    return DrawnCurve(source, what, layout, tuple(marks), 0)


def _points(
    forms: Forms, what: str, layout: str, marks: Sequence[Mark], place: float, ends: FloatArray
) -> FloatArray:
    made = GeneratedCurve("", 0, what, layout, tuple(range(len(marks))), tuple(marks))
    found: FloatArray = generated_points(forms, [made], np.array([place]), ends[None])[0]
    return found + 0.0


def section_curves(
    design: Design, forms: Forms, boundary: Sequence[DrawnCurve]
) -> list[DrawnCurve]:
    """Draw the sections of a design, which end on profile and deck edge (`boundary`).

    Raises BadInputError for a station that these do not reach, or where a section begins and does
    not end; OutOfRangeError where the definitions ask for a section that is impossible.
    """
    edges = loft(line_curve_data([each.source for each in boundary if each.what != "transom"]))
    stands = [
        (f"ST {station:g}", x, ends, layout_at(forms, "section", x, part))
        for station, x in zip(design.stations, design.station_places, strict=True)
        for part, ends in enumerate(_section_ends(edges, station, x))
    ]
    alike: dict[str, list[int]] = {}
    for number, (*_, layout) in enumerate(stands):
        alike.setdefault(layout, []).append(number)
    found: list[DrawnCurve | None] = [None] * len(stands)
    for layout, numbers in alike.items():
        names, x, ends = zip(*(stands[number][:3] for number in numbers), strict=True)
        sections = _sections(forms, names, np.array(x), np.array(ends), layout)
        for number, section in zip(numbers, sections, strict=True):
            found[number] = section
    return [each for each in found if each is not None]


def _section_ends(edges: SplineBatch, station: float, x: float) -> list[FloatArray]:
    """Give the ends of the curves of a section, (2, 3) each, m, from below."""
    crossings = intersect_planes(edges, np.array(_AHEAD), np.array([x])).xyz
    where = f"at station {station:g} (x = {x:g} m)"
    if not len(crossings):
        raise BadInputError("there is no hull", where, "leave it out, or extend the profile")
    if len(crossings) % 2:
        what = f"profile and deck edge pass it {len(crossings)} times: a section would not end"
        raise BadInputError(what, where, "shift it a little, or extend the deck edge")
    crossings = crossings[np.argsort(crossings[:, 2], kind="stable")] + 0.0
    crossings[:, 0] = x
    return [crossings[i : i + 2] for i in range(0, len(crossings), 2)]


def _sections(
    forms: Forms, names: Sequence[str], x: FloatArray, ends: FloatArray, layout: str
) -> list[DrawnCurve]:
    """Draw sections of one layout at x, (n,) m, between ends, (n, 2, 3) m: alike ones at once."""
    marks = marks_of(forms, "section", layout, x, ends, [()] * len(names))
    made = [
        GeneratedCurve("", 0, "section", layout, tuple(range(len(each))), each) for each in marks
    ]
    smooth, conditions = [int(PointKind.SMOOTH)], ends_for(layout)
    found = []
    for number, points in enumerate(generated_points(forms, made, x, ends)):
        kinds, directions = point_kinds_at(layout, marks[number])
        # The ends are crossings: they have no direction of their own.
        given = np.zeros((len(points) + 2, 3))
        given[1:-1] = directions
        source = LineSource.make(
            "sections", names[number],
            np.concatenate([ends[number, :1], points + 0.0, ends[number, 1:]]),
            plane=(_AHEAD, float(x[number])), kind=[*smooth, *kinds, *smooth], direction=given,
            ends=conditions, placed=True, tolerance=_TOLERANCE,
        )  # fmt: skip
        found.append(DrawnCurve(source, "section", layout, marks[number], 1))
    return found


def straighten_on_flat(edit: Transaction, forms: Forms, line: int, what: str) -> None:
    """Insert the two points at which a waterline or a buttock comes onto its flat and leaves it.

    Between them it is straight: they are tangent points, which the definitions generate. `edit` is
    the one in which the line was cut.
    """
    state = edit.state
    place = float(state.lines.offset[line])
    layout = layout_at(forms, what, place)
    curves = [curve for curve in state.lines.curves[line] if state.curves.alive[curve]]
    if not layout or len(curves) != 1:
        return
    curve = curves[0]
    ends = end_points(state, curves)[0]
    marks, kind, direction, _ = marks_for(forms, what, layout, place, ends)
    made = GeneratedCurve(state.curves.key[curve], curve, what, layout, (), tuple(marks))
    places = generated_points(forms, [made], np.array([line_offset(state, curve)]), ends[None])[0]
    specs = [
        PointSpec(curve, xyz, Sort.ADOPTED, int(each), way)
        for xyz, each, way in zip(places, kind, direction, strict=True)
    ]
    rows = edit.maker.points(specs)
    _drop_near_crossings(edit, curve, places)
    for row in rows.tolist():
        insert_defining_point(edit.maker, curve, row)
    edit.pending.curves.add(curve)
    edit.maker.generated([*state.generated, made.evolve(rows=tuple(rows.tolist()))])


def _drop_near_crossings(edit: Transaction, curve: int, places: FloatArray) -> None:
    """Let no crossing define a waterline that lies nearly where a point of the flat does."""
    state = edit.state
    rows: IntArray = state.curves.rows[curve]
    step = state.rows.xyz[rows][:, None] - places[None]
    near = np.sqrt((step * step).sum(axis=2)).min(axis=1) < state.tolerances.adopted_spacing
    # The ends lie on boundary curves: without them the line would not reach these.
    near[[0, -1]] = False
    crowded = rows[near]
    if not len(crowded):
        return
    edit.maker.define(curve, rows[~near])
    edit.maker.roles(crowded, np.full(len(crowded), int(Role.WATCHED)))
    edit.journal.put(state.rows.limit, crowded, 2.0 * state.tolerances.adoption)


# --------------------------------------------------------------------------------------
# The net.

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
    """Make the net of a design; also report how its sections and boundary curves were adopted.

    Raises BadInputError or OutOfRangeError where no section can be made at some station (the error
    names both), RefusedEditError for a waterline or a buttock that cannot be cut.
    """
    forms = Forms.of(design.definitions, design.particulars)
    boundary = boundary_curves(design, forms)
    drawn = [*boundary, *section_curves(design, forms, boundary)]
    state, report = adopt(
        [each.source for each in drawn], design.particulars, LINKS, design.tolerances
    )
    _adopt_points(state, design, drawn)
    document = Document(state)
    for z in design.waterlines:
        with Transaction(document, f"cut waterline {z:g}") as edit:
            straighten_on_flat(edit, forms, add_line(edit, "waterlines", z), "waterline")
    for y in design.buttocks:
        with Transaction(document, f"cut buttock {y:g}") as edit:
            add_line(edit, "buttocks", y)
    return state, report


def _adopt_points(state: HullState, design: Design, drawn: Sequence[DrawnCurve]) -> None:
    """Let the points of drawn curves be those of definitions: adopted, no longer placed."""
    maker = Maker(state, Journal())
    maker.definitions(design.definitions)
    names = {name: number for number, name in enumerate(state.groups.name.data)}
    lines = {
        (int(state.lines.group[line]), state.lines.name[line]): line
        for line in state.live("lines").tolist()
    }
    parts: dict[int, list[DrawnCurve]] = {}
    for each in drawn:
        line = lines[names[each.source.group], each.source.name]
        parts.setdefault(line, []).append(each)
    made = []
    for line, several in parts.items():
        for each, curve in zip(several, _upward_curves(maker, line), strict=True):
            rows_of = state.curves.rows[curve].tolist()
            made.append(each.generated(state.curves.key[curve], curve, rows_of))
    rows = np.array(sorted(row for each in made for row in each.rows), np.int64)
    maker.journal.put(state.rows.sort, rows, int(Sort.ADOPTED))
    maker.generated(made)


def _upward_curves(maker: Maker, line: int) -> list[int]:
    """Give the curves of a line from below, and let their order and their keys be this one."""
    state = maker.state
    curves: tuple[int, ...] = state.lines.curves[line]
    # Height of the first point: curves of one section do not overlap.
    foot = [float(state.rows.xyz[state.curves.rows[curve][0], 2]) for curve in curves]
    ordered = [curve for _, curve in sorted(zip(foot, curves, strict=True))]
    if tuple(ordered) != curves:
        keys = sorted(state.curves.key[curve] for curve in curves)
        maker.journal.set(state.curves.key, ordered, keys)
        maker.journal.set(state.lines.curves, [line], [tuple(ordered)])
    return ordered
