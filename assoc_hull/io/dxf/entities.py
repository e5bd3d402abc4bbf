"""The entities of an ASCII DXF drawing, and its B-splines as points.

`drawing_entities` gives group codes with their values, one entity after another. `RawSpline` is a
B-spline as the file has it, `RawCurve` a line or a piece of one; both in the unit of the file.
"""

from __future__ import annotations

import re

import attrs
import numpy as np

from assoc_hull.arguments import shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.patches.knots import (
    bezier_pieces,
    checked_knots,
    nonempty_spans,
    span_limits,
)
from assoc_hull.io.lines.raw_lines import RawPiece, read_number

__all__ = [
    "DrawingEntity",
    "RawCurve",
    "RawSpline",
    "drawing_entities",
    "drawing_unit",
    "drawn_spline",
]

# --------------------------------------------------------------------------------------
# Entities.

_OWNER = 1001
"""The group code of an application's name, with which its extended data begin."""

_UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}


@attrs.define(eq=False)
class DrawingEntity:
    """An entity of a drawing.

    Attributes
    ----------
    kind : str
        Such as "LINE".
    where : str
        Where it begins.
    codes : list of (int, str, str)
        Group codes with their values, and where each stands.
    """

    kind: str
    where: str
    codes: list[tuple[int, str, str]] = attrs.field(factory=list)

    def word(self, code: int) -> str:
        """Give the first value of a code, empty if there is none."""
        return next((value for each, value, _ in self.codes if each == code), "")

    def numbers(self, code: int) -> list[float]:
        """Give the values of a code as numbers."""
        return [read_number(value, where) for each, value, where in self.codes if each == code]

    def number(self, code: int) -> float:
        """Give the first value of a code, 0 if there is none."""
        return next(iter(self.numbers(code)), 0.0)

    def place(self, first: int = 10, height: float = 0.0) -> list[float]:
        """Give the point (x, y, z) whose first coordinate has a code; `height` where z lacks."""
        x, y, *z = (self.numbers(first + step)[:1] for step in (0, 10, 20))
        return [*(x or [0.0]), *(y or [0.0]), *(z[0] or [height])]

    def extended(self, owner: str) -> DrawingEntity | None:
        """Give the extended data of an application as codes of their own, None without any."""
        found: DrawingEntity | None = None
        for code, value, where in self.codes:
            if code == _OWNER:
                if found is not None:
                    break
                found = DrawingEntity(self.kind, where) if value == owner else None
            elif found is not None:
                found.codes.append((code, value, where))
        return found


def drawing_entities(text: str, source: str) -> list[DrawingEntity]:
    """Split a drawing into entities; heads of sections are entities, too.

    Raises
    ------
    BadInputError
        A group code that is none.
    """
    rows = text.splitlines()
    found: list[DrawingEntity] = []
    for i in range(0, len(rows) - 1, 2):
        where = f"line {i + 1} of {source}"
        if not re.fullmatch(r"\s*-?[0-9]{1,9}\s*", rows[i]):
            raise BadInputError(f"{shown(rows[i])} is no group code", where, "save it as ASCII DXF")
        code, value = int(rows[i]), rows[i + 1].strip()
        if code == 0:
            found.append(DrawingEntity(value, where))
        elif found:
            found[-1].codes.append((code, value, where))
    return found


def drawing_unit(entities: list[DrawingEntity]) -> str | None:
    r"""Give the unit that the header tells: "m", "mm", "cm", "ft" or "in"; None if it tells none.

    Examples
    --------
    >>> from assoc_hull.io.dxf.entities import drawing_entities, drawing_unit
    >>> rows = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC".split()
    >>> drawing_unit(drawing_entities("\n".join(rows), "text"))
    'mm'
    """
    for entity in entities:
        for (_, name, _), (code, value, _) in zip(entity.codes, entity.codes[1:], strict=False):
            if name == "$INSUNITS" and code == 70 and value.isascii() and value.isdigit():
                return _UNITS.get(int(value)) if len(value) < 4 else None
    return None


# --------------------------------------------------------------------------------------
# B-splines and polylines.

_MOST_PARTS = 1000
"""A span is cut into no more parts than this."""

_STEEPEST = 15
"""No program draws splines of a higher degree."""

_STRAIGHT = float(np.cos(np.deg2rad(0.5)))
"""Directions that differ by more make a knuckle where the spline allows one."""


def drawn_spline(entity: DrawingEntity) -> RawSpline:
    """Give the B-spline of an entity that has control points.

    Raises
    ------
    BadInputError
        Its numbers make none.
    """
    columns = [entity.numbers(code) for code in (10, 20, 30)]
    weights = entity.numbers(41)
    columns += [weights] if weights else []
    if any(len(column) != len(columns[0]) for column in columns):
        sizes = ", ".join(str(len(column)) for column in columns)
        raise BadInputError(
            f"a spline has {sizes} coordinates of control points", entity.where,
            "save the drawing again as ASCII DXF",
        )  # fmt: skip
    control, degree = np.array(columns).T, int(entity.number(71))
    return RawSpline(degree, np.array(entity.numbers(40)), control, entity.where)


@attrs.frozen(eq=False)
class RawSpline:
    """A B-spline as the file gives it.

    Attributes
    ----------
    degree : int
        At least 1.
    knots : (n + degree + 1,)
        Not falling.
    control : (n, 3) or (n, 4)
        Control points, in the unit of the file; with weights behind, where it has them.
    where : str
        For messages.

    Raises
    ------
    BadInputError
        Its numbers make no spline.
    """

    degree: int
    knots: FloatArray
    control: FloatArray
    where: str

    def __attrs_post_init__(self) -> None:
        if not 1 <= self.degree <= _STEEPEST:
            what = f"a spline of degree {self.degree}"
            raise BadInputError(what, self.where, f"give one of degree 1 to {_STEEPEST}")
        if len(self.control) <= self.degree:
            what = f"a spline of degree {self.degree} has {len(self.control)} control points"
            raise BadInputError(what, self.where, f"give {self.degree + 1} or more")
        if self.control.shape[1] == 4 and not (self.control[:, 3] > 0.0).all():
            raise BadInputError("a weight is not positive", self.where, "export it again")
        knots = checked_knots(self.knots, self.degree, len(self.control), "the spline", self.where)
        if not len(nonempty_spans(knots, self.degree)):
            raise BadInputError("a spline has no length", self.where, "leave it out")
        object.__setattr__(self, "knots", knots)

    @property
    def polygons(self) -> FloatArray:
        """Its Bezier polygons, (k, degree + 1, 3 or 4): weighted points and weights."""
        weighted = self.control.copy()
        weighted[:, :3] *= self.control[:, 3:] if weighted.shape[1] == 4 else 1.0
        return bezier_pieces(weighted, self.knots, self.degree)

    def points(self, chord: float) -> FloatArray:
        """Give points (m, 3) along it: all knots, and between them as many as are needed.

        Straight lines between them leave it by no more than `chord`, in the unit of the file.
        """
        polygons = self.polygons
        count = _parts(_plain(polygons), chord)
        first = np.cumsum(count) - count
        span = np.repeat(np.arange(len(count)), count)
        share = (np.arange(len(span)) - first[span]) / count[span]
        span, share = np.append(span, len(count) - 1), np.append(share, 1.0)
        places = polygons[span]
        for _ in range(self.degree):
            part = share[:, None, None]
            places = (1.0 - part) * places[:, :-1] + part * places[:, 1:]
        return _plain(places[:, 0])

    def knuckles(self) -> FloatArray:
        """Give the points where its direction jumps, (k, 3)."""
        polygons = _plain(self.polygons)
        before, behind = polygons[:-1, -1] - polygons[:-1, -2], polygons[1:, 1] - polygons[1:, 0]
        known, inner = span_limits(self.knots, self.degree), np.arange(len(polygons) - 1)
        many = (self.knots[:, None] == known[1:, 0]).sum(axis=0)
        sizes = np.linalg.norm(before, axis=1) * np.linalg.norm(behind, axis=1)
        cosine = np.divide(
            (before * behind).sum(axis=1), sizes, out=np.ones_like(sizes), where=sizes > 0.0
        )
        turns = (many >= self.degree) & (cosine < _STRAIGHT)
        return np.asarray(polygons[1:, 0][inner[turns]])


@attrs.frozen(eq=False)
class RawCurve:
    """A line of a drawing, or a piece of one.

    Attributes
    ----------
    line : str
        Name of the line.
    where : str
        For messages.
    shape : (n, 3) or RawSpline
        Its polyline or its spline, in the unit of the file.
    """

    line: str
    where: str
    shape: FloatArray | RawSpline

    @property
    def corners(self) -> FloatArray:
        """Its points, or its control points, (n, 3)."""
        return self.shape.control[:, :3] if isinstance(self.shape, RawSpline) else self.shape

    def moved(self, corners: FloatArray) -> RawCurve:
        """Give the same curve by other points, or control points, (n, 3)."""
        if not isinstance(self.shape, RawSpline):
            return attrs.evolve(self, shape=corners)
        control = np.concatenate([corners, self.shape.control[:, 3:]], axis=1)
        return attrs.evolve(self, shape=attrs.evolve(self.shape, control=control))

    def piece(self, chord: float) -> RawPiece:
        """Give it as points; straight lines between those of a spline leave it by `chord`."""
        if isinstance(self.shape, RawSpline):
            points, knuckles = self.shape.points(chord), self.shape.knuckles()
            return RawPiece(self.line, points, self.where, knuckles)
        return RawPiece(self.line, self.shape, self.where)


def _plain(points: FloatArray) -> FloatArray:
    """Give points without their weights."""
    return np.asarray(points[..., :3] / points[..., 3:]) if points.shape[-1] == 4 else points


def _parts(polygons: FloatArray, chord: float) -> IntArray:
    """Give into how many parts each span is cut: by the largest second difference of its polygon.

    The chord of a Bezier curve of degree d leaves it by no more than d (d - 1) / 8 of that over the
    square of the number of parts. With weights this is no bound, but near one.
    """
    degree = polygons.shape[1] - 1
    bend = np.linalg.norm(np.diff(polygons, 2, axis=1), axis=2).max(axis=1, initial=0.0)
    parts = np.ceil(np.sqrt(degree * (degree - 1) * bend / (8.0 * chord)))
    found: IntArray = np.clip(parts, 1, _MOST_PARTS).astype(np.int64)
    return found
