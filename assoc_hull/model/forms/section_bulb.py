"""Sections through a bulbous bow: a bulb up to its neck, and what rises from the neck.

Abaft the stem a section is a bulb, then an upper curve to the draught. ``bulb_area`` is the area
up to the neck, the upper curve has the rest of the area of the section. The neck is where the
section turns from round to hollow: both curves have its point, its angle and no curvature there,
so the curvature is continuous. Ahead of the stem the bulb closes on the contour again.

At the contour a bulb starts level. There its tangent and curvature are, between those of half an
ellipse that closes (neck on the centre plane) and those of a quarter (upright at the neck), as the
share s of the neck in the bulb tells: s = pi/4 y h / A, 0 and 1 for the two, with the height h, the
half-breadth y of the neck and the area A of half the bulb. The middle vertices are those of the
least integral of the squared third derivative with the area. The treatment is our own.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.curve import form_at
>>> from assoc_hull.geometry.form_curves.integrals import form_integrals
>>> from assoc_hull.model.forms.section_bulb import bulb_vertices
>>> height, breadth = 9.0, 2.25
>>> half = np.pi / 4.0 * height * breadth
>>> closed = bulb_vertices(np.zeros((1, 2)), np.array([[height, 0.0]]), np.array([half]))
>>> round(float(form_integrals(closed).area[0] / half), 12)
1.0
>>> form_at(closed, np.array([2.0])).round(2).tolist()  # an ellipse, nearly
[[4.5, 2.25]]
"""

from __future__ import annotations

import math

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.extremes import least_coordinate
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.section_pieces import CurvePieces, Pieces, ends_of
from assoc_hull.model.forms.stand import Stand
from assoc_hull.model.forms.underwater import chord_of

__all__ = ["bulb_layout", "bulb_pieces", "bulb_vertices"]

_LEAST = 0.01
"""Shorter pieces (m) are left out."""

_BELOW = -1e-9
"""A half-breadth (m) below this is negative."""

_PACE = 0.7
"""Both tangents at the neck, in quarters of the chord."""

_TANGENT = 0.5
"""The tangent at the draught, in quarters of the chord, where no definition gives one."""


def bulb_layout(forms: Forms, x: float, part: int, heights: tuple[float, ...]) -> str | None:
    """Give the pieces of a section below the draught where there is a bulb.

    Parameters
    ----------
    forms : Forms
        The definitions.
    x : float, m
        Where the section stands.
    part : int
        0 for the lower or only curve, 1 for the curve above a bulb that closes.
    heights : tuple of float, m
        Where it meets the profile, from below.

    Returns
    -------
    str or None
        ``"round"`` for a bulb that closes, empty for the curve above it, ``"bulb+upper"`` abaft
        the stem, None where there is no bulb.

    Raises
    ------
    BadInputError
        The stem overhangs the bulb below the draught, or the section has no such curve.
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


def bulb_pieces(stand: Stand, tokens: tuple[str, ...]) -> tuple[list[Pieces], FormEnd]:
    """Give the pieces of sections through a bulb, up to the draught.

    Parameters
    ----------
    stand : Stand
        The sections.
    tokens : tuple of str
        ``("round",)`` or ``("bulb", "upper")``.

    Returns
    -------
    list of Pieces, FormEnd
        In order, and the last ends.

    Raises
    ------
    OutOfRangeError
        An area of the bulb that is none, or more than that of the section.
    BadInputError
        A definition that does not reach so far, a bulb that no curve has.
    """
    half = 0.5 * stand.needed("bulb_area")
    if tokens == ("round",):
        _has_area(stand, half, np.full(len(half), np.inf))
        vertices = bulb_vertices(stand.start, stand.finish, half)
        _refuse(stand, vertices, "the bulb", "give another bulb_area or profile")
        closed = FormEnd.of(stand.finish[:, 0], stand.finish[:, 1], -0.5 * math.pi)
        return [CurvePieces(vertices, stand.start, stand.finish)], closed
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
        CurvePieces(bulb, stand.start, neck),
        CurvePieces(upper, *ends_of(start, finish)),
    ], finish


def bulb_vertices(
    start: FloatArray, neck: FloatArray, area: FloatArray, angle: FloatArray | None = None
) -> FloatArray:
    """Give the vertices of halves of bulbs.

    Parameters
    ----------
    start, neck : (n, 2), m
        z and y at the contour and at the neck, or at the contour above.
    area : (n,), m2
        Of half the bulb, int y dz.
    angle : (n,) or None, rad
        At the neck, in the graph of y over z; None for bulbs that close.

    Returns
    -------
    (n, 7, 2)
        nan where there is none.
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


def _has_area(stand: Stand, half: FloatArray, most: FloatArray) -> None:
    stand.within(
        "bulb_area", "m2", "is not a part of the section",
        2.0 * half, np.full(len(half), 1e-6), 2.0 * most,
    )  # fmt: skip


def _above(stand: Stand, neck: FloatArray) -> None:
    stand.within(
        "bulb_height", "m", "is not between contour and draught",
        neck[:, 0], stand.start[:, 0] + _LEAST, stand.draught - _LEAST,
    )  # fmt: skip
    stand.within(
        "bulb_neck", "m", "is no half-breadth of the ship", neck[:, 1], 0.0 * neck[:, 1],
        np.full(len(neck), 0.5 * stand.forms.particulars.breadth),
    )  # fmt: skip


def _refuse(stand: Stand, vertices: FloatArray, what: str, remedy: str) -> None:
    """Refuse curves that are none, or cross the centre plane."""
    lost = ~(np.isfinite(vertices[:, 3, 0]) & np.isfinite(vertices[:, 3, 1]))
    stand.refuse(lost, f"no curve of {what} has this area", remedy)
    lowest = least_coordinate(vertices, 1)
    for number in np.flatnonzero(lowest < _BELOW)[:1].tolist():
        stand.refuse(
            lowest < _BELOW, f"{what} has a half-breadth of {lowest[number]:.4g} m", remedy
        )
