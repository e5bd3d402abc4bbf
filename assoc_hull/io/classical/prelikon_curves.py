r"""Sections and boundary curves in texts of main types: rows of points, lines and arcs between.

Examples
--------
>>> from assoc_hull.io.classical.cards import read_cards
>>> from assoc_hull.io.classical.prelikon_curves import read_boundary
>>> from assoc_hull.io.classical.prelikon_units import Units
>>> cards = read_cards("PRELIKON A\nboundary stem fillet\n0 0\n10 0 2.5\n12 6\n", "a.txt")
>>> len(read_boundary(cards.one("boundary"), Units(shift=60.0)).curve.arcs)
3
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.creation.classical.prelikon_stations import Station
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.classical.arc_boundary import ArcBoundary
from assoc_hull.geometry.classical.arc_curve import ArcCurve
from assoc_hull.geometry.classical.arc_section import round_corners, through_points
from assoc_hull.io.classical.cards import Card, Row
from assoc_hull.io.classical.prelikon_units import Units, placed
from assoc_hull.io.lines.digitised_piece import read_number

__all__ = ["read_boundary", "read_section"]

_MODES = ("through", "fillet")


@attrs.frozen
class _Point:
    """A row: a point, and what runs from it to the next."""

    u: float
    v: float
    kind: str
    radius: float | None
    knuckle: bool


def read_section(card: Card, units: Units) -> Station:
    """Read a section: x behind the word, rows of y and z below.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        Points of which no section can be made; with the line of the text.
    """
    if not card.cells:
        raise BadInputError("a section has no place", card.where, "give x after the word")
    x = units.scale * read_number(card.cells[0], card.where) + units.shift
    return Station(x, _curve(card, 1, units, "yz", "section"))


def read_boundary(card: Card, units: Units) -> ArcBoundary:
    """Read a boundary curve: its name behind the word, rows of x and z below.

    Raises
    ------
    BadInputError
        Cells that are not of this form.
    GeometryError
        Points of which no curve can be made; with the line of the text.
    """
    if not card.cells:
        raise BadInputError("a boundary has no name", card.where, "give it after the word")
    first, y = 1, 0.0
    if len(card.cells) > 1 and card.cells[1].startswith("y="):
        y = units.scale * read_number(card.cells[1][2:], card.where)
        first = 2
    name = card.cells[0].lower()
    return ArcBoundary(name, _curve(card, first, units, "xz", f"boundary {name}"), y)


def _curve(card: Card, first: int, units: Units, axes: str, name: str) -> ArcCurve:
    mode = " ".join(card.cells[first:]) or "through"
    if mode not in _MODES:
        what = f"{card.word} has {shown(mode)}"
        raise BadInputError(what, card.where, f"use {' or '.join(_MODES)}, or nothing")
    points = [_point(row, card) for row in card.rows]
    places = units.places(np.array([[p.u, p.v] for p in points]).reshape(-1, 2), axes)
    radius = [None if p.radius is None else units.scale * p.radius for p in points]
    if mode == "fillet":
        for point, row in zip(points, card.rows, strict=True):
            if point.kind == "line" or point.knuckle:
                where = f"at line {row.line} of {card.source}"
                what = f"a corner of {card.word} has a word"
                raise BadInputError(what, where, "give its radius alone, or nothing")
        return placed(card, lambda: round_corners(places, radius=radius[1:-1], name=name))
    return placed(
        card,
        lambda: through_points(
            places, kind=[p.kind for p in points[:-1]], radius=radius[:-1],
            knuckles=[k for k, p in enumerate(points) if p.knuckle], name=name,
        ),
    )  # fmt: skip


def _point(row: Row, card: Card) -> _Point:
    """Read a row: two numbers, then ``line``, ``arc``, a radius, ``knuckle``, in any order."""
    where = f"at line {row.line} of {card.source}"
    if len(row.cells) < 2:
        what = f"a row of {card.word} has {len(row.cells)} cell(s)"
        raise BadInputError(what, where, "give two numbers, and what runs on from there")
    u, v = (read_number(cell, where) for cell in row.cells[:2])
    rest = [cell.lower() for cell in row.cells[2:]]
    words = [cell for cell in rest if cell in ("line", "arc", "knuckle")]
    others = [cell for cell in rest if cell not in words]
    if len(set(words)) < len(words) or {"line", "arc"} <= set(words) or len(others) > 1:
        what = f"a row of {card.word} has {shown(' '.join(rest))}"
        raise BadInputError(what, where, "give line or arc, a radius, knuckle: each once at most")
    radius = read_number(others[0], where) if others else None
    if radius is not None and "line" in words:
        what = f"a line of {card.word} has the radius {radius:g}"
        raise BadInputError(what, where, "leave it out, or make it an arc")
    return _Point(u, v, "line" if "line" in words else "arc", radius, "knuckle" in words)
