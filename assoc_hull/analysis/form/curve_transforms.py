"""Chebyshev, sine and Fourier coefficients of curves of a hull.

Source: H.J. Son, H.C. Kim, "hull form parameter modules for performance analysis", J. of CAD/CAM
(Korea) 13(6), 2008; see `assoc_hull.geometry.integrals.transforms` for the series themselves.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from assoc_hull.analysis.form.line_chains import AXES, Span
from assoc_hull.analysis.form.transform_record import KINDS, CurveTransform, Kind
from assoc_hull.analysis.form.transform_sources import AREAS, of_areas, of_line, of_loop
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, state_of
from assoc_hull.arguments import choice, flag, number, pair, shown
from assoc_hull.errors import BadInputError, ForeignPointError, WrongTypeError
from assoc_hull.geometry.integrals.transforms import checked_terms
from assoc_hull.model.curve import Curve
from assoc_hull.model.handles import handle
from assoc_hull.model.line import Line
from assoc_hull.model.state import HullState

__all__ = ["curve_transform"]

_WHERE = "in a transform"
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

    Parameters
    ----------
    hull : Hull
        The hull.
    curve : Line, Curve or str
        A line, one of its curves, the address of either, or ``"sectional areas"``.
    kind : "chebyshev", "sine" or "fourier"
        Chebyshev or half-range sine series of an ordinate over an abscissa; or Fourier
        descriptors of a section, or of a line seen from above, closed with its mirror image.
    terms : int
        Number of coefficients; of Fourier descriptors, harmonics to each side.
    along, across : "x", "y" or "z"
        Abscissa and ordinate. By default half breadth over x; of a section half breadth over z,
        of a buttock z over x. Fourier descriptors take y as one of the two.
    span : (float, float), "perpendiculars" or None, m
        Range of the abscissa: between two places, from AP to FP, or the whole curve (the wetted
        length, of sectional areas). Beyond the curve the ordinate is nil. Of Fourier
        descriptors, range of the coordinate that is not y.
    relative : bool or None
        Divide by the largest ordinate; None does so for sectional areas only.
    draught, draughts, heel_deg
        The floating position of sectional areas, as in `hydrostatics`.

    Returns
    -------
    CurveTransform
        The coefficients and what they leave out.

    Raises
    ------
    BadInputError
        A curve that is not single-valued in the abscissa or has gaps; a number that cannot be
        used.
    OutOfRangeError
        A position in which the hull does not float.
    UnknownNameError
        No line has this address.

    Examples
    --------
    >>> from assoc_hull.analysis.form.curve_transforms import curve_transform
    >>> from assoc_hull.sources import examples
    >>> hull = examples.wigley()
    >>> found = curve_transform(hull, "sectional areas", terms=3)  # A / Amax = 1 - xi^2
    >>> (found.coefficients + 0.0).round(3).tolist()
    [0.5, 0.0, -0.5]
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
    if found.tables is not state:
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
