"""Sections of one layout as shapes, and the pieces they consist of.

Sections that are laid out alike are made in one batch, from the contour upward, in the plane
(z, y): the half-breadth y as a graph over the height z, m, so angles are from upright. The area of
half a section is int y dz; sectional areas in definitions are of both halves. Below the draught a
section has the area of the curve of areas; above it, it runs to the deck edge. What cannot stand
at a place is refused by the place and the definition at fault.

Pieces of sections in their plane, z over y, and shapes that lines are generated from.

A shape is a batch of curves of like pieces, each piece run through from t = 0 to t = 4.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.model.forms.sections import SectionArcs, SectionShape
>>> bilge = SectionArcs(np.array([[0.0, 12.0]]), np.array([2.0]))
>>> shape = SectionShape(np.array([90.0]), (bilge,))
>>> shape.at(np.zeros(2, int), np.zeros(2, int), np.array([0.0, 4.0])).round(9).tolist()
[[90.0, 12.0, 0.0], [90.0, 14.0, 2.0]]
"""

from __future__ import annotations

import math
from typing import Protocol, Self, TypeVar

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.form_curves.chain import straight_vertices
from assoc_hull.geometry.form_curves.curve import (
    FormEnd,
    end_vertices,
    form_at,
    form_vertices,
)
from assoc_hull.geometry.form_curves.integrals import middle_vertex
from assoc_hull.geometry.form_curves.shape import least_coordinate
from assoc_hull.model.forms.form_values import Forms

__all__ = [
    "RADIUS_SLACK",
    "LineShape",
    "SectionArcs",
    "SectionCurves",
    "SectionEnds",
    "SectionPieces",
    "SectionShape",
    "bilge_area",
    "bilge_radius_for",
    "breadth_at",
    "bulb_layout",
    "bulb_pieces",
    "bulb_vertices",
    "chord_of",
    "end_points_2d",
    "in_middle_body",
    "join_vertices",
    "parts_at_draught",
    "section_shape",
    "span_of",
    "straight_pieces",
    "topside_pieces",
    "underwater_pieces",
]


class LineShape(Protocol):
    """Curves of like pieces in space."""

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 3), m."""
        ...

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 3), m."""
        ...


class SectionPieces(Protocol):
    """One piece of each section of a batch, in the plane (z, y)."""

    def at(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 2), m."""
        ...

    def tangent(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 2), m."""
        ...


@attrs.frozen(eq=False)
class SectionCurves:
    """Form-parameter curves.

    Attributes
    ----------
    vertices : (n, 7, 2), m
        One curve a row.
    start, finish : (n, 2), m
        Their ends, without the rounding of the vertices.
    """

    vertices: FloatArray
    start: FloatArray
    finish: FloatArray

    def at(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 2), m."""
        found = form_at(self.vertices[row], t)
        found = np.where((t == 0.0)[:, None], self.start[row], found)
        return np.where((t == 4.0)[:, None], self.finish[row], found)

    def tangent(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 2), m."""
        return form_at(self.vertices[row], t, 1)


@attrs.frozen(eq=False)
class SectionArcs:
    """Quarters of circles, from level to upright: a bilge.

    Attributes
    ----------
    start : (n, 2), m
        Where each begins: z, y.
    radius : (n,), m
        Of each.
    """

    start: FloatArray
    radius: FloatArray

    def at(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 2), m."""
        cos, sin = _unit(t)
        z, y = self.start[row].T
        radius = self.radius[row]
        return np.stack([z + radius * (1.0 - cos), y + radius * sin], axis=1)

    def tangent(self, row: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 2), m."""
        cos, sin = _unit(t)
        pace = self.radius[row] * (math.pi / 8.0)
        return np.stack([pace * sin, pace * cos], axis=1)


def _unit(t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give cosine and sine of the angle run through, exact where the arc ends."""
    angle = [each * (math.pi / 8.0) for each in t.tolist()]
    cos, sin = (np.array([f(each) for each in angle]) for f in (math.cos, math.sin))
    return np.where(t == 4.0, 0.0, cos), sin


@attrs.frozen(eq=False)
class SectionShape:
    """Sections of like pieces.

    Attributes
    ----------
    x : (n,), m
        Where they stand.
    pieces : tuple of SectionPieces
        From the contour upward.
    """

    x: FloatArray
    pieces: tuple[SectionPieces, ...]

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 3), m; no half-breadth is negative."""
        found = self._in_space(self.x[row], row, piece, t, 0)
        found[:, 1] = np.maximum(found[:, 1], 0.0) + 0.0
        return found

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 3), m."""
        return self._in_space(np.zeros(len(row)), row, piece, t, 1)

    def _in_space(
        self, x: FloatArray, row: IntArray, piece: IntArray, t: FloatArray, order: int
    ) -> FloatArray:
        found = np.empty((len(row), 3))
        found[:, 0] = x
        for number, each in enumerate(self.pieces):
            mine = np.flatnonzero(piece == number)
            if len(mine):
                give = each.tangent if order else each.at
                found[mine, 2], found[mine, 1] = give(row[mine], t[mine]).T
        return found


def end_points_2d(start: FormEnd, finish: FormEnd) -> tuple[FloatArray, FloatArray]:
    """Give the points, (n, 2), of the two ends of curves."""
    return np.stack([start.x, start.y], axis=1), np.stack([finish.x, finish.y], axis=1)


# --------------------------------------------------------------------------------------
# The parallel middle body: flat bottom, a bilge that is a quarter of a circle, upright sides.

Number = TypeVar("Number", float, FloatArray)

_CORNER = 1.0 - 0.25 * math.pi
"""What an arc of radius 1 leaves of the square around it."""


def span_of(forms: Forms) -> tuple[float, float]:
    """Give where (x, m) the parallel part of the curve of areas begins and ends."""
    areas = forms.needed("sectional_area", "for a section")
    half = 0.5 * forms.particulars.length
    low, high = (
        0.0 if each is None else (each + 1.0) * half
        for each in (areas.value("run_end"), areas.value("entrance_start"))
    )
    return low, high


def in_middle_body(forms: Forms, x: float) -> bool:
    """Tell whether a place (x, m) lies in the parallel middle body."""
    low, high = span_of(forms)
    return low - 1e-9 <= x <= high + 1e-9


def bilge_area(half_breadth: Number, height: Number, radius: Number) -> Number:
    """Give the area (m2) of half a midship section up to a height above its bottom."""
    return half_breadth * height - _CORNER * (radius * radius)


def bilge_radius_for(half_breadth: float, height: float, area: float) -> float:
    """Give the radius (m) with which half a midship section has an area; nan if none has."""
    square = (half_breadth * height - area) / _CORNER
    return math.sqrt(square) if square >= 0.0 else math.nan


def breadth_at(forms: Forms, z: float) -> float:
    """Give the half-breadth (m) of the parallel middle body at a height; nan below its bottom."""
    x = np.array([0.5 * sum(span_of(forms))])
    heights = forms.contour(float(x[0]))
    radius, full = (float(forms.value(use, x)[0]) for use in ("bilge_radius", "design_waterline"))
    up = z - heights[0] if heights else math.nan
    if not up >= 0.0:
        return math.nan
    if up >= radius:
        return full
    return full - radius + math.sqrt(radius * radius - (radius - up) ** 2)


# --------------------------------------------------------------------------------------
# Where sections stand, and the errors of what cannot stand there.


@attrs.frozen(eq=False)
class SectionEnds:
    """Sections of one layout by their places and ends; reads definitions there.

    Attributes
    ----------
    forms : Forms
        The definitions.
    x : (n,), m
        Where they stand.
    start, finish : (n, 2), m
        Contour and deck edge there: z, y.
    """

    forms: Forms
    x: FloatArray
    start: FloatArray
    finish: FloatArray

    @classmethod
    def of(cls, forms: Forms, x: FloatArray, ends: FloatArray) -> Self:
        """Take sections by their places, and (n, 2, 3) their ends in space."""
        plane = np.stack([ends[..., 2], ends[..., 1]], axis=-1)
        return cls(forms, x, plane[:, 0], plane[:, 1])

    @property
    def draught(self) -> FloatArray:
        """The draught at each, (n,), m."""
        return np.full(len(self.x), self.forms.particulars.draught)

    def value(self, use: str, default: float = np.nan) -> FloatArray:
        """Read a definition at each."""
        return self.forms.value(use, self.x, default)

    def needed(self, use: str) -> FloatArray:
        """Read a definition that must reach each."""
        self.forms.needed(use, self.where(0))
        found = self.value(use)
        self.refuse(np.isnan(found), f"the definition for {use} does not reach so far", "extend it")
        return found

    def radians(self, use: str, default: float | None = None) -> FloatArray:
        """Read angles, degrees, in radians; they must reach each unless there is a default."""
        degrees = self.needed(use) if default is None else self.value(use, default)
        return degrees * (math.pi / 180.0)

    def where(self, number: int) -> str:
        """Name one of them."""
        return f"at the section x = {float(self.x[number]):g} m"

    def refuse(self, bad: NDArray[np.bool_], what: str, remedy: str) -> None:
        """Raise an error that names the first bad one."""
        for number in np.flatnonzero(bad)[:1].tolist():
            raise BadInputError(what, self.where(number), remedy)

    def within(
        self, name: str, unit: str, why: str, value: FloatArray, least: FloatArray, most: FloatArray
    ) -> None:
        """Raise an error that names the first value outside its interval, beyond rounding."""
        slack = 1e-9 * np.maximum(1.0, np.maximum(np.abs(least), np.abs(most)))
        slack = np.where(np.isfinite(slack), slack, 0.0)
        bad = (value < least - slack) | (value > most + slack)
        for number in np.flatnonzero(bad)[:1].tolist():
            given, low, high = (float(each[number]) for each in (value, least, most))
            raise OutOfRangeError(name, given, self.where(number), why, low, high, unit)


# --------------------------------------------------------------------------------------
# The immersed part: form-parameter curves with an area, between flats. A curve starts at the
# contour, or where the flat of bottom ends, and ends at the draught, or where the flat of side
# begins. What lies level beside the contour has no area; that of the flat of side is subtracted,
# the rest is the curve's. Its centroid is that of the definition, or as it comes out fairest.

RADIUS_SLACK = 5e-7
"""By so much, of the area, a bilge radius may miss the area of the section."""

_BELOW = -1e-9
"""A half-breadth (m) below this is negative."""

_TANGENT = 0.5
"""The tangent, in quarters of the chord, where no definition gives one."""


def underwater_pieces(
    stand: SectionEnds, tokens: tuple[str, ...]
) -> tuple[list[SectionPieces], FormEnd]:
    """Give the pieces from the contour to the draught, in order, and the ends of the last.

    `tokens` are the pieces of the layout up to the draught. Point, angle and curvature of the
    last ends are those with which the part above starts.
    """
    pieces: list[SectionPieces] = []
    corner = stand.start
    if tokens[0] in ("level", "siding"):
        if tokens[1] == "arc":
            corner = _arc_start(stand)
        else:
            use = "flat_of_bottom" if tokens[0] == "level" else "half_siding"
            corner = np.stack([stand.start[:, 0], stand.needed(use)], axis=1)
        pieces.append(straight_pieces(stand.start, corner))
    if "arc" in tokens:
        radius = stand.needed("bilge_radius")
        pieces.append(SectionArcs(corner, radius))
        finish = FormEnd.of(corner[:, 0] + radius, corner[:, 1] + radius, 0.0)
    else:
        start, finish = _curve_ends(stand, tokens, corner)
        pieces.append(_curve(stand, start, finish))
    if tokens[-1] == "upright":
        top = np.stack([stand.draught, finish.y], axis=1)
        pieces.append(straight_pieces(np.stack([finish.x, finish.y], axis=1), top))
        finish = FormEnd.of(stand.draught, finish.y, 0.0)
    return pieces, finish


def straight_pieces(start: FloatArray, finish: FloatArray) -> SectionCurves:
    """Give straight pieces between points, (n, 2) each."""
    return SectionCurves(straight_vertices(start, finish), start, finish)


def chord_of(start: FloatArray, finish: FloatArray) -> FloatArray:
    """Give the distances of points, (n, 2) each."""
    step = finish - start
    return np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1])


def _arc_start(stand: SectionEnds) -> FloatArray:
    """Give where the bilge begins; its radius must fit the area of the section."""
    radius, breadth = stand.needed("bilge_radius"), stand.needed("design_waterline")
    height = stand.draught - stand.start[:, 0]
    area = 0.5 * stand.needed("sectional_area")
    stand.within(
        "bilge_radius", "m", "has no room between the centre plane and the draught",
        radius, 0.0 * radius, np.minimum(breadth, height),
    )  # fmt: skip
    gives = bilge_area(breadth, height, radius)
    off = np.abs(gives - area) > RADIUS_SLACK * area
    for number in np.flatnonzero(off)[:1].tolist():
        fits = bilge_radius_for(*(float(each[number]) for each in (breadth, height, area)))
        stand.refuse(
            off,
            f"bilge_radius {radius[number]:.8g} m gives {2.0 * gives[number]:.8g} m2, the curve of "
            f"areas {2.0 * area[number]:.8g} m2",
            f"give a bilge_radius of {fits:.8g} m, or another full area",
        )
    return np.stack([stand.start[:, 0], breadth - radius], axis=1)


def _curve_ends(
    stand: SectionEnds, tokens: tuple[str, ...], corner: FloatArray
) -> tuple[FormEnd, FormEnd]:
    """Give both ends of the curved part."""
    count = len(stand.x)
    upright = tokens[-1] == "upright"
    if upright:
        top = np.stack(
            [stand.needed("flat_of_side"), np.full(count, 0.5 * stand.forms.particulars.breadth)],
            axis=1,
        )
        _on_the_side(stand, top)
    else:
        top = np.stack([stand.draught, stand.needed("design_waterline")], axis=1)
    chord = chord_of(corner, top)
    level = np.full(count, 0.5 * np.pi)
    start = FormEnd.of(
        corner[:, 0], corner[:, 1],
        level if tokens[0] == "level" else stand.radians("keel_angle"),
        stand.value("keel_curvature", 0.0),
        0.25 * chord * stand.value("keel_tangent", _TANGENT),
    )  # fmt: skip
    finish = FormEnd.of(
        top[:, 0], top[:, 1],
        np.zeros(count) if upright else stand.radians("waterline_angle", 0.0),
        stand.value("waterline_curvature", 0.0),
        0.25 * chord * stand.value("waterline_tangent", _TANGENT),
    )  # fmt: skip
    return start, finish


def _on_the_side(stand: SectionEnds, top: FloatArray) -> None:
    """Refuse a flat of side where the waterline at the draught does not reach it."""
    breadth = stand.needed("design_waterline")
    off = np.abs(breadth - top[:, 1]) > 1e-6 * top[:, 1]
    for number in np.flatnonzero(off)[:1].tolist():
        stand.refuse(
            off,
            f"the flat of side begins at z = {top[number, 0]:.6g} m, and the half-breadth at the "
            f"draught is {breadth[number]:.8g} m, not {top[number, 1]:.8g} m",
            "let the flat of side rise through the draught where the waterline leaves it",
        )


def _curve(stand: SectionEnds, start: FormEnd, finish: FormEnd) -> SectionCurves:
    """Give the curves with what the flat of side leaves of area and moment."""
    half = 0.5 * stand.value("sectional_area")
    above = stand.draught - finish.x
    wall = finish.y * above
    height = finish.x - start.x
    stand.refuse(~(height > 0.0), "the contour is not below the flat of side", "lower the profile")
    area = half - wall
    low, high = np.minimum(start.y, finish.y), np.maximum(start.y, finish.y)
    stand.within(
        "sectional_area", "m2", "lies outside the box between contour and draught",
        2.0 * half, 2.0 * (low * height + wall), 2.0 * (high * height + wall),
    )  # fmt: skip
    total = stand.value("centroid")
    moment = total * half - wall * (finish.x + 0.5 * above)
    with np.errstate(divide="ignore", invalid="ignore"):
        centroid = np.where(area > 0.0, moment / area, np.nan)
    _check_centroid(stand, start, finish, area, centroid, wall)
    found = form_vertices(start, finish, area, centroid)
    stand.refuse(
        ~(np.isfinite(found[:, 3, 0]) & np.isfinite(found[:, 3, 1])),
        "no curve has these ends and this area", "give other angles or tangents",
    )  # fmt: skip
    lowest = least_coordinate(found, 1)
    for number in np.flatnonzero(lowest < _BELOW)[:1].tolist():
        stand.refuse(
            lowest < _BELOW,
            f"the curve with this area has a half-breadth of {lowest[number]:.4g} m",
            "give a larger sectional_area, or another keel_angle or keel_tangent",
        )
    return SectionCurves(found, *end_points_2d(start, finish))


def _check_centroid(
    stand: SectionEnds,
    start: FormEnd,
    finish: FormEnd,
    area: FloatArray,
    centroid: FloatArray,
    wall: FloatArray,
) -> None:
    """Refuse centroids that no curve of the area has.

    The interval in the error is that of the immersed half section, the wall included.
    """
    if np.isnan(centroid).all():
        return
    least, most = _monotone(start, finish, area)
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    disc = middle_vertex(ends, area, centroid)[1]
    step = middle_vertex(ends, area, centroid + 1.0)[1] - disc
    with np.errstate(divide="ignore", invalid="ignore"):
        # The discriminant is linear in the centroid: the last one is where it is zero.
        last = centroid - disc / step
    lost = disc < 0.0
    least = np.where(lost & (step > 0.0), np.maximum(least, last), least)
    most = np.where(lost & (step < 0.0), np.minimum(most, last), most)
    top = finish.x + 0.5 * (stand.draught - finish.x)
    with np.errstate(divide="ignore", invalid="ignore"):
        given, low, high = (
            (each * area + top * wall) / (area + wall) for each in (centroid, least, most)
        )
    stand.within("centroid", "m", "cannot be met with the area", given, low, high)


def _monotone(start: FormEnd, finish: FormEnd, area: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the centroids between which curves lie whose half-breadth only rises, or only falls."""
    length, rise = finish.x - start.x, finish.y - start.y
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(rise == 0.0, 0.5, (area / length - start.y) / rise)
        box = 0.5 * start.y * length * length
        # All of the rise at one place, or at both ends: the two extremes of the moment.
        early = box + 0.5 * rise * share * length * length
        late = box + rise * share * length * (length - 0.5 * share * length)
        low, high = np.minimum(early, late) / area, np.maximum(early, late) / area
    return start.x + low, start.x + high


# --------------------------------------------------------------------------------------
# The part above the draught, or all of a section whose contour lies above it. It starts with point,
# angle and curvature of the curve below, so the curvature is continuous at the draught.


def join_vertices(start: FormEnd, finish: FormEnd, first: FloatArray | float = 1.0) -> FloatArray:
    """Give the vertices (n, 7, 2), m, of fair curves between ends.

    Tangent lengths of the ends do not count: that at the start is `first` quarters of the chord,
    that at the finish one. The middle vertex is that of the least integral of the squared third
    derivative.
    """
    pace = 0.25 * chord_of(*end_points_2d(start, finish))
    return form_vertices(
        attrs.evolve(start, tangent=pace * first), attrs.evolve(finish, tangent=pace)
    )


def topside_pieces(
    stand: SectionEnds, tokens: tuple[str, ...], below: FormEnd | None
) -> list[SectionPieces]:
    """Give the pieces up to the deck edge.

    `tokens` are ``("topside",)`` or ``("topside", "wall")``, `below` the ends of the part below
    the draught; where there is none, the topside starts at the contour.
    """
    start = _from_contour(stand) if below is None else below
    first = stand.value("keel_tangent", 1.0) if below is None else 1.0
    stand.refuse(
        ~(stand.finish[:, 0] > start.x), "the deck edge is not above the draught and the contour",
        "raise the deck edge",
    )  # fmt: skip
    pieces: list[SectionPieces] = []
    if tokens[-1] == "wall":
        side = FormEnd.of(stand.needed("flat_of_side"), 0.5 * stand.forms.particulars.breadth, 0.0)
        pieces.append(_piece(stand, start, side, first))
        start, first = side, 1.0
    pieces.append(_piece(stand, start, _deck(stand, start), first))
    return pieces


def _piece(
    stand: SectionEnds, start: FormEnd, finish: FormEnd, first: FloatArray | float
) -> SectionCurves:
    """Join two ends, `first` as of `join_vertices`; refuse half-breadths below 0."""
    vertices = join_vertices(start, finish, first)
    lowest = least_coordinate(vertices, 1)
    for number in np.flatnonzero(~(lowest >= -1e-9))[:1].tolist():
        stand.refuse(
            ~(lowest >= -1e-9), f"the topside has a half-breadth of {lowest[number]:.4g} m",
            "give other angles at the draught, the contour or the deck",
        )  # fmt: skip
    return SectionCurves(vertices, *end_points_2d(start, finish))


def _from_contour(stand: SectionEnds) -> FormEnd:
    return FormEnd.of(
        stand.start[:, 0], stand.start[:, 1], stand.radians("keel_angle"),
        stand.value("keel_curvature", 0.0),
    )  # fmt: skip


def _deck(stand: SectionEnds, start: FormEnd) -> FormEnd:
    """Give the ends at the deck edge; without a `deck_angle`, that of a cubic not bent there."""
    z, y = stand.finish.T
    along = [
        math.atan2(dy, dz)
        for dz, dy in zip((z - start.x).tolist(), (y - start.y).tolist(), strict=True)
    ]
    # a cubic with no second derivative at its end: slope 1.5 chord - 0.5 start; taken for angles
    free = 1.5 * np.array(along) - 0.5 * start.angle
    angle = stand.radians("deck_angle", math.nan)
    angle = np.where(np.isnan(angle), free, angle)
    return FormEnd.of(z, y, angle, stand.value("deck_curvature", 0.0))


# --------------------------------------------------------------------------------------
# Sections through a bulbous bow: abaft the stem a bulb up to its neck, then an upper curve to the
# draught; ahead of the stem the bulb closes on the contour again. ``bulb_area`` is the area up to
# the neck, the upper curve has the rest. The neck is where the section turns from round to hollow:
# both curves have no curvature there. The treatment is our own.

_LEAST = 0.01
"""Shorter pieces (m) are left out."""

_PACE = 0.7
"""Both tangents at the neck, in quarters of the chord."""


def bulb_layout(forms: Forms, x: float, part: int, heights: tuple[float, ...]) -> str | None:
    """Give the pieces of a section at x (m) below the draught where there is a bulb, else None.

    ``"round"`` is a bulb that closes, ``""`` the curve above it, ``"bulb+upper"`` a section abaft
    the stem. `part` is 0 for the lower or only curve, 1 for the curve above a bulb that closes;
    `heights` (m) are those at which the section meets the profile, from below.
    """
    where = f"at the section x = {x:g} m"
    if len(heights) >= 3:
        if heights[2] < forms.particulars.draught - _LEAST:
            raise BadInputError(
                f"the stem overhangs the bulb from z = {heights[2]:.4g} m, below the draught",
                where, "let the section stand abaft the neck of the stem, or ahead of FP",
            )  # fmt: skip
        return "" if part else "round"
    if part:
        raise BadInputError(f"there is no curve {part} where no bulb closes", where, "leave it out")
    if not forms.has("bulb_area") or math.isnan(float(forms.value("bulb_area", x)[0])):
        return None
    return "bulb+upper"


def bulb_pieces(stand: SectionEnds, tokens: tuple[str, ...]) -> tuple[list[SectionPieces], FormEnd]:
    """Give the pieces of sections through a bulb up to the draught, and the ends of the last.

    `tokens` are ``("round",)`` or ``("bulb", "upper")``.
    """
    half = 0.5 * stand.needed("bulb_area")
    if tokens == ("round",):
        _has_area(stand, half, np.full(len(half), np.inf))
        vertices = bulb_vertices(stand.start, stand.finish, half)
        _refuse(stand, vertices, "the bulb", "give another bulb_area or profile")
        closed = FormEnd.of(stand.finish[:, 0], stand.finish[:, 1], -0.5 * math.pi)
        return [SectionCurves(vertices, stand.start, stand.finish)], closed
    area = 0.5 * stand.needed("sectional_area")
    _has_area(stand, half, area)
    neck = np.stack([stand.needed("bulb_height"), stand.needed("bulb_neck")], axis=1)
    _above(stand, neck)
    angle = stand.radians("bulb_neck_angle")
    bulb = bulb_vertices(stand.start, neck, half, angle)
    _refuse(stand, bulb, "the bulb", "give other values to bulb_area, bulb_neck or bulb_height")
    top = np.stack([stand.draught, stand.needed("design_waterline")], axis=1)
    pace = 0.25 * chord_of(neck, top)
    start = FormEnd.of(neck[:, 0], neck[:, 1], angle, 0.0, _PACE * pace)
    finish = FormEnd.of(
        top[:, 0], top[:, 1],
        stand.radians("waterline_angle", 0.0), stand.value("waterline_curvature", 0.0),
        pace * stand.value("waterline_tangent", _TANGENT),
    )  # fmt: skip
    upper = form_vertices(start, finish, area - half)
    _refuse(stand, upper, "the curve above the neck", "give a smaller bulb_area")
    return [
        SectionCurves(bulb, stand.start, neck),
        SectionCurves(upper, *end_points_2d(start, finish)),
    ], finish


def bulb_vertices(
    start: FloatArray, neck: FloatArray, area: FloatArray, angle: FloatArray | None = None
) -> FloatArray:
    """Give the vertices (n, 7, 2), m, of halves of bulbs; nan where there is none.

    `start` and `neck`, (n, 2) m, are z and y at the contour and at the neck, or at the contour
    above; `area` (m2) is int y dz; `angle` (rad) that at the neck, None for bulbs that close.

    At the contour a bulb starts level. Its tangent and curvature there lie between those of half
    an ellipse that closes (neck on the centre plane) and of a quarter (upright at the neck), by
    the share s = pi/4 y h / A, 0 and 1 for the two, with height h and half-breadth y of the neck
    and the area A. The middle vertex is that of the least integral of the squared third
    derivative with the area.
    """
    height, breadth = neck[:, 0] - start[:, 0], neck[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = 0.25 * math.pi * breadth * height / area
        pace = area / height - 0.125 * math.pi * breadth
        pace = np.where(pace > 0.0, pace, np.nan)
        bend = math.pi**2 / 64.0 * height * np.maximum(2.0 - share, 0.0) / (pace * pace)
    begin = FormEnd.of(start[:, 0], start[:, 1], 0.5 * math.pi, -bend, pace)
    if angle is None:
        end = FormEnd.of(neck[:, 0], neck[:, 1], -0.5 * math.pi, -bend, pace)
    else:
        end = FormEnd.of(neck[:, 0], neck[:, 1], angle, 0.0, _PACE * 0.25 * chord_of(start, neck))
    return form_vertices(begin, end, area)


def _has_area(stand: SectionEnds, half: FloatArray, most: FloatArray) -> None:
    stand.within(
        "bulb_area", "m2", "is not a part of the section",
        2.0 * half, np.full(len(half), 1e-6), 2.0 * most,
    )  # fmt: skip


def _above(stand: SectionEnds, neck: FloatArray) -> None:
    stand.within(
        "bulb_height", "m", "is not between contour and draught",
        neck[:, 0], stand.start[:, 0] + _LEAST, stand.draught - _LEAST,
    )  # fmt: skip
    stand.within(
        "bulb_neck", "m", "is no half-breadth of the ship", neck[:, 1], 0.0 * neck[:, 1],
        np.full(len(neck), 0.5 * stand.forms.particulars.breadth),
    )  # fmt: skip


def _refuse(stand: SectionEnds, vertices: FloatArray, what: str, remedy: str) -> None:
    """Refuse curves that are none, or cross the centre plane."""
    lost = ~(np.isfinite(vertices[:, 3, 0]) & np.isfinite(vertices[:, 3, 1]))
    stand.refuse(lost, f"no curve of {what} has this area", remedy)
    lowest = least_coordinate(vertices, 1)
    for number in np.flatnonzero(lowest < _BELOW)[:1].tolist():
        stand.refuse(
            lowest < _BELOW, f"{what} has a half-breadth of {lowest[number]:.4g} m", remedy
        )


# --------------------------------------------------------------------------------------
# Whole sections.


def parts_at_draught(layout: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Divide a layout at the draught: the pieces below it, and those above."""
    tokens = tuple(layout.split("+"))
    cut = tokens.index("topside") if "topside" in tokens else len(tokens)
    return tokens[:cut], tokens[cut:]


def section_shape(forms: Forms, layout: str, x: FloatArray, ends: FloatArray) -> SectionShape:
    """Give sections of one layout at x, (n,) m, between contour and deck edge, (n, 2, 3) m.

    Raises
    ------
    OutOfRangeError
        An area or a centroid that no curve has; with the section and the interval.
    BadInputError
        A definition that does not reach so far, a half-breadth below 0.
    """
    stand = SectionEnds.of(forms, x, ends)
    lower, upper = parts_at_draught(layout)
    pieces: list[SectionPieces] = []
    below: FormEnd | None = None
    if lower:
        make = bulb_pieces if lower[0] in ("bulb", "round") else underwater_pieces
        pieces, below = make(stand, lower)
    if upper:
        pieces = pieces + topside_pieces(stand, upper, below)
    return SectionShape(x, tuple(pieces))
