"""The part of sections above the draught, or all of one whose contour lies above it.

A topside starts with point, angle and curvature of the curve below it, so the curvature is
continuous at the draught, and ends at the deck edge. Both tangents are a quarter of the chord; the
middle vertex is that of the least integral of the squared third derivative.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.geometry.form_curves.curve import FormEnd
>>> from assoc_hull.model.forms.topside import join_vertices
>>> below = FormEnd.of(10.5, 8.0, np.radians(15.0), 0.01)
>>> deck = FormEnd.of(15.0, 9.5, np.radians(10.0))
>>> join_vertices(below, deck)[0, 3].round(9).tolist()
[12.733173599, 8.825001545]
"""

from __future__ import annotations

import math

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.extremes import least_coordinate
from assoc_hull.model.forms.section_pieces import CurvePieces, Pieces, ends_of
from assoc_hull.model.forms.stand import Stand
from assoc_hull.model.forms.underwater import chord_of

__all__ = ["join_vertices", "topside_pieces"]


def join_vertices(start: FormEnd, finish: FormEnd, first: FloatArray | float = 1.0) -> FloatArray:
    """Give the vertices of fair curves between ends.

    Parameters
    ----------
    start, finish : FormEnd
        Their tangent lengths do not count.
    first : (n,) or float
        The tangent at the start, in quarters of the chord; that at the finish is one.

    Returns
    -------
    (n, 7, 2)
    """
    pace = 0.25 * chord_of(*ends_of(start, finish))
    return form_vertices(
        attrs.evolve(start, tangent=pace * first), attrs.evolve(finish, tangent=pace)
    )


def topside_pieces(stand: Stand, tokens: tuple[str, ...], below: FormEnd | None) -> list[Pieces]:
    """Give the pieces up to the deck edge.

    Parameters
    ----------
    stand : Stand
        The sections.
    tokens : tuple of str
        ``("topside",)`` or ``("topside", "wall")``.
    below : FormEnd or None
        How the part below the draught ends; None where there is none: from the contour then.

    Returns
    -------
    list of Pieces

    Raises
    ------
    BadInputError
        A deck edge below the draught, a half-breadth below 0.
    """
    start = _from_contour(stand) if below is None else below
    first = stand.value("keel_tangent", 1.0) if below is None else 1.0
    stand.refuse(
        ~(stand.finish[:, 0] > start.x), "the deck edge is not above the draught and the contour",
        "raise the deck edge",
    )  # fmt: skip
    pieces: list[Pieces] = []
    if tokens[-1] == "wall":
        side = FormEnd.of(stand.needed("flat_of_side"), 0.5 * stand.forms.particulars.breadth, 0.0)
        pieces.append(_piece(stand, start, side, first))
        start, first = side, 1.0
    pieces.append(_piece(stand, start, _deck(stand, start), first))
    return pieces


def _piece(stand: Stand, start: FormEnd, finish: FormEnd, first: FloatArray | float) -> CurvePieces:
    vertices = join_vertices(start, finish, first)
    lowest = least_coordinate(vertices, 1)
    for number in np.flatnonzero(~(lowest >= -1e-9))[:1].tolist():
        stand.refuse(
            ~(lowest >= -1e-9), f"the topside has a half-breadth of {lowest[number]:.4g} m",
            "give other angles at the draught, the contour or the deck",
        )  # fmt: skip
    return CurvePieces(vertices, *ends_of(start, finish))


def _from_contour(stand: Stand) -> FormEnd:
    return FormEnd.of(
        stand.start[:, 0], stand.start[:, 1], stand.radians("keel_angle"),
        stand.value("keel_curvature", 0.0),
    )  # fmt: skip


def _deck(stand: Stand, start: FormEnd) -> FormEnd:
    """Give the ends at the deck edge; the angle of a cubic not bent there where none is given."""
    z, y = stand.finish.T
    along = [
        math.atan2(dy, dz)
        for dz, dy in zip((z - start.x).tolist(), (y - start.y).tolist(), strict=True)
    ]
    free = 1.5 * np.array(along) - 0.5 * start.angle
    angle = stand.radians("deck_angle", math.nan)
    angle = np.where(np.isnan(angle), free, angle)
    return FormEnd.of(z, y, angle, stand.value("deck_curvature", 0.0))
