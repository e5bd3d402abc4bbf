"""From definitions to the points of lines: what the update engine asks for.

A generated curve has a layout (its pieces) and marks (places on the pieces, t from 0 to 4): as
many as bring the spline through them within 1 mm of the shape, and to its area. First and last
point of a section are no generated ones: they are where it meets profile and deck edge. A curve
has the same bits alone and in any batch.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, IntArray, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.model.form_definition import ON_FLATS, GeneratedCurve, Mark
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.line_layout import (
    COURSES,
    course_shape,
    deck_shape,
    ends_for,
    flat_points,
    joints_of,
)
from assoc_hull.model.forms.sections import LineShape, parts_at_draught, section_shape
from assoc_hull.model.tables import Ends

__all__ = [
    "AREA_WITHIN",
    "WITHIN",
    "MarkedSplines",
    "definitions_read",
    "first_marks",
    "generated_points",
    "marks_for",
    "marks_of",
    "marks_suffice",
    "point_kinds_at",
    "refine_marks",
    "within_tolerance",
]

# --------------------------------------------------------------------------------------
# Deviations of splines through marked points from the shapes.

_FRACTIONS = np.arange(1, 8) / 8.0
"""Where, in parts of an interval, its distance is measured."""

_STEPS = 4
"""Steps of Newton's rule to the nearest place on the shape."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
"""Exact for y dz of two cubics; on an arc beyond all need."""


def point_kinds_at(layout: str, marks: Sequence[Mark]) -> tuple[list[int], FloatArray]:
    """Give kinds, and directions (k, 3), of points at marks.

    A joint of the layout is marked by the piece that begins there, at t = 0.
    """
    joints = joints_of(layout)
    kinds, directions = [0] * len(marks), np.zeros((len(marks), 3))
    for number, (piece, t) in enumerate(marks):
        if piece and t == 0.0:
            kinds[number] = int(joints[piece - 1][0])
            directions[number] = joints[piece - 1][1]
    return kinds, directions


@attrs.frozen(eq=False)
class MarkedSplines:
    """Shapes of one layout, and the splines through their points at marks.

    Attributes
    ----------
    shape : LineShape
        Of n curves.
    spline : SplineBatch
        One of each.
    row, piece : (k,) int
        Of each interval of the splines.
    low, high : (k,)
        Between which t of the piece.
    """

    shape: LineShape
    spline: SplineBatch
    row: IntArray
    piece: IntArray
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(
        cls, shape: LineShape, layout: str, marks: Sequence[Sequence[Mark]], ends: FloatArray | None
    ) -> Self:
        """Loft n curves through all their marks, the first and the last among them.

        `ends`, (n, 2, 3) m, are where the ends lie; on the shape if None.
        """
        start = np.concatenate([[0], np.cumsum([len(each) for each in marks])]).astype(np.int64)
        row = np.repeat(np.arange(len(marks)), np.diff(start))
        flat = [mark for each in marks for mark in each]
        piece, t = np.array([mark[0] for mark in flat]), np.array([mark[1] for mark in flat])
        xyz = shape.at(row, piece, t)
        if ends is not None:
            xyz[start[:-1]], xyz[start[1:] - 1] = ends[:, 0], ends[:, 1]
        kinds, directions = point_kinds_at(layout, flat)
        finish = ends_for(layout)
        data = CurveData(
            start, xyz, np.array(kinds, np.int8), directions,
            np.tile(np.array(finish.kind, np.int8), (len(marks), 1)),
            np.tile(np.array(finish.vector), (len(marks), 1, 1)),
        )  # fmt: skip
        inner = row[1:] == row[:-1]
        # the last interval of a piece reaches to its end, t = 4: the next mark is on the next piece
        high = np.where(piece[1:] == piece[:-1], t[1:], 4.0)
        return cls(
            shape, loft(data), row[:-1][inner], piece[:-1][inner], t[:-1][inner], high[inner]
        )

    def deviations(self) -> FloatArray:
        """Give the largest measured distance of each interval from its piece, (k,) m."""
        count = len(self.piece)
        points = self._spline_at(_FRACTIONS)[0].reshape(-1, 3)
        size = len(_FRACTIONS)
        row, piece = np.repeat(self.row, size), np.repeat(self.piece, size)
        low, high = np.repeat(self.low, size), np.repeat(self.high, size)
        t = low + (high - low) * np.tile(_FRACTIONS, count)
        for _ in range(_STEPS):
            along = self.shape.tangent(row, piece, t)
            off = points - self.shape.at(row, piece, t)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = (off * along).sum(axis=1) / (along * along).sum(axis=1)
            t = np.clip(t + np.nan_to_num(step), low, high)
        off = points - self.shape.at(row, piece, t)
        found = np.sqrt((off * off).sum(axis=1)).reshape(count, -1)
        return np.asarray(found.max(axis=1))

    def areas(self, last: int) -> tuple[FloatArray, FloatArray]:
        """Give int y dz over each interval, (k,) m2: of the pieces, and of the spline.

        Zero from piece `last` on.
        """
        counts = self.piece < last
        share = 0.5 * (1.0 + _NODES)
        points, rates = self._spline_at(share)
        weights = 0.5 * _WEIGHTS
        spline = (points[..., 1] * rates[..., 2] * weights).sum(axis=1)
        width = self.high - self.low
        t = (self.low[:, None] + width[:, None] * share).ravel()
        row, piece = np.repeat(self.row, len(share)), np.repeat(self.piece, len(share))
        y = self.shape.at(row, piece, t)[:, 1].reshape(-1, len(share))
        dz = self.shape.tangent(row, piece, t)[:, 2].reshape(-1, len(share))
        exact = (y * dz * weights).sum(axis=1) * width
        return np.where(counts, exact, 0.0), np.where(counts, spline, 0.0)

    def _spline_at(self, share: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give points, and derivatives by the share, of each interval, (k, len(share), 3).

        `share` runs from 0 to 1 over an interval.
        """
        one = self.spline
        begin = np.delete(np.arange(len(one.knot)), one.start[1:] - 1)
        width = (one.knot[begin + 1] - one.knot[begin])[:, None]
        start, finish = one.xyz[begin], one.xyz[begin + 1]
        leave, arrive = width * one.leave[begin], width * one.arrive[begin + 1]
        c2 = 3.0 * (finish - start) - 2.0 * leave - arrive
        c3 = 2.0 * (start - finish) + leave + arrive
        a, b, c, d = (each[:, None] for each in (start, leave, c2, c3))
        u = share[None, :, None]
        return a + u * (b + u * (c + u * d)), b + u * (2.0 * c + 3.0 * u * d)


# --------------------------------------------------------------------------------------
# Marks: first the knots of the pieces and the middles of their segments; an interval that passes
# its piece too far off is halved, then those that miss the area most. So marks are at dyadic
# fractions, and the same shape always gets the same ones.

WITHIN = 9e-4
"""So far (m) the spline may pass the pieces where it is measured: between, it stays within 1 mm."""

AREA_WITHIN = 5e-7
"""By so much, of itself, the area below the draught may be missed; the bilge has the rest."""

_LEAST_AREA = 0.1
"""A smaller half section (m2) counts as this large: its area says nothing of the ship."""

_STRAIGHT = ("level", "siding", "upright", "ahead", "up", "down")
"""Pieces that need no points within."""

_SHORTEST = 1.0 / 64.0
"""The shortest interval, in t."""

_ROUNDS = 60


def first_marks(layout: str) -> list[Mark]:
    """Give knots and middles of segments of all curved pieces, and both ends, in order."""
    tokens = [each.partition(":")[0].rstrip("^") for each in layout.split("+")]
    found: list[Mark] = []
    for piece, token in enumerate(tokens):
        inner = 1 if token in _STRAIGHT else 8
        found += [(piece, 0.5 * step) for step in range(inner)]
    return [*found, (len(tokens) - 1, 4.0)]


@attrs.frozen(eq=False)
class _Chosen:
    """Some of the lines of a shape, as a shape of their own."""

    shape: LineShape
    numbers: IntArray

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        return self.shape.at(self.numbers[row], piece, t)

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        return self.shape.tangent(self.numbers[row], piece, t)


def refine_marks(
    shape: LineShape,
    layout: str,
    marks: Sequence[Sequence[Mark]],
    ends: FloatArray | None,
    under: int,
    where: Sequence[str],
) -> list[list[Mark]]:
    """Add marks to those of n curves, both ends among them, until the splines are near enough.

    `ends`, (n, 2, 3) m, are where the ends lie, on the shape if None; `under` is the number of
    pieces below the draught, whose area counts; `where` names the lines in messages.

    Raises
    ------
    BadInputError
        A shape is bent too sharply for a spline with points at a decent distance.
    """
    found = [list(each) for each in marks]
    left = np.arange(len(found))
    for _ in range(_ROUNDS):
        some = [found[number] for number in left.tolist()]
        held = None if ends is None else ends[left]
        whole = MarkedSplines.of(_Chosen(shape, left), layout, some, held)
        halved = _to_halve(whole, under, len(left))
        wanting = np.bincount(whole.row[halved], minlength=len(left)) > 0
        halved &= whole.high - whole.low > _SHORTEST
        stuck = wanting & (np.bincount(whole.row[halved], minlength=len(left)) == 0)
        if stuck.any():
            left = left[stuck]
            break
        middle = 0.5 * (whole.low + whole.high)
        for i in np.flatnonzero(halved).tolist():
            found[left[whole.row[i]]].append((int(whole.piece[i]), float(middle[i])))
        left = left[wanting]
        for number in left.tolist():
            found[number].sort()
        if not len(left):
            return found
    raise BadInputError(
        "the curve is bent too sharply to be held within 1 mm and its area", where[int(left[0])],
        "give smaller curvatures, or tangents nearer to a quarter of the chord",
    )  # fmt: skip


def within_tolerance(whole: MarkedSplines, under: int, count: int) -> NDArray[np.bool_]:
    """Tell which of `count` curves keep to their shapes, (count,).

    `under` is the number of pieces below the draught, whose area counts.
    """
    found = np.ones(count, np.bool_)
    found[whole.row[whole.deviations() > WITHIN]] = False
    if under:
        found &= _enough_area(whole, *whole.areas(under), count)
    return found


def _enough_area(
    whole: MarkedSplines, exact: FloatArray, spline: FloatArray, count: int
) -> NDArray[np.bool_]:
    """Tell which curves have the area of their pieces."""
    off, area = (np.bincount(whole.row, each, minlength=count) for each in (spline - exact, exact))
    return np.asarray(np.abs(off) <= AREA_WITHIN * np.maximum(area, _LEAST_AREA))


def _to_halve(whole: MarkedSplines, under: int, count: int) -> NDArray[np.bool_]:
    """Tell which intervals of `count` curves to halve; none of a curve that is near enough."""
    far = whole.deviations() > WITHIN
    if not under:
        return far
    near = np.bincount(whole.row[far], minlength=count) == 0
    exact, spline = whole.areas(under)
    near &= ~_enough_area(whole, exact, spline, count)
    # an interval of the shortest length cannot be halved, so it must not set the measure
    off = np.where(whole.high - whole.low > _SHORTEST, np.abs(spline - exact), 0.0)
    most = np.zeros(count)
    np.maximum.at(most, whole.row, off)
    return np.asarray(far | (near[whole.row] & (off > 0.5 * most[whole.row])))


# --------------------------------------------------------------------------------------
# Generated curves.

_BY_PIECE = {
    "level": ("flat_of_bottom",),
    "siding": ("half_siding",),
    "curve": (
        "sectional_area", "design_waterline", "centroid", "keel_angle", "keel_curvature",
        "keel_tangent", "waterline_angle", "waterline_curvature", "waterline_tangent",
    ),
    "arc": ("sectional_area", "design_waterline", "bilge_radius"),
    "upright": ("flat_of_side",),
    "bulb": ("bulb_area", "bulb_height", "bulb_neck", "bulb_neck_angle"),
    "upper": (
        "sectional_area", "design_waterline", "waterline_angle", "waterline_curvature",
        "waterline_tangent",
    ),
    "round": ("bulb_area",),
    "topside": ("deck_angle", "deck_curvature"),
    "wall": ("flat_of_side",),
}  # fmt: skip
"""The definitions that each piece of a section is made from."""

_SETTLED = {"level": "keel_angle", "upright": "waterline_angle"}
"""What a flat settles: a definition of that is not read."""

_BY_LINE = {
    "deck edge": ("deck_side", "deck_height"),
    "flat of bottom": ("flat_of_bottom", "profile"),
    "buttock bottom": ("flat_of_bottom", "profile"),
    "waterline side": ("flat_of_side",),
    "waterline parallel": ("sectional_area", "design_waterline", "bilge_radius", "profile"),
}
"""The definitions that other lines are made from."""


def definitions_read(curve: GeneratedCurve) -> tuple[str, ...]:
    """Give the uses of the definitions that a generated curve depends on, each once.

    For some of these uses there may be no definition.
    """
    if curve.what in ("section", "transom"):
        tokens = curve.layout.split("+")
        found = [use for token in tokens for use in _BY_PIECE.get(token, ())]
        if tokens[0] == "topside":
            found += ["keel_angle", "keel_curvature", "keel_tangent"]
        if curve.what == "transom":
            found += ["profile", "deck_side", "deck_height"]
        settled = {_SETTLED[token] for token in tokens if token in _SETTLED}
        return tuple(use for use in dict.fromkeys(found) if use not in settled)
    if curve.what in ON_FLATS:
        return _BY_LINE.get(f"{curve.what} {curve.layout}", ())
    return _BY_LINE.get(curve.what) or ((COURSES[curve.what],) if curve.what in COURSES else ())


def marks_for(
    forms: Forms,
    what: str,
    layout: str,
    place: float,
    ends: FloatArray | None = None,
    known: Sequence[Mark] = (),
) -> tuple[tuple[Mark, ...], tuple[int, ...], FloatArray, Ends]:
    """Give as many marks as hold a generated curve.

    Parameters
    ----------
    forms : Forms
        The definitions.
    what, layout : str
        What is generated, of which pieces.
    place : float, m
        x of a section, z of a waterline, y of a buttock.
    ends : (2, 3), m
        Of a section: where it meets profile and deck edge.
    known : sequence of Mark
        Marks that it has already; all of them stay. The same ones come back where they suffice.

    Returns
    -------
    marks : tuple of Mark
        Of the generated points, in order: of a section all but both ends.
    kinds : tuple of int
        A `PointKind` per mark.
    directions : (k, 3)
        Of its tangent points.
    ends : Ends
        The end conditions.

    Raises
    ------
    BadInputError
        A curve that cannot be made, or not be held within 1 mm and 1e-6 of its area.
    """
    if what in ON_FLATS:
        marks: tuple[Mark, ...] = ((0, 0.0), (1, 0.0)) if layout else ()
        tangent = (int(PointKind.TANGENT),) * len(marks)
        return marks, tangent, np.tile((1.0, 0.0, 0.0), (len(marks), 1)), Ends()
    held = None if ends is None or what != "section" else np.asarray(ends, np.float64)[None]
    (found,) = marks_of(forms, what, layout, np.array([place]), held, [known])
    kinds, directions = point_kinds_at(layout, found)
    return found, tuple(kinds), directions, ends_for(layout)


def marks_of(
    forms: Forms,
    what: str,
    layout: str,
    places: FloatArray,
    ends: FloatArray | None,
    known: Sequence[Sequence[Mark]],
) -> list[tuple[Mark, ...]]:
    """Give the marks of n lines of one layout, as `marks_for` gives those of one."""
    shape = _shape(forms, what, layout, places, ends)
    under = _under(what, layout)
    begin = first_marks(layout)
    start = [sorted({begin[0], begin[-1], *each}) if each else begin for each in known]
    where = [f"on the {what}" + (f" x = {place:g} m" if under else "") for place in places.tolist()]
    found = refine_marks(shape, layout, start, ends, under, where)
    return [tuple(each[1:-1] if what == "section" else each) for each in found]


def generated_points(
    forms: Forms, curves: Sequence[GeneratedCurve], places: FloatArray, ends: FloatArray
) -> list[FloatArray]:
    """Give the points, (k, 3) m each, of m generated curves in the order of their marks.

    `places` (m,) are x of a section, z of a waterline, y of a buttock; `ends`, (m, 2, 3) m, are
    where sections meet profile and deck edge. Both are without meaning for other lines.

    Raises
    ------
    OutOfRangeError, BadInputError
        A curve that cannot be made, with its place and what would do.
    """
    found: list[FloatArray] = [np.zeros((0, 3))] * len(curves)
    for (what, layout), numbers in _groups(curves):
        if what in ON_FLATS:
            for number in numbers.tolist():
                found[number] = _on_flat(forms, curves[number], float(places[number]))
            continue
        shape = _shape(forms, what, layout, places[numbers], ends[numbers])
        marks = [curves[number].marks for number in numbers.tolist()]
        row = np.repeat(np.arange(len(numbers)), [len(each) for each in marks])
        flat = [mark for each in marks for mark in each]
        piece = np.array([mark[0] for mark in flat], np.int64)
        points = shape.at(row, piece, np.array([mark[1] for mark in flat], np.float64))
        for place, number in enumerate(numbers.tolist()):
            found[number] = points[row == place]
    return found


def marks_suffice(
    forms: Forms, curves: Sequence[GeneratedCurve], places: FloatArray, ends: FloatArray
) -> NDArray[np.bool_]:
    """Tell for which of m generated curves `marks_for` would give no other marks, (m,).

    Arguments and errors are those of `generated_points`.
    """
    found = np.ones(len(curves), np.bool_)
    for (what, layout), numbers in _groups(curves):
        if what in ON_FLATS:
            continue
        shape = _shape(forms, what, layout, places[numbers], ends[numbers])
        own = ends[numbers] if what == "section" else None
        first, *_, last = first_marks(layout)
        marks = [sorted({first, last, *curves[number].marks}) for number in numbers.tolist()]
        whole = MarkedSplines.of(shape, layout, marks, own)
        found[numbers] = within_tolerance(whole, _under(what, layout), len(numbers))
    return found


def _groups(
    curves: Sequence[GeneratedCurve],
) -> Iterator[tuple[tuple[str, str], IntArray]]:
    """Give the numbers of the curves that are made alike, by what they are and their layout."""
    found: dict[tuple[str, str], list[int]] = {}
    for number, curve in enumerate(curves):
        _on_pieces(curve)
        found.setdefault((curve.what, curve.layout), []).append(number)
    for kind, numbers in found.items():
        yield kind, np.array(numbers, np.int64)


def _on_pieces(curve: GeneratedCurve) -> None:
    """Refuse marks that lie on no piece."""
    count = 2 if curve.what in ON_FLATS else curve.layout.count("+") + 1
    for piece, t in curve.marks:
        if not (0 <= piece < count and 0.0 <= t <= 4.0):
            raise BadInputError(
                f"the mark ({piece}, {t:g}) lies on no piece of {curve.layout!r}",
                f"in the generated curve {curve.key!r}", "correct it",
            )  # fmt: skip


def _under(what: str, layout: str) -> int:
    """Give the number of pieces below the draught, whose area counts."""
    return len(parts_at_draught(layout)[0]) if what in ("section", "transom") else 0


def _shape(
    forms: Forms, what: str, layout: str, places: FloatArray, ends: FloatArray | None
) -> LineShape:
    """Give the shape of lines of one layout."""
    if what == "section" and ends is not None:
        return section_shape(forms, layout, places, ends)
    if what in ("section", "transom"):
        return section_shape(forms, layout, places, _own_ends(forms, places))
    if what == "deck edge":
        return deck_shape(forms)
    if what in COURSES:
        return course_shape(forms, COURSES[what])
    raise BadInputError(f"{what!r} cannot be generated", "in a net", "generate a section")


def _own_ends(forms: Forms, places: FloatArray) -> FloatArray:
    """Give where sections meet profile and deck edge by the definitions, (n, 2, 3)."""
    found = np.zeros((len(places), 2, 3))
    found[:, :, 0] = places[:, None]
    heights = [forms.contour(float(x)) for x in places]
    found[:, 0, 2] = [each[0] if each else np.nan for each in heights]
    found[:, 1, 1] = forms.value("deck_side", places)
    found[:, 1, 2] = forms.value("deck_height", places)
    lost = np.isnan(found).reshape(len(found), -1).any(axis=1)
    for number in np.flatnonzero(lost)[:1].tolist():
        raise BadInputError(
            "profile or deck edge do not reach so far",
            f"at x = {places[number]:g} m",
            "extend them",
        )
    return found


def _on_flat(forms: Forms, curve: GeneratedCurve, place: float) -> FloatArray:
    """Give where a waterline or a buttock comes onto a flat and leaves it."""
    if not curve.layout:
        return np.zeros((0, 3))
    points = flat_points(forms, curve.what, curve.layout, place)
    if not np.isfinite(points).all():
        raise BadInputError(
            f"the {curve.what} does not run along the flat ({curve.layout}) any more",
            f"at {'yz'[curve.what == 'waterline']} = {place:g} m", "let the flat reach it",
        )  # fmt: skip
    return points[[mark[0] for mark in curve.marks]]
