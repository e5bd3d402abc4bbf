"""A waterline of a straight part, a quintic and a conic.

From the end of the parallel side x0 to the change x1 runs a polynomial of degree five that begins
in the direction of the side; from x1 to the end x2 a conic with an upright tangent at its end. With
v = (x2 - x)/(x2 - x1), Y = y - A, Y1 = y1 - A and the slope s = dy/dv at v = 1 of the quintic,

    Y^2 = b1 v + b2 v^2,    b1 = 2 (Y1^2 - Y1 s),    b2 = 2 Y1 s - Y1^2.

The conic is an ellipse where s < Y1/2, a parabola where s = Y1/2, a hyperbola beyond, and for
s = Y1 the straight line to the end. Value and slope agree at both joins, curvature does not: a
cubic conic as the last piece makes it agree.

Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK, eqs 32 to 44.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.polynomial.polynomial import polyder, polyroots, polyval
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import number, numbers, together
from assoc_hull.geometry.classical.checks import figure, inside
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.cubic_conic import cubic_conic
from assoc_hull.geometry.classical.pieces import Piece, PiecedCurve
from assoc_hull.geometry.classical.quintic import Quintic, fit_quintic
from assoc_hull.geometry.curves import FloatArray

__all__ = ["conic", "conic_coefficients", "conic_notes", "quintic_notes", "waterline"]

_STRAIGHT = 1e-12
"""A conic whose slope is that of the straight line to this part is that line."""


def conic_coefficients(height: ArrayLike, slope: ArrayLike) -> FloatArray:
    """Give b1 and b2 of many conics.

    Parameters
    ----------
    height, slope : (...), m
        Y1 = y - A and s = dy/dv at v = 1.

    Returns
    -------
    (..., 2), m2

    Examples
    --------
    >>> from assoc_hull.geometry.classical.combined_waterline import conic_coefficients
    >>> conic_coefficients([2.0, 2.0], [1.0, 0.0]).tolist()
    [[4.0, 0.0], [8.0, -4.0]]
    """
    y, s = together((height, slope), "waterline")
    return np.stack([2.0 * y * (y - s), y * (2.0 * s - y)], axis=-1)


def conic(first: float, last: float, y: float, slope: float, end: float = 0.0) -> Piece:
    """Make the conic that goes on from a curve with value and slope.

    Parameters
    ----------
    first, last : float, m
        The join, and the end, where the tangent is upright.
    y, slope : float, m and 1
        y and dy/dx at `first`.
    end : float, m
        A, half-breadth at `last`.

    Returns
    -------
    Piece
        A line, if the slope is that of the straight line to the end.

    Raises
    ------
    GeometryError
        ``"waterline: y1' = {s} >= y1 = {y1}: conic is not real near the end; move x1"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.combined_waterline import conic
    >>> nose = conic(60.0, 75.0, 6.5, -0.2628518890)
    >>> float(nose.at(70.0).round(6)), round(nose.nose_radius(), 6)
    (3.475913, 1.108129)
    """
    given = numbers([first, last, y, slope, end], "waterline", (5,))
    begin, finish, value, rise, level = given.tolist()
    if not begin < finish:
        what = f"waterline: conic from x={figure(begin)} to x={figure(finish)}"
        raise GeometryError(what, "let it end beyond its beginning")
    height, s = value - level, -rise * (finish - begin)
    if not height > 0.0:
        what = f"waterline: half-breadth {figure(value)} not above {figure(level)} at the end"
        raise GeometryError(what, "give a conic that narrows", {"y1": value, "end": level})
    if abs(s - height) <= _STRAIGHT * height:
        return Piece("line", begin, finish, np.array([value, level - value]))
    if s > height:
        over = "y1" if level == 0.0 else "y1 - A"
        what = f"waterline: y1' = {figure(s)} >= {over} = {figure(height)}: conic is not real "
        raise GeometryError(
            what + "near the end; move x1", "let it lie nearer to the end, or take less slope",
            {"slope": s, "y1": height},
        )  # fmt: skip
    b1, b2 = conic_coefficients(height, s).tolist()
    return Piece("conic", begin, finish, np.array([0.0, b1, b2]), level)


def conic_notes(slope: float) -> tuple[str, ...]:
    """Tell if a conic bulges beyond its beginning; slope is dy/dv at v = 1, m."""
    s = number(slope, "waterline")
    return () if s >= 0.0 else (f"waterline: y1'<0: conic bulges beyond y1 (y1' = {figure(s)}).",)


def quintic_notes(curve: Quintic) -> tuple[str, ...]:
    """Tell where a quintic does not go one way only, by the extremes of its slope."""
    slope = polyder(curve.coefficients)
    turns = polyroots(np.trim_zeros(polyder(slope), "b")) if polyder(slope).any() else np.zeros(0)
    real = turns.real[(np.abs(turns.imag) < 1e-9) & (turns.real > 0.0) & (turns.real < 1.0)]
    u = np.concatenate([[0.0, 1.0], real])
    rise = polyval(u, slope)
    way = -1.0 if curve.coefficients.sum() <= curve.coefficients[0] else 1.0
    worst = int(np.argmin(way * rise))
    if way * rise[worst] >= -1e-12 * float(np.abs(curve.coefficients).max()):
        return ()
    told = f"dy/du = {rise[worst]:.4g} there"
    return (f"waterline: quintic is not monotone at u={u[worst]:.4g}; {told}.",)


def waterline(
    x0: float,
    x1: float,
    x2: float,
    y0: float,
    y1: float,
    offsets: ArrayLike,
    end: float = 0.0,
    *,
    start: float | None = None,
    slope: float = 0.0,
    last: Literal["conic", "cubic conic"] = "conic",
) -> PiecedCurve:
    """Make half a waterline, from the parallel side to the end of the ship.

    Parameters
    ----------
    x0, x1, x2 : float, m
        End of the parallel side, change to the conic, end; rising. For an after body count x
        from midship aft.
    y0, y1 : float, m
        Half-breadths at x0 and x1; 0 < y1 <= y0.
    offsets : (n, 2), m
        x and half-breadth between x0 and x1, three or more; approximated.
    end : float, m
        A, half-breadth at x2.
    start : float or None, m
        Where the straight part begins; None leaves it out.
    slope : float
        dy/dx of the straight part.
    last : str
        "conic", or "cubic conic", which joins with the curvature of the quintic.

    Returns
    -------
    PiecedCurve
        Its notes say where the quintic is not monotone, and if the conic bulges.

    Raises
    ------
    GeometryError
        ``"waterline: need x0 < x1 < x2"``, ``"waterline: fewer than 3 offsets in the quintic
        part"``, ``"waterline: y1' = {s} >= y1 = {y1}: conic is not real near the end; move
        x1"``; those of `cubic_conic`; half-breadths that do not fall.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.combined_waterline import waterline
    >>> given = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]
    >>> fore = waterline(20, 60, 75, 12, 6.5, given)
    >>> fore.at([50.0, 70.0]).round(6).tolist(), round(fore.area(), 6)
    ([8.894022, 3.475913], 469.943833)
    """
    a, b, c, top, change, level, rise = numbers(
        [x0, x1, x2, y0, y1, end, slope], "waterline", (7,)
    ).tolist()
    begin = a if start is None else number(start, "waterline")
    _check_ranges(begin, (a, b, c), (top, change, level))
    one_of(last, tuple(("conic", "cubic conic")), "waterline: last piece")
    points = numbers(offsets, "waterline", (None, 2))
    if len(points):
        inside(points[:, 0], "waterline", a, b)
    between = points[(points[:, 0] > a) & (points[:, 0] < b)]
    if len(np.unique(between[:, 0])) < 3:
        raise GeometryError(
            "waterline: fewer than 3 offsets in the quintic part", "give three or more",
            {"got": len(np.unique(between[:, 0]))},
        )  # fmt: skip
    u = (between[:, 0] - a) / (b - a)
    middle = fit_quintic(u, between[:, 1], top, change, rise * (b - a), None)
    body = Piece("quintic", a, b, middle.coefficients.copy())
    slope1, second = (float(body.at(b, order)) for order in (1, 2))
    if last == "conic":
        nose = conic(b, c, change, slope1, level)
    else:
        nose = cubic_conic(b, c, change, slope1, second, level)
    notes = quintic_notes(middle) + conic_notes(-slope1 * (c - b))
    straight = (Piece("line", begin, a, np.array([top + rise * (begin - a), rise * (a - begin)])),)
    return PiecedCurve.make((*(straight if begin < a else ()), body, nose), notes)


def _check_ranges(
    begin: float, x: tuple[float, float, float], y: tuple[float, float, float]
) -> None:
    if not x[0] < x[1] < x[2]:
        raise GeometryError(
            "waterline: need x0 < x1 < x2", f"x0, x1, x2 are {', '.join(map(figure, x))}",
            {"x0": x[0], "x1": x[1], "x2": x[2]},
        )  # fmt: skip
    if begin > x[0]:
        what = f"waterline: the straight part begins at x={figure(begin)}, after x0={figure(x[0])}"
        raise GeometryError(what, "let it begin before", {"start": begin, "x0": x[0]})
    if not 0.0 <= y[2] < y[1] <= y[0]:
        told = ", ".join(map(figure, (y[0], y[1], y[2])))
        what = f"waterline: half-breadths {told} at x0, x1, x2 do not fall"
        raise GeometryError(what, "need y0 >= y1 > A >= 0", {"y0": y[0], "y1": y[1], "end": y[2]})
