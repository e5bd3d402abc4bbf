"""Chebyshev, sine and Fourier coefficients of curves of a hull, which are chains in a plane.

A curve is one coordinate of a line over another, a line closed with its mirror image, or the
sectional areas over x. A `CurveTransform` holds the series and what it leaves out; abscissas map to
xi = -1 ... 1 over the range. `assoc_hull.geometry.integrals.series` has the series themselves.

Source: H.J. Son, H.C. Kim, J. of CAD/CAM (Korea) 13(6), 2008 ("hull form parameter modules for
performance analysis").

Lines of a hull as chains in a plane: a function of one coordinate, or a closed curve.

What cannot be either is refused, with the place where it fails.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Literal

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.analysis.hydrostatics.floating_body import require_afloat
from assoc_hull.analysis.hydrostatics.flotation import flotation, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import position_of
from assoc_hull.analysis.hydrostatics.record import SALT
from assoc_hull.analysis.hydrostatics.section_areas import area_curve
from assoc_hull.arguments import (
    choice,
    flag,
    integer,
    number,
    numbers,
    pair,
    shown,
)
from assoc_hull.errors import BadInputError, ForeignPointError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.integrals.chains import (
    PlaneChains,
    chain_ends,
    closed_loop,
    cut_chain,
    join_chains,
    reversed_chain,
    straight_chain,
)
from assoc_hull.geometry.integrals.series import (
    ComplexArray,
    Series,
    Truncation,
    chebyshev_of_chains,
    chebyshev_of_function,
    checked_terms,
    composite_rule,
    descriptor_truncation,
    evaluate_descriptors,
    evaluate_series,
    fourier_descriptors,
    function_samples,
    length_of_chains,
    piece_edges,
    rule_on_pieces,
    sine_of_chains,
    sine_of_function,
    truncation,
)
from assoc_hull.geometry.numeric.polynomials import differentiate, horner, unit_roots
from assoc_hull.model.objects import Curve, Line, handle
from assoc_hull.model.tables import HasState, HullState, state_of

__all__ = [
    "AREAS",
    "AXES",
    "KINDS",
    "CurveTransform",
    "Kind",
    "Span",
    "closed_chain",
    "curve_transform",
    "function_chain",
    "of_areas",
    "of_line",
    "of_loop",
]

AXES = "xyz"

Span = tuple[float, float] | None

_MEET = 1e-6
"""By this part of the range neighbours may miss each other, and a curve may run back."""


def function_chain(
    curves: Sequence[Curve], axes: tuple[int, int], span: Span, name: str
) -> PlaneChains:
    """Give one coordinate of curves over another.

    Parameters
    ----------
    curves : sequence of Curve
        Which together make the function.
    axes : (int, int)
        Abscissa and ordinate: 0 for x, 1 for y, 2 for z.
    span : (float, float) or None, m
        Range of the abscissa; that of the curves if None. Beyond their ends the function is nil.
    name : str
        For messages.

    Returns
    -------
    PlaneChains
        One chain, its abscissa rising from end to end of the range.

    Raises
    ------
    BadInputError
        The curves are not single-valued in the abscissa, leave a gap, or lie outside the range.
    """
    runs = _in_order(curves, axes, along=0)
    if span is not None:
        runs = [part for run in runs for part in cut_chain(run, 0, *span)]
    runs = [run for run in runs if np.abs(run[:, 1:]).max(initial=0.0) > 0.0]
    where, axis = f"in a transform of {name}", AXES[axes[0]]
    ends = [chain_ends(run)[side][0] for run in runs for side in (0, 1)]
    if not runs or max(ends) <= min(ends):
        what = f"it has no extent along {axis}" + (" in the span" if span else "")
        raise BadInputError(what, where, "choose another abscissa or span")
    size = max(ends) - min(ends) if span is None else span[1] - span[0]
    _refuse_gaps(runs, _MEET * size, axis, where)
    whole = join_chains(runs)
    _refuse_return(whole, _MEET * size, axis, where)
    return PlaneChains.single(whole if span is None else _filled(whole, span))


def closed_chain(
    curves: Sequence[Curve], axes: tuple[int, int], mirror: int, span: Span, name: str
) -> PlaneChains:
    """Give curves closed with their mirror image.

    Parameters
    ----------
    curves : sequence of Curve
        One side, which end to end make one curve.
    axes : (int, int)
        The two coordinates: 0 for x, 1 for y, 2 for z.
    mirror : int
        Which of the two changes sign on the other side, 0 or 1.
    span : (float, float) or None, m
        Range of the other one to which the curve is cut; straight lines close what is cut.
    name : str
        For messages.

    Returns
    -------
    PlaneChains
        One closed chain, counter-clockwise, from a place in the mirror.

    Raises
    ------
    BadInputError
        The curves leave a gap, or lie outside the range.
    """
    other = 1 - mirror
    runs = _in_order(curves, axes, along=other)
    where = f"in a transform of {name}"
    places = np.concatenate([run[:, 0] for run in runs])
    size = float(np.ptp(places, axis=0).max())
    for one, next_ in pairwise(runs):
        gap = np.abs(chain_ends(one)[1] - chain_ends(next_)[0]).max()
        if gap > _MEET * size:
            what = f"its curves lie {gap:.3g} m apart"
            raise BadInputError(what, where, "take one of its curves")
    whole = join_chains(runs)
    if span is not None:
        whole = join_chains(cut_chain(whole, other, *span))
    if not len(whole):
        raise BadInputError("it does not reach into the span", where, "choose another span")
    return PlaneChains.single(closed_loop(whole, mirror))


def _in_order(curves: Sequence[Curve], axes: tuple[int, int], along: int) -> list[FloatArray]:
    """Give the curves as chains, each forward along a coordinate, and one after the other."""
    found = []
    for curve in curves:
        chain = PlaneChains.of(curve.spline, axes).cubic
        first, last = chain_ends(chain)
        found.append(chain if first[along] <= last[along] else reversed_chain(chain))
    return sorted(found, key=lambda chain: float(sum(end[along] for end in chain_ends(chain))))


def _refuse_gaps(runs: Sequence[FloatArray], allowed: float, axis: str, where: str) -> None:
    for one, next_ in pairwise(runs):
        low, high = float(chain_ends(one)[1][0]), float(chain_ends(next_)[0][0])
        if high - low > allowed:
            what = f"it has no curve from {axis} {low:.6g} to {high:.6g} m"
            raise BadInputError(what, where, "take one of its curves, or a span beside the gap")


def _refuse_return(chain: FloatArray, allowed: float, axis: str, where: str) -> None:
    """Refuse a chain whose abscissa runs back: there it has several values."""
    end = np.ones((len(chain), 1))
    turns = unit_roots(differentiate(chain[:, :, 0]))
    u = horner(chain[:, :, 0], np.concatenate([0.0 * end, turns, end], axis=1)).ravel()
    back = np.maximum.accumulate(u) - u
    worst = int(back.argmax())
    if back[worst] > allowed:
        what = f"it runs back by {back[worst]:.3g} m near {axis} {u[worst]:.6g} m"
        remedy = (
            f"it is no function of {axis}: choose another abscissa, or a span beside that place"
        )
        raise BadInputError(what, where, remedy)


def _filled(chain: FloatArray, span: tuple[float, float]) -> FloatArray:
    """Lead a chain to both ends of the range, nil where there was no curve."""
    first, last = chain_ends(chain)
    parts = [chain]
    for place, end, after in ((first, span[0], False), (last, span[1], True)):
        if abs(place[0] - end) > _MEET * (span[1] - span[0]):
            gap = [np.array([end, 0.0]), np.array([place[0], 0.0])]
            line = straight_chain(*(gap[::-1] if after else gap))
            parts = [*parts, line] if after else [line, *parts]
    return join_chains(parts)


# --------------------------------------------------------------------------------------
# The result.

Kind = Literal["chebyshev", "sine", "fourier"]
KINDS = ("chebyshev", "sine", "fourier")


@attrs.frozen(eq=False)
class CurveTransform:
    """A curve as a series.

    Attributes
    ----------
    kind : "chebyshev", "sine" or "fourier"
        Which series.
    name : str
        Of the curve.
    along, across : str
        Abscissa and ordinate, or the real and the imaginary part: x, y, z, or A for areas.
    low, high : float, m
        Range of the abscissa: xi = -1 and 1; of Fourier descriptors, 0 and the length around.
    unit : float
        By what ordinates are divided: 1 (m or m2), or the largest of them (none).
    coefficients : (terms,), or (2 terms + 1,) complex
        From c_0, or from b_1; of Fourier descriptors (m), X_k with k from -terms to terms.
    position : str
        Where the hull floats, for sectional areas; else empty.
    truncation : Truncation
        What is left after 1, 2, ... terms or pairs of harmonics, over `unit` too.
    places : (q, 2)
        The curve itself, for pictures: abscissa (m) and ordinate over `unit`.
    """

    kind: Kind
    name: str
    along: str
    across: str
    low: float
    high: float
    unit: float
    coefficients: FloatArray | ComplexArray
    position: str
    truncation: Truncation
    places: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.coefficients, self.places)

    @property
    def terms(self) -> int:
        """Terms of the series, or harmonics to each side."""
        return len(self.truncation.rms)

    @property
    def orders(self) -> tuple[int, ...]:
        """The k of each coefficient."""
        first = {"chebyshev": 0, "sine": 1, "fourier": -self.terms}[self.kind]
        return tuple(range(first, first + len(self.coefficients)))

    def evaluate(self, at: ArrayLike, terms: int | None = None) -> FloatArray:
        """Add up the series.

        Parameters
        ----------
        at : float or (k,), m
            Abscissas; of Fourier descriptors, the length from where the curve begins.
        terms : int or None
            With the first so many terms, or harmonics to each side; all if None.

        Returns
        -------
        (k,), over `unit`, or (k, 2), m
            The ordinates, or the places.

        Raises
        ------
        BadInputError
            A place outside the range, or more terms than there are.
        """
        where = f"in the series of {self.name}"
        place = np.atleast_1d(numbers(at, "at", where))
        xi = 2.0 * (place - self.low) / (self.high - self.low) - 1.0
        if not (np.abs(xi) <= 1.0 + 1e-9).all():
            what = f"a place outside {self.low:.6g} to {self.high:.6g} m"
            raise BadInputError(what, where, "give places of the range")
        most = self.terms
        count = most if terms is None else integer(terms, "terms", where, least=1, most=most)
        if self.kind == "fourier":
            kept = np.asarray(self.coefficients[most - count : most + count + 1], np.complex128)
            return evaluate_descriptors(kept, 0.5 * (xi + 1.0))
        series = np.real(self.coefficients[:count])
        return evaluate_series(self.kind, series, np.clip(xi, -1.0, 1.0))


# --------------------------------------------------------------------------------------
# The three kinds of curve.

AREAS = "sectional areas"
"""Stands for the sectional-area curve where a line is asked for."""

_WHERE = "in a transform"
_NEAR = 1e-8  # of the largest section area: surfaces are cut to about this
_TERMS: dict[str, object] = {
    "rho": SALT, "shell_factor": 1.0, "appendages": (), "fingerprint": ""
}  # fmt: skip
"""What a header asks for and areas do not depend on."""


def _curves(line: Line | Curve) -> tuple[Curve, ...]:
    return line.curves if isinstance(line, Line) else (line,)


def of_line(
    line: Line | Curve,
    kind: Series,
    terms: int,
    axes: tuple[int, int],
    span: Span,
    relative: bool,
) -> CurveTransform:
    """Expand one coordinate of a line over another."""
    chain = function_chain(_curves(line), axes, span, line.name)
    low, high = chain.ends[0, :, 0].tolist()
    xi, v, weights = function_samples(chain)
    unit = float(np.abs(v).max()) if relative else 1.0
    if unit == 0.0:
        what = f"{AXES[axes[1]]} is nil all along {line.name}"
        raise BadInputError(what, _WHERE, "choose another ordinate, or leave relative out")
    make = chebyshev_of_chains if kind == "chebyshev" else sine_of_chains
    series = make(chain, terms)[0] / unit
    rest = truncation(kind, series, xi, v / unit, weights)
    places = np.stack([low + 0.5 * (high - low) * (xi + 1.0), v / unit], axis=1)
    names = AXES[axes[0]], AXES[axes[1]]
    return CurveTransform(kind, line.name, *names, low, high, unit, series, "", rest, places)


def of_loop(
    line: Line | Curve,
    terms: int,
    axes: tuple[int, int],
    span: Span,
    relative: bool,
) -> CurveTransform:
    """Expand a line, closed with its mirror image, over its length."""
    if relative:
        what = "Fourier descriptors are asked relative to the largest ordinate"
        raise BadInputError(what, _WHERE, "divide them by |X_1|, say, to be free of the size")
    chain = closed_chain(_curves(line), axes, axes.index(1), span, line.name)
    found = fourier_descriptors(chain, terms)[0]
    rest = descriptor_truncation(chain, found)
    names = AXES[axes[0]], AXES[axes[1]]
    places = _around(chain)
    length = float(length_of_chains(chain)[0])
    return CurveTransform("fourier", line.name, *names, 0.0, length, 1.0, found, "", rest, places)


def _around(chain: PlaneChains) -> FloatArray:
    """Give places once around a closed chain, (q, 2), m."""
    return np.asarray(chain.at(np.linspace(0.0, 1.0, 17))).reshape(-1, 2)


def of_areas(
    hull: HasState,
    kind: Series,
    terms: int,
    span: Span,
    relative: bool,
    where: tuple[float | None, tuple[float, float] | None, float],
) -> CurveTransform:
    """Expand the areas of sections over x."""
    body = flotation(state_of(hull))
    header = header_of(hull, body, _TERMS)
    position = position_of(header, *where, "moulded")
    curve = area_curve(body, require_afloat([position], body.limits, header.length))
    low, high = (curve.low, curve.high) if span is None else span
    unit = curve.largest if relative else 1.0
    places = np.concatenate([[curve.low], curve.breaks, [curve.high]])
    breaks = 2.0 * (places[(places > low) & (places < high)] - low) / (high - low) - 1.0

    def values(xi: FloatArray) -> FloatArray:
        return curve.at(low + 0.5 * (high - low) * (xi + 1.0)) / unit

    make = chebyshev_of_function if kind == "chebyshev" else sine_of_function
    series = make(values, terms, breaks, _NEAR)
    xi, weights = rule_on_pieces(piece_edges(breaks), *composite_rule(1))
    y = values(xi)
    drawn = np.stack([low + 0.5 * (high - low) * (xi + 1.0), y], axis=1)
    rest = truncation(kind, series, xi, y, weights)
    at = str(position)
    return CurveTransform(kind, AREAS, "x", "A", low, high, unit, series, at, rest, drawn)


# --------------------------------------------------------------------------------------
# Choosing curve, series and axes.

_FUNCTIONS = {0: (2, 1), 1: (0, 2), 2: (0, 1)}  # from a line's plane: abscissa, ordinate
_CLOSED = {0: (1, 2), 2: (0, 1)}


def curve_transform(
    hull: HasState,
    curve: Line | Curve | str,
    kind: Kind = "chebyshev",
    terms: int = 12,
    *,
    along: str | None = None,
    across: str | None = None,
    span: tuple[float, float] | Literal["perpendiculars"] | None = None,
    relative: bool | None = None,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    heel_deg: float = 0.0,
) -> CurveTransform:
    """Give the coefficients of a curve of a hull as a series.

    The arguments and what is raised are those of `Hull.curve_transform`.
    """
    state = state_of(hull)
    which = _checked_kind(kind)
    count = checked_terms(terms)
    range_ = _span(span, state)
    heel = number(heel_deg, "heel_deg", _WHERE)
    by_largest = None if relative is None else flag(relative, "relative", _WHERE)
    if isinstance(curve, str) and curve == AREAS:
        if which == "fourier" or along is not None or across is not None:
            what = "Fourier descriptors or axes are asked of sectional areas"
            raise BadInputError(what, _WHERE, "take kind 'chebyshev' or 'sine', and no axes")
        return of_areas(
            hull, which, count, range_, by_largest is not False, (draught, draughts, heel)
        )
    if draught is not None or draughts is not None or heel != 0.0:
        what = "a floating position is given with a line"
        raise BadInputError(what, _WHERE, f"give a span, or take {AREAS!r}")
    line = _line(state, curve)
    axes = _axes(line, along, across, closed=which == "fourier")
    if which == "fourier":
        return of_loop(line, count, axes, range_, bool(by_largest))
    return of_line(line, which, count, axes, range_, bool(by_largest))


def _checked_kind(kind: object) -> Kind:
    found = choice(kind, "kind", KINDS, _WHERE)
    return "chebyshev" if found == "chebyshev" else "sine" if found == "sine" else "fourier"


def _span(span: object, state: HullState) -> Span:
    if isinstance(span, str):
        choice(span, "span", ("perpendiculars",), _WHERE)
        return 0.0, state.particulars.length
    return None if span is None else pair(span, "span", _WHERE, positive=False)


def _line(state: HullState, curve: object) -> Line | Curve:
    found = handle(state, curve) if isinstance(curve, str) else curve
    if not isinstance(found, Line | Curve):
        what = f"the curve is {shown(curve)}"
        raise WrongTypeError(what, _WHERE, f"give a Line, a Curve, an address or {AREAS!r}")
    if found.home is not state.live_tables:
        raise ForeignPointError(repr(found))
    return found


def _axes(line: Line | Curve, along: object, across: object, closed: bool) -> tuple[int, int]:
    """Give abscissa and ordinate; those that suit the plane of the line, where none are given."""
    plane = (line if isinstance(line, Line) else line.line).plane
    normal = 2 if plane is None else int(np.abs(plane.normal).argmax())
    usual = _CLOSED.get(normal, (0, 2)) if closed else _FUNCTIONS[normal]
    given = [
        None if each is None else AXES.index(choice(each, word, AXES, _WHERE))
        for each, word in ((along, "along"), (across, "across"))
    ]
    if given[0] is not None and given[0] == given[1]:
        raise BadInputError(f"along and across are both {along}", _WHERE, "give two axes")
    u = given[0] if given[0] is not None else _free(usual, given[1])
    v = given[1] if given[1] is not None else _free(usual[::-1], u)
    if closed and 1 not in (u, v):
        what = f"{line.name} has no mirror image in {AXES[u]} and {AXES[v]}"
        raise BadInputError(what, _WHERE, "take a section or a waterline, or another kind")
    return u, v


def _free(usual: tuple[int, int], taken: int | None) -> int:
    """Give the first of two axes, or the second if the first is taken."""
    return usual[1] if usual[0] == taken else usual[0]
