"""The pieces of a waterline through its regions, each going on from the one before it.

A *line* runs straight between the half-breadths at its boundaries; a *quintic* begins with the
slope of the piece before it, ends with that of a line after it, and takes what is left from
offsets; a *circle* goes on tangentially to its end; a *conic* goes on with value and slope, a
*cubic conic* with the second derivative too, and both stand upright at their end. The first piece
goes on from a parallel side: level and straight.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, the combined method. There a circle is written with abscissae from 0 to 1,
which makes it an ellipse in true lengths; here abscissae are true.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import listed, mapped, number, numbers
from assoc_hull.geometry.classical.checks import called, figure
from assoc_hull.geometry.classical.combined_waterline import conic, conic_notes, quintic_notes
from assoc_hull.geometry.classical.cubic_conic import cubic_conic
from assoc_hull.geometry.classical.pieces import Piece, PiecedCurve
from assoc_hull.geometry.classical.quintic import fit_quintic
from assoc_hull.geometry.classical.regions import Region
from assoc_hull.geometry.curves import FloatArray

__all__ = ["circle_piece", "joined_pieces"]


def circle_piece(first: float, last: float, y: float, slope: float, end: float) -> Piece:
    """Make the arc that goes on from a curve with value and slope to a point.

    Parameters
    ----------
    first, last : float, m
        Where it begins and ends.
    y, slope : float, m and 1
        y and dy/dx at `first`.
    end : float, m
        y at `last`.

    Raises
    ------
    GeometryError
        No arc that is one function of x and bends downward: a line, one that bends upward, one
        that turns back.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.joined_pieces import circle_piece
    >>> round(float(circle_piece(0.0, 4.0, 5.0, 0.0, 3.0).at(3.0)), 9)
    4.0
    """
    begin, finish, value, rise, level = numbers(
        [first, last, y, slope, end], "circle", (5,)
    ).tolist()
    length, fall = finish - begin, level - value
    # Tangent (1, rise) and chord (length, fall): k = 2 (t x d)/|d|^2 with a unit tangent.
    cross = fall - rise * length
    steep = float(np.hypot(1.0, rise))
    if not (length > 0.0 and cross < -1e-12 * float(np.hypot(length, fall)) * steep):
        what = f"circle: no arc bends down from slope {figure(rise)} over a fall of {figure(-fall)}"
        raise GeometryError(what, "use a line, or a quintic", {"slope": rise, "fall": -fall})
    radius = (length * length + fall * fall) * steep / (-2.0 * cross)
    middle = (begin + radius * rise / steep, value - radius / steep)
    if level < middle[1]:
        what = f"circle: the arc turns back before x={figure(finish)}"
        raise GeometryError(what, "let it end higher, or further on", {"radius": radius})
    far = finish - middle[0]
    under = np.array([radius**2 - far**2, 2.0 * far * length, -(length**2)])
    return Piece("circle", begin, finish, under, middle[1])


def joined_pieces(
    regions: Sequence[Region], heights: Mapping[str, float], offsets: ArrayLike
) -> PiecedCurve:
    """Make the waterline through regions.

    Parameters
    ----------
    regions : sequence of Region
        Of one waterline, in order of x (`Regions.at`).
    heights : mapping of str to float, m
        Half-breadth on each boundary; at the last one that at the end of the ship.
    offsets : (n, 2), m
        x and half-breadth of the waterline; those within quintics are used.

    Returns
    -------
    PiecedCurve

    Raises
    ------
    GeometryError
        A boundary without half-breadth; a conic that is not the last; whatever the pieces
        themselves refuse.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.joined_pieces import joined_pieces
    >>> from assoc_hull.geometry.classical.regions import Region
    >>> regions = [Region("flat", "change", "quintic", 20.0, 60.0),
    ...            Region("change", "end", "conic", 60.0, 75.0)]
    >>> given = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]
    >>> curve = joined_pieces(regions, {"flat": 12.0, "change": 6.5, "end": 0.0}, given)
    >>> [piece.formula for piece in curve.pieces]
    ['quintic', 'conic']
    """
    points = numbers(offsets, "regions", (None, 2))
    mapped(heights, "regions: half-breadths")
    chain = listed(regions, "regions")
    for each in chain:
        if not isinstance(each, Region):
            raise GeometryError(f"regions: {called(each)}", "give those of `Regions.at`")
    notes, pieces = list[str](), list[Piece]()
    for k, region in enumerate(chain):
        ends = _height(heights, region.after), _height(heights, region.before)
        after = chain[k + 1] if k + 1 < len(chain) else None
        before = pieces[-1] if pieces else None
        if region.formula == "quintic":
            piece, told = _quintic(region, ends, before, _next_slope(after, heights), points)
            notes += told
        else:
            piece = _other(region, ends, before, after)
            if piece.formula == "conic":
                slope = float(pieces[-1].at(region.first, 1))
                notes += conic_notes(-slope * (region.last - region.first))
        pieces.append(piece)
    return PiecedCurve.make(tuple(pieces), tuple(notes))


def _height(heights: Mapping[str, float], name: str) -> float:
    if name not in heights:
        raise GeometryError(f"regions: no half-breadth on boundary {name}", "give one")
    return number(heights[name], f"regions: boundary {name}")


def _next_slope(after: Region | None, heights: Mapping[str, float]) -> float | None:
    """Give the slope that the piece after asks for: a line has its own."""
    if after is None or after.formula != "line":
        return None
    rise = _height(heights, after.before) - _height(heights, after.after)
    return rise / (after.last - after.first)


def _quintic(
    region: Region,
    ends: tuple[float, float],
    before: Piece | None,
    end_slope: float | None,
    points: FloatArray,
) -> tuple[Piece, tuple[str, ...]]:
    length = region.last - region.first
    mine = points[(points[:, 0] > region.first) & (points[:, 0] < region.last)]
    # The parallel side lies before the first piece: that begins level.
    start = 0.0 if before is None else float(before.at(region.first, 1))
    finish = None if end_slope is None else end_slope * length
    fit = fit_quintic(
        (mine[:, 0] - region.first) / length, mine[:, 1], *ends, start * length, finish
    )
    piece = Piece("quintic", region.first, region.last, fit.coefficients.copy())
    return piece, quintic_notes(fit)


def _other(
    region: Region, ends: tuple[float, float], before: Piece | None, after: Region | None
) -> Piece:
    first, last = region.first, region.last
    if region.formula == "line":
        return Piece("line", first, last, np.array([ends[0], ends[1] - ends[0]]))
    name = f"{region.after} to {region.before}"
    if after is not None and region.formula != "circle":
        what = f"regions: the {region.formula} of {name} is not the last"
        raise GeometryError(what, "it stands upright at its end: nothing goes on from there")
    slope, second = (
        (0.0, 0.0) if before is None else (float(before.at(first, order)) for order in (1, 2))
    )
    if region.formula == "circle":
        return circle_piece(first, last, ends[0], slope, ends[1])
    if region.formula == "conic":
        return conic(first, last, ends[0], slope, ends[1])
    return cubic_conic(first, last, ends[0], slope, second, ends[1])
