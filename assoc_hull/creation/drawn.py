"""Curves as the definitions draw them: boundary curves, then the sections that end on them."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.creation.design import Design
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import meet_planes
from assoc_hull.model.definition_part import GeneratedCurve, Mark
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.generate import generated_points, marks_for
from assoc_hull.model.forms.layout import layout_at
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource, curve_data

__all__ = ["Drawn", "boundary_curves", "section_curves"]

_ACROSS, _AHEAD = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
_NOWHERE = np.full((2, 3), np.nan)
"""The ends of a curve that ends by itself."""

_LEVEL = 1e-9
"""A deck edge whose points lie within this (m) of one height lies in a plane."""

_TOLERANCE = 1e-6
"""How far (m) a curve may pass a point through which it is made: by rounding."""


@attrs.frozen(eq=False)
class Drawn:
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


def boundary_curves(design: Design, forms: Forms) -> list[Drawn]:
    """Draw profile, deck edge and transom.

    Parameters
    ----------
    design : Design
        The design.
    forms : Forms
        Its definitions.

    Returns
    -------
    list of Drawn
        The transom only where there is one.
    """
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
) -> Drawn:
    layout = layout_at(forms, what, place)
    marks, kind, direction, ends = marks_for(forms, what, layout, place, _NOWHERE)
    points = _points(forms, what, layout, marks, place, _NOWHERE)
    if plane is None and float(np.ptp(points[:, 2])) <= _LEVEL:
        plane = ((0.0, 0.0, 1.0), float(points[0, 2]))
    source = LineSource.make(
        "boundary", what, points, plane=plane, boundary=BoundaryKind.END, kind=kind,
        direction=direction, ends=ends, placed=True, tolerance=_TOLERANCE,
    )  # fmt: skip
    return Drawn(source, what, layout, tuple(marks), 0)


def _points(
    forms: Forms, what: str, layout: str, marks: Sequence[Mark], place: float, ends: FloatArray
) -> FloatArray:
    made = GeneratedCurve("", 0, what, layout, tuple(range(len(marks))), tuple(marks))
    found: FloatArray = generated_points(forms, [made], np.array([place]), ends[None])[0]
    return found + 0.0


def section_curves(design: Design, forms: Forms, boundary: Sequence[Drawn]) -> list[Drawn]:
    """Draw the sections of a design.

    Parameters
    ----------
    design : Design
        The design.
    forms : Forms
        Its definitions.
    boundary : sequence of Drawn
        Profile and deck edge, on which sections end.

    Returns
    -------
    list of Drawn

    Raises
    ------
    BadInputError
        A station that profile and deck edge do not reach, or that begins and does not end.
    OutOfRangeError
        A section of which the definitions ask what no curve can be.
    """
    edges = loft(curve_data([each.source for each in boundary if each.what != "transom"]))
    found = list[Drawn]()
    for station, x in zip(design.stations, design.station_places, strict=True):
        for part, ends in enumerate(_pairs(edges, station, x)):
            found.append(_section(forms, f"ST {station:g}", x, part, ends))
    return found


def _pairs(edges: SplineBatch, station: float, x: float) -> list[FloatArray]:
    """Give the ends of the curves of a section, (2, 3) each, from below."""
    met = meet_planes(edges, np.array(_AHEAD), np.array([x])).xyz
    where = f"at station {station:g} (x = {x:g} m)"
    if not len(met):
        raise BadInputError("there is no hull", where, "leave it out, or extend the profile")
    if len(met) % 2:
        what = f"profile and deck edge pass it {len(met)} times: a section would not end"
        raise BadInputError(what, where, "shift it a little, or extend the deck edge")
    met = met[np.argsort(met[:, 2], kind="stable")] + 0.0
    met[:, 0] = x
    return [met[i : i + 2] for i in range(0, len(met), 2)]


def _section(forms: Forms, name: str, x: float, part: int, ends: FloatArray) -> Drawn:
    layout = layout_at(forms, "section", x, part)
    marks, kind, direction, conditions = marks_for(forms, "section", layout, x, ends)
    points = _points(forms, "section", layout, marks, x, ends)
    smooth = [int(PointKind.SMOOTH)]
    given = np.zeros((len(points) + 2, 3))
    given[1:-1] = direction
    source = LineSource.make(
        "sections", name, np.concatenate([ends[:1], points, ends[1:]]),
        plane=(_AHEAD, x), kind=[*smooth, *kind, *smooth], direction=given, ends=conditions,
        placed=True, tolerance=_TOLERANCE,
    )  # fmt: skip
    return Drawn(source, "section", layout, tuple(marks), 1)
