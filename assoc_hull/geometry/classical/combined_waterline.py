"""A waterline by the combined method: straight part, quintic by least squares, conic at the end.

`combined_waterline` makes one waterline from its three abscissae and offsets. `WaterlineRegions`
holds boundary curves in the side plan and the formula between each two; `joined_pieces` makes the
waterline through the regions that it cuts. The pieces themselves stand in `pieced_curve`. Source:
Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and Production",
J. SNAK, eqs 22 to 44.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise, product
from typing import Literal, Self, get_args

import attrs
import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.polynomial.polynomial import polyder, polyroots, polyval, polyvander
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import (
    argument_text,
    checked_list,
    checked_mapping,
    digits,
    number,
    number_array,
    numbers,
    one_of,
    positive_weights,
    whole_number,
    within_range,
)
from assoc_hull.geometry.classical.linear_least_squares import linear_fit
from assoc_hull.geometry.classical.pieced_curve import (
    Formula,
    FormulaPiece,
    PiecedCurve,
    circle_piece,
    conic,
    conic_notes,
    cubic_conic,
)
from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = [
    "Quintic",
    "WaterlineRegion",
    "WaterlineRegions",
    "combined_waterline",
    "fit_quintic",
    "joined_pieces",
    "quintic_notes",
]

# --------------------------------------------------------------------------------------
# The quintic. With u from 0 to 1 and slopes by u (that by x times the length),
#
#     y = S(u) + q(u) (r0 + r1 (2u - 1) + ...),        q = u^2 (1 - u)^2,
#
# S is the cubic through both end values with both slopes, q and its multiples change neither. Where
# a slope is not given, its factor is of first order only, S is of a lower degree, and one more
# coefficient is free. What is printed as a4 u^2 (1-u)^2 + a5 u^2 (1-u)^2 (u+2), with the normal
# equations of a4 and a5, is the same space of polynomials in a basis of worse condition:
# a4 = r0 - 5 r1, a5 = 2 r1. Errors of print in the source, eqs 22 to 31: S has y1 u in place of the
# slope at 0 times u, and the last formula of a4 has a product of two sums where their difference
# belongs.

_SHAPES = ([1.0], [-1.0, 2.0], [1.0, -6.0, 6.0], [-1.0, 12.0, -30.0, 20.0])
"""Legendre's polynomials of 2u - 1 in ascending powers of u."""


@attrs.frozen(eq=False)
class Quintic:
    """A polynomial of degree five over u from 0 to 1.

    Attributes
    ----------
    coefficients : (6,), m
        Ascending powers of u.
    rms : float, m
        Root of the (weighted) mean square of the residuals.
    """

    coefficients: FloatArray
    rms: float

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients)

    def at(self, u: ArrayLike, order: int = 0) -> FloatArray:
        """Give values, or derivatives by u, in the shape of `u`; m.

        Raises
        ------
        GeometryError
            ``"quintic: u={u} outside [0,1]"``.
        """
        n = whole_number(order, "quintic: derivative of order", 0, 5)
        return np.asarray(polyval(_unit(u), polyder(self.coefficients, n)))


def fit_quintic(
    u: ArrayLike,
    y: ArrayLike,
    y0: float,
    y1: float,
    d0: float | None,
    d1: float | None,
    weights: ArrayLike | None = None,
) -> Quintic:
    """Fit a polynomial of degree five to data.

    Parameters
    ----------
    u : (n,)
        Places from 0 to 1.
    y : (n,), m
        Values there; approximated.
    y0, y1 : float, m
        Values at u = 0 and u = 1, interpolated.
    d0, d1 : float or None, m
        Slopes dy/du at both ends, kept: dy/dx times (x_end - x_start). None leaves a slope to
        the data, and wants one more of them.
    weights : (n,) or None
        Above 0; 1 if None.

    Returns
    -------
    Quintic

    Raises
    ------
    GeometryError
        ``"quintic: u={u} outside [0,1]"``, ``"quintic: needs 2 distinct interior u, got {k}"``
        (3 or 4 if slopes are not given), ``"quintic: rank-deficient (points too close
        together)"``, ``"quintic: weights must be positive"``.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.combined_waterline import fit_quintic
    >>> u, y = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85), (7.93, 7.58, 6.94, 6, 4.7, 2.95)
    >>> fit = fit_quintic(u, y, 8.0, 1.0, 0.0, -14.0)
    >>> float(fit.at(0.5).round(9)), round(fit.rms, 9)
    (6.351096452, 0.020009596)
    """
    at = _unit(numbers(u, "quintic", (None,)))
    values = numbers(y, "quintic", (len(at),))
    w = positive_weights(weights, len(at), "quintic")
    base, factor = _base(*_ends(y0, y1, d0, d1))
    count = 7 - len(factor)
    interior = len(np.unique(at[(at > 0.0) & (at < 1.0)]))
    if interior < count:
        raise GeometryError(
            f"quintic: needs {count} distinct interior u, got {interior}", "give more points",
            {"needed": count, "got": interior},
        )  # fmt: skip
    powers = np.zeros((6, count))
    for column, shape in zip(powers.T, _SHAPES, strict=False):
        product = np.convolve(factor, shape)
        column[: len(product)] = product
    vander = polyvander(at, 5)
    columns = polyval(at, factor)[:, None] * legvander(2.0 * at - 1.0, count - 1)
    fit = linear_fit(columns, values - vander @ base, w, "quintic")
    return Quintic(base + powers @ fit.coefficients, fit.rms)


def _unit(u: ArrayLike) -> FloatArray:
    found = number_array(u, "quintic")
    outside = found[(found < 0.0) | (found > 1.0)]
    if outside.size:
        first = float(outside.flat[0])
        what = f"quintic: u={digits(first)} outside [0,1]"
        raise GeometryError(what, "ask between the ends", {"u": first})
    return found


def _ends(
    y0: float, y1: float, d0: float | None, d1: float | None
) -> tuple[float, float, float | None, float | None]:
    first, last = (number(each, "quintic") for each in (y0, y1))
    slopes = (None if each is None else number(each, "quintic") for each in (d0, d1))
    return first, last, *slopes  # type: ignore[return-value]


def _base(
    y0: float, y1: float, d0: float | None, d1: float | None
) -> tuple[FloatArray, list[float]]:
    """Give S of the least degree with the ends as given, (6,), and q, which leaves them so."""
    rise = y1 - y0
    base = np.zeros(6)
    if d0 is None and d1 is None:
        base[:2], factor = (y0, rise), [0.0, 1.0, -1.0]
    elif d1 is None:
        assert d0 is not None
        base[:3], factor = (y0, d0, rise - d0), [0.0, 0.0, 1.0, -1.0]
    elif d0 is None:
        base[:3], factor = (y0, 2.0 * rise - d1, d1 - rise), [0.0, 1.0, -2.0, 1.0]
    else:
        base[:4] = y0, d0, 3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise
        factor = [0.0, 0.0, 1.0, -2.0, 1.0]
    return base, factor


# --------------------------------------------------------------------------------------
# A waterline of a straight part, a quintic and a conic. From the end of the parallel side x0 to the
# change x1 runs a quintic that begins in the direction of the side; from x1 to the end x2 a conic
# with an upright tangent at its end. With v = (x2 - x)/(x2 - x1), Y = y - A, Y1 = y1 - A and the
# slope s = dy/dv at v = 1 of the quintic,
#
#     Y^2 = b1 v + b2 v^2,    b1 = 2 (Y1^2 - Y1 s),    b2 = 2 Y1 s - Y1^2.
#
# The conic is an ellipse where s < Y1/2, a parabola where s = Y1/2, a hyperbola beyond, and for
# s = Y1 the straight line to the end. Value and slope agree at both joins, curvature does not: a
# cubic conic as the last piece makes it agree (eqs 32 to 44).


def quintic_notes(curve: Quintic) -> tuple[str, ...]:
    """Report where a quintic does not go one way only, by the extremes of its slope."""
    slope = polyder(curve.coefficients)
    turns = polyroots(np.trim_zeros(polyder(slope), "b")) if polyder(slope).any() else np.zeros(0)
    real = turns.real[(np.abs(turns.imag) < 1e-9) & (turns.real > 0.0) & (turns.real < 1.0)]
    u = np.concatenate([[0.0, 1.0], real])
    rise = polyval(u, slope)
    # The way from its first value to its last: values at u = 0 and 1.
    way = -1.0 if curve.coefficients.sum() <= curve.coefficients[0] else 1.0
    worst = int(np.argmin(way * rise))
    if way * rise[worst] >= -1e-12 * float(np.abs(curve.coefficients).max()):
        return ()
    told = f"dy/du = {rise[worst]:.4g} there"
    return (f"waterline: quintic is not monotone at u={u[worst]:.4g}; {told}.",)


def combined_waterline(
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
    >>> from assoc_hull.geometry.classical.combined_waterline import combined_waterline
    >>> given = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]
    >>> fore = combined_waterline(20, 60, 75, 12, 6.5, given)
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
        within_range(points[:, 0], "waterline", a, b)
    between = points[(points[:, 0] > a) & (points[:, 0] < b)]
    if len(np.unique(between[:, 0])) < 3:
        raise GeometryError(
            "waterline: fewer than 3 offsets in the quintic part", "give three or more",
            {"got": len(np.unique(between[:, 0]))},
        )  # fmt: skip
    u = (between[:, 0] - a) / (b - a)
    middle = fit_quintic(u, between[:, 1], top, change, rise * (b - a), None)
    body = FormulaPiece("quintic", a, b, middle.coefficients.copy())
    slope1, second = (float(body.at(b, order)) for order in (1, 2))
    if last == "conic":
        nose = conic(b, c, change, slope1, level)
    else:
        nose = cubic_conic(b, c, change, slope1, second, level)
    # The conic's slope is by v, which runs from the end toward the join: the sign changes.
    notes = quintic_notes(middle) + conic_notes(-slope1 * (c - b))
    straight = (
        FormulaPiece("line", begin, a, np.array([top + rise * (begin - a), rise * (a - begin)])),
    )
    return PiecedCurve.make((*(straight if begin < a else ()), body, nose), notes)


def _check_ranges(
    begin: float, x: tuple[float, float, float], y: tuple[float, float, float]
) -> None:
    if not x[0] < x[1] < x[2]:
        raise GeometryError(
            "waterline: need x0 < x1 < x2", f"x0, x1, x2 are {', '.join(map(digits, x))}",
            {"x0": x[0], "x1": x[1], "x2": x[2]},
        )  # fmt: skip
    if begin > x[0]:
        what = f"waterline: the straight part begins at x={digits(begin)}, after x0={digits(x[0])}"
        raise GeometryError(what, "let it begin before", {"start": begin, "x0": x[0]})
    if not 0.0 <= y[2] < y[1] <= y[0]:
        told = ", ".join(map(digits, (y[0], y[1], y[2])))
        what = f"waterline: half-breadths {told} at x0, x1, x2 do not fall"
        raise GeometryError(what, "need y0 >= y1 > A >= 0", {"y0": y[0], "y1": y[1], "end": y[2]})


# --------------------------------------------------------------------------------------
# Regions. Boundary curves (flat of side, beginning of the conic, stem ...) are drawn in the side
# plan as x over z, straight from point to point. On a waterline z they are evaluated and put in
# order; the formula of the region between neighbours makes the piece there. Where two boundaries
# coincide, the region between them has no length and its piece is dropped.

_COINCIDE = 1e-9
"""Boundaries nearer than this, in parts of the extent of all, are one."""


@attrs.frozen
class WaterlineRegion:
    """What lies between two boundary curves on one waterline.

    Attributes
    ----------
    after, before : str
        The boundary where it begins, and the one where it ends.
    formula : str
        Of its piece.
    first, last : float, m
        The range in x.
    """

    after: str
    before: str
    formula: Formula
    first: float
    last: float


@attrs.frozen(eq=False)
class WaterlineRegions:
    """Boundary curves and the formulas between them.

    Attributes
    ----------
    boundaries : mapping of str to (n, 2), m
        z and x of the points of each boundary, z rising.
    formulas : mapping of (str, str) to str
        "line", "quintic", "conic", "cubic conic" or "circle" between neighbours.
    """

    boundaries: Mapping[str, FloatArray]
    formulas: Mapping[tuple[str, str], Formula]

    def __attrs_post_init__(self) -> None:
        freeze(*self.boundaries.values())

    @classmethod
    def make(
        cls,
        boundaries: Mapping[str, ArrayLike],
        formulas: Mapping[tuple[str, str], Formula],
    ) -> Self:
        """Check boundaries and formulas; arguments as the attributes.

        Raises
        ------
        GeometryError
            ``"regions: boundaries {a} and {b} cross at z={z}"``; fewer than two boundaries,
            points whose z does not rise, a formula that is none or of boundaries that are not
            there.

        Examples
        --------
        >>> from assoc_hull.geometry.classical.combined_waterline import WaterlineRegions
        >>> flat, end = [(0, 30), (5, 42), (10, 50)], [(0, 70), (5, 73), (10, 78)]
        >>> regions = WaterlineRegions.make(
        ...     {"flat": flat, "end": end}, {("flat", "end"): "quintic"}
        ... )
        >>> {name: round(x, 6) for name, x in regions.places(6.5).items()}
        {'flat': 44.4, 'end': 74.5}
        """
        checked_mapping(boundaries, "regions: boundaries")
        checked_mapping(formulas, "regions: formulas")
        lines = {str(name): _polyline(str(name), given) for name, given in boundaries.items()}
        if len(lines) < 2:
            raise GeometryError(f"regions: {len(lines)} boundaries", "give two or more")
        for pair, formula in formulas.items():
            one_of(formula, tuple(get_args(Formula)), "regions: no formula is called")
            if pair not in product(lines, lines):
                what = f"regions: no two boundaries are called {pair!s:.60}"
                raise GeometryError(what, f"there are {', '.join(lines)}")
        found = cls(lines, dict(formulas))
        for one, other in combinations(lines, 2):
            found._check_crossing(one, other)
        return found

    @property
    def tolerance(self) -> float:
        """Boundaries nearer than this coincide, m."""
        points = np.concatenate(list(self.boundaries.values()))
        return _COINCIDE * float(np.hypot(*np.ptp(points, axis=0)))

    def places(self, z: float) -> dict[str, float]:
        """Give x of each boundary on a waterline, m, in order of x.

        Raises
        ------
        GeometryError
            ``"regions: boundary {a} does not reach z={z}"``.
        """
        level = number(z, "regions")
        found = dict[str, float]()
        for name, line in self.boundaries.items():
            if not line[0, 0] <= level <= line[-1, 0]:
                raise GeometryError(
                    f"regions: boundary {name} does not reach z={digits(level)}",
                    f"it runs from z={digits(line[0, 0])} to z={digits(line[-1, 0])}",
                    {"boundary": name, "z": level},
                )  # fmt: skip
            found[name] = float(np.interp(level, line[:, 0], line[:, 1]))
        return dict(sorted(found.items(), key=lambda item: item[1]))

    def at(self, z: float) -> tuple[WaterlineRegion, ...]:
        """Give the regions of a waterline in order of x, without those of no length.

        Raises
        ------
        GeometryError
            ``"regions: boundary {a} does not reach z={z}"``,
            ``"regions: no formula for region {r}"``.
        """
        joints = list[tuple[float, list[str]]]()
        for name, x in self.places(z).items():
            if joints and x - joints[-1][0] <= self.tolerance:
                joints[-1][1].append(name)
            else:
                joints.append((x, [name]))
        return tuple(self._region(*pair) for pair in pairwise(joints))

    def _region(
        self, low: tuple[float, list[str]], high: tuple[float, list[str]]
    ) -> WaterlineRegion:
        """Give the region between two joints, each of the boundaries that coincide there."""
        for after, before in product(reversed(low[1]), high[1]):
            if (after, before) in self.formulas:
                return WaterlineRegion(after, before, self.formulas[after, before], low[0], high[0])
        region = f"{low[1][-1]} to {high[1][0]}"
        raise GeometryError(
            f"regions: no formula for region {region}", "give one", {"region": region}
        )

    def _check_crossing(self, one: str, other: str) -> None:
        """Refuse two boundaries that change places; between points both are straight."""
        a, b = self.boundaries[one], self.boundaries[other]
        low, high = max(a[0, 0], b[0, 0]), min(a[-1, 0], b[-1, 0])
        if low > high:
            return
        z = np.union1d(a[:, 0], b[:, 0])
        z = np.union1d(z[(z >= low) & (z <= high)], [low, high])
        ahead = np.interp(z, b[:, 0], b[:, 1]) - np.interp(z, a[:, 0], a[:, 1])
        # Boundaries may touch: only a change of sign beyond the touch is a crossing.
        ahead[np.abs(ahead) <= self.tolerance] = 0.0
        sides = np.flatnonzero(ahead)
        for k, m in pairwise(sides.tolist()):
            if ahead[k] * ahead[m] < 0.0:
                far = ahead[k] / (ahead[k] - ahead[m])
                place = float(z[k] + far * (z[m] - z[k])) if m == k + 1 else float(z[k + 1])
                raise GeometryError(
                    f"regions: boundaries {one} and {other} cross at z={digits(place)}",
                    "draw them so that they keep their order",
                    {"boundaries": (one, other), "z": place},
                )  # fmt: skip


def _polyline(name: str, given: ArrayLike) -> FloatArray:
    points = numbers(given, f"regions: boundary {name}", (None, 2))
    if len(points) < 2:
        raise GeometryError(f"regions: boundary {name} has {len(points)} points", "give two")
    falls = np.flatnonzero(np.diff(points[:, 0]) <= 0.0)
    if len(falls):
        z = float(points[falls[0] + 1, 0])
        what = f"regions: z of boundary {name} does not rise at z={digits(z)}"
        raise GeometryError(what, "give points from below upward", {"z": z})
    return points


# --------------------------------------------------------------------------------------
# The pieces of a waterline through its regions, each going on from the one before it. A *line* runs
# straight between the half-breadths at its boundaries; a *quintic* begins with the slope of the
# piece before it, ends with that of a line after it, and takes what is left from offsets; a
# *circle* goes on tangentially to its end; a *conic* goes on with value and slope, a *cubic conic*
# with the second derivative too, and both stand upright at their end. The first piece goes on from
# a parallel side: level and straight. In the source a circle is written with abscissae from 0 to 1,
# which makes it an ellipse in true lengths; here abscissae are true.


def joined_pieces(
    regions: Sequence[WaterlineRegion], heights: Mapping[str, float], offsets: ArrayLike
) -> PiecedCurve:
    """Make the waterline through regions.

    Parameters
    ----------
    regions : sequence of WaterlineRegion
        Of one waterline, in order of x (`WaterlineRegions.at`).
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
    >>> from assoc_hull.geometry.classical.combined_waterline import joined_pieces
    >>> from assoc_hull.geometry.classical.combined_waterline import WaterlineRegion
    >>> regions = [
    ...     WaterlineRegion("flat", "change", "quintic", 20.0, 60.0),
    ...     WaterlineRegion("change", "end", "conic", 60.0, 75.0),
    ... ]
    >>> given = [(24, 11.97), (30, 11.72), (36, 11.2), (42, 10.4), (48, 9.3), (54, 8)]
    >>> curve = joined_pieces(regions, {"flat": 12.0, "change": 6.5, "end": 0.0}, given)
    >>> [piece.formula for piece in curve.pieces]
    ['quintic', 'conic']
    """
    points = numbers(offsets, "regions", (None, 2))
    checked_mapping(heights, "regions: half-breadths")
    chain = checked_list(regions, "regions")
    for each in chain:
        if not isinstance(each, WaterlineRegion):
            raise GeometryError(f"regions: {argument_text(each)}", "give those of `Regions.at`")
    notes, pieces = list[str](), list[FormulaPiece]()
    for k, region in enumerate(chain):
        ends = _height(heights, region.after), _height(heights, region.before)
        after = chain[k + 1] if k + 1 < len(chain) else None
        before = pieces[-1] if pieces else None
        if region.formula == "quintic":
            piece, told = _quintic_piece(region, ends, before, _next_slope(after, heights), points)
            notes += told
        else:
            piece = _formula_piece(region, ends, before, after)
            if piece.formula == "conic":
                slope = float(pieces[-1].at(region.first, 1))
                notes += conic_notes(-slope * (region.last - region.first))
        pieces.append(piece)
    return PiecedCurve.make(tuple(pieces), tuple(notes))


def _height(heights: Mapping[str, float], name: str) -> float:
    if name not in heights:
        raise GeometryError(f"regions: no half-breadth on boundary {name}", "give one")
    return number(heights[name], f"regions: boundary {name}")


def _next_slope(after: WaterlineRegion | None, heights: Mapping[str, float]) -> float | None:
    """Give the slope that the piece after asks for: a line has its own."""
    if after is None or after.formula != "line":
        return None
    rise = _height(heights, after.before) - _height(heights, after.after)
    return rise / (after.last - after.first)


def _quintic_piece(
    region: WaterlineRegion,
    ends: tuple[float, float],
    before: FormulaPiece | None,
    end_slope: float | None,
    points: FloatArray,
) -> tuple[FormulaPiece, tuple[str, ...]]:
    length = region.last - region.first
    mine = points[(points[:, 0] > region.first) & (points[:, 0] < region.last)]
    # The parallel side lies before the first piece: that begins level.
    start = 0.0 if before is None else float(before.at(region.first, 1))
    finish = None if end_slope is None else end_slope * length
    fit = fit_quintic(
        (mine[:, 0] - region.first) / length, mine[:, 1], *ends, start * length, finish
    )
    piece = FormulaPiece("quintic", region.first, region.last, fit.coefficients.copy())
    return piece, quintic_notes(fit)


def _formula_piece(
    region: WaterlineRegion,
    ends: tuple[float, float],
    before: FormulaPiece | None,
    after: WaterlineRegion | None,
) -> FormulaPiece:
    first, last = region.first, region.last
    if region.formula == "line":
        return FormulaPiece("line", first, last, np.array([ends[0], ends[1] - ends[0]]))
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
