"""The immersed part of sections: form-parameter curves with an area, between flats.

The plane is that of a graph of the half-breadth y over the height z; the area of half a section is
int y dz, so what lies level beside the contour has none. A curve starts at the contour, or where
the flat of bottom ends, with the angle there; it ends at the draught, or where the flat of side
begins. From the area of the half section that of the flat of side is taken; the rest is the
curve's. Its centroid is that of the definition, or as it comes out fairest.

Examples
--------
>>> from assoc_hull.model.forms.underwater import RADIUS_SLACK
>>> RADIUS_SLACK
5e-07
"""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import straight_vertices
from assoc_hull.geometry.form_curves.curve import FormEnd, end_vertices, form_vertices
from assoc_hull.geometry.form_curves.extremes import least_coordinate
from assoc_hull.geometry.form_curves.middle import middle_vertex
from assoc_hull.model.forms.middle_body import bilge_area, bilge_radius_for
from assoc_hull.model.forms.section_pieces import ArcPieces, CurvePieces, Pieces, ends_of
from assoc_hull.model.forms.stand import Stand

__all__ = ["RADIUS_SLACK", "chord_of", "level_pieces", "straight_pieces", "underwater_pieces"]

RADIUS_SLACK = 5e-7
"""By so much, of the area, a bilge radius may miss the area of the section."""

_BELOW = -1e-9
"""A half-breadth (m) below this is negative."""

_TANGENT = 0.5
"""The tangent, in quarters of the chord, where no definition gives one."""


def underwater_pieces(stand: Stand, tokens: tuple[str, ...]) -> tuple[list[Pieces], FormEnd]:
    """Give the pieces from the contour to the draught.

    Parameters
    ----------
    stand : Stand
        The sections.
    tokens : tuple of str
        The pieces of their layout up to the draught.

    Returns
    -------
    list of Pieces, FormEnd
        In order, and the last ends: point, angle and curvature are those of what comes above.

    Raises
    ------
    OutOfRangeError
        An area or a centroid that no curve has, with those that one has.
    BadInputError
        A definition that does not reach so far, a half-breadth below 0.
    """
    pieces: list[Pieces] = []
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
        pieces.append(ArcPieces(corner, radius))
        finish = FormEnd.of(corner[:, 0] + radius, corner[:, 1] + radius, 0.0)
    else:
        start, finish = _curve_ends(stand, tokens, corner)
        pieces.append(_curve(stand, start, finish))
    if tokens[-1] == "upright":
        top = np.stack([stand.draught, finish.y], axis=1)
        pieces.append(straight_pieces(np.stack([finish.x, finish.y], axis=1), top))
        finish = FormEnd.of(stand.draught, finish.y, 0.0)
    return pieces, finish


def straight_pieces(start: FloatArray, finish: FloatArray) -> CurvePieces:
    """Give straight pieces between points, (n, 2) each."""
    return CurvePieces(straight_vertices(start, finish), start, finish)


def level_pieces(stand: Stand, breadth: FloatArray) -> CurvePieces:
    """Give level pieces from the contour to a half-breadth, (n,) m."""
    return straight_pieces(stand.start, np.stack([stand.start[:, 0], breadth], axis=1))


def chord_of(start: FloatArray, finish: FloatArray) -> FloatArray:
    """Give the distances of points, (n, 2) each."""
    step = finish - start
    return np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1])


def _arc_start(stand: Stand) -> FloatArray:
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
    stand: Stand, tokens: tuple[str, ...], corner: FloatArray
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


def _on_the_side(stand: Stand, top: FloatArray) -> None:
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


def _curve(stand: Stand, start: FormEnd, finish: FormEnd) -> CurvePieces:
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
    return CurvePieces(found, *ends_of(start, finish))


def _check_centroid(
    stand: Stand,
    start: FormEnd,
    finish: FormEnd,
    area: FloatArray,
    centroid: FloatArray,
    wall: FloatArray,
) -> None:
    """Refuse centroids that no curve of the area has; those that one has are told for the whole."""
    if np.isnan(centroid).all():
        return
    least, most = _monotone(start, finish, area)
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    disc = middle_vertex(ends, area, centroid)[1]
    step = middle_vertex(ends, area, centroid + 1.0)[1] - disc
    with np.errstate(divide="ignore", invalid="ignore"):
        # The discriminant is linear in the centroid: where it is nil lies the last one.
        last = centroid - disc / step
    lost = disc < 0.0
    least = np.where(lost & (step > 0.0), np.maximum(least, last), least)
    most = np.where(lost & (step < 0.0), np.minimum(most, last), most)
    top = finish.x + 0.5 * (stand.draught - finish.x)
    with np.errstate(divide="ignore", invalid="ignore"):
        told, low, high = (
            (each * area + top * wall) / (area + wall) for each in (centroid, least, most)
        )
    stand.within("centroid", "m", "cannot be met with the area", told, low, high)


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
