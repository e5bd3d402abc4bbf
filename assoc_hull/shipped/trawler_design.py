"""Stern trawlers from six numbers: a straight keel, rise of floor, a counter abaft AP, flared bow.

Curve of areas and waterline are drawn for each ship, level to the third order at one place, where
the largest section stands; they end abaft AP, and s goes from -1 there to 1 at FP. With areas a,
half-breadths b and depths t in parts of the largest, the fullness of a section is

    sigma = CM a / (t b)

On the straight keel t is 1 and sigma follows; beyond it sigma goes to 1/2 at both ends, where
sections are triangles that shrink, and t follows. So keel and contour join with their curvature.

Examples
--------
>>> from assoc_hull.shipped.trawler_design import trawler_design
>>> trawler_design().particulars.breadth
9.5
"""

from __future__ import annotations

import math

import attrs
import numpy as np
from numpy.polynomial import Polynomial
from scipy.interpolate import BPoly, CubicSpline

from assoc_hull.creation.design import Design
from assoc_hull.creation.fairest_halves import fitted_halves, halves_of, level_polynomial
from assoc_hull.creation.form_definitions import course
from assoc_hull.creation.six_numbers import DesignNote, SixNumbers, TypedDesign
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.tables import Particulars
from assoc_hull.shipped.yacht_design import (
    contour_of,
    drawn_design,
    drawn_particulars,
    section_courses,
    section_values,
)

__all__ = ["draw_trawler", "trawler_design"]

_CALL = "in a trawler from six numbers"


def trawler_design() -> Design:
    """Give the design of a stern trawler of 40 m, CB .56, LCB 2 % abaft midship.

    Returns
    -------
    Design
    """
    return draw_trawler(SixNumbers(40.0, 9.5, 4.0, 6.0, 0.56, -0.8)).design


def draw_trawler(
    six: SixNumbers, cm: float | None = None, cw: float | None = None, name: str | None = None
) -> TypedDesign:
    """Draw a trawler with its notes; `length` is that between perpendiculars.

    Raises BadInputError where no fair lines have these numbers.
    """
    ship = drawn_particulars("Trawler", six, name)
    made = _halves(ship, six, cm, cw)
    shape = _shape(ship, made)
    profile = _profile(ship, shape)
    forms = Forms.of([made.areas, made.line, profile], ship)
    rest = [*_deck(ship, profile), *_courses(ship, profile, forms, shape)]
    design = drawn_design(ship, [made.areas, made.line, profile, *rest], _stations(ship, profile))
    given = tuple(n for n, value in (("CM", cm), ("CW", cw)) if value is not None)
    return TypedDesign(design, _notes(ship, made, design, given), cw is not None, drawn=True)


# --------------------------------------------------------------------------------------
# Coefficients, curve of areas, waterline.

_CB, _CM, _CW = 0.5, 0.82, 0.71
"""CM and CW at the finest CB; both rise by .6 of what CB does."""

_AFT = 0.04
"""How far the waterline goes abaft AP, in parts of the length."""

_STEM_AT_WATER, _FINEST, _BLUNTEST = 55.0, 0.9, 1.7
"""Angle of the stem at the waterline that is aimed at, deg, by the slope of the waterline at FP,
which stays between these, in the frame of the waterline."""

_BENT = (6.0, 20.0)
"""Second derivative of the curve of areas at FP, in the same frame, at least and at most."""


@attrs.frozen
class _Halves:
    """What was chosen, and the curves that came of it; `entry` in deg."""

    areas: FormDefinition
    line: FormDefinition
    cm: float
    entry: float


def _halves(ship: Particulars, six: SixNumbers, cm: float | None, cw: float | None) -> _Halves:
    cm = _CM + 0.6 * (six.cb - _CB) if cm is None else cm
    cw = _CW + 0.6 * (six.cb - _CB) if cw is None else cw
    share = 1.0 + _AFT
    mean, centre = six.cb / cm / share, 2.0 * (six.lcb / six.length + 0.5 + _AFT) / share - 1.0
    areas, peak = level_polynomial(2, mean, centre, {})
    free = float(areas.deriv(2)(1.0))
    bent = min(max(free, _BENT[0]), _BENT[1])
    if bent != free:
        areas, peak = level_polynomial(2, mean, centre, {(1.0, 2): bent})
    # a'' = b' t' / CM at FP, where sections are triangles.
    steep = math.tan(math.radians(_STEM_AT_WATER)) * 0.5 * share * ship.length / ship.draught
    fine = min(max(cm * bent / steep, _FINEST), _BLUNTEST)
    # With its maximum where the areas have theirs, no section beside it is fuller than it.
    line = level_polynomial(1, cw / share, None, {(1.0, 1): -fine}, peak)[0]
    full = cm * ship.breadth * ship.draught
    return _Halves(
        _in_ship(areas, peak, "sectional areas", "sectional_area", full),
        _in_ship(line, peak, "design waterline", "design_waterline", 0.5 * ship.breadth),
        cm, math.degrees(math.atan(fine * ship.breadth / ship.length / share)),
    )  # fmt: skip


def _in_ship(curve: Polynomial, peak: float, name: str, use: str, full: float) -> FormDefinition:
    """Give a curve in the frame of its waterline as a definition in that of the ship."""
    share, start = 1.0 + _AFT, -1.0 - 2.0 * _AFT
    moved = curve(Polynomial([-1.0 - start / share, 1.0 / share]))
    halves = halves_of(moved, name, use, full, start, share * (peak + 1.0) + start)
    return fitted_halves(halves, moved)


# --------------------------------------------------------------------------------------
# Fullness of sections, depths of the contour.

_GRID = np.linspace(-1.0, 1.0, 801)[1:-1]

_HEEL, _FOREFOOT = -0.72, 0.72
"""s where the straight keel ends."""

_LEAST, _MOST = 0.25, 0.94
"""Fullness that a section may have; the fullest has a rise of floor of 1/20 of its depth."""


def _shape(ship: Particulars, made: _Halves) -> tuple[CubicSpline, CubicSpline]:
    """Give fullness and depth, in parts of the draught, over s.

    Raises BadInputError where sections are too full or too sharp, or the contour turns.
    """
    forms = Forms.of([made.areas, made.line], ship)
    x = _places(ship, _GRID)
    ratio = forms.value("sectional_area", x) / forms.value("design_waterline", x)
    ratio = ratio / (2.0 * ship.draught)
    within = CubicSpline(_GRID, ratio)
    aft, fore = ([float(within(at, n)) for n in range(3)] for at in (_HEEL, _FOREFOOT))
    stern = BPoly.from_derivatives([-1.0, _HEEL], [[0.5, 0.0], aft])
    bow = BPoly.from_derivatives([_FOREFOOT, 1.0], [fore, [0.5, 0.0]])
    keel = (_GRID >= _HEEL) & (_GRID <= _FOREFOOT)
    full = np.where(keel, ratio, np.where(_GRID < _HEEL, stern(_GRID), bow(_GRID)))
    deep = ratio / full
    # On the keel the depth is the draught to the last bit.
    falls = np.diff(deep) * np.sign(_GRID[1:])
    for bad, words in (
        (full.max() > _MOST, "flatter than a floor with a rise"),
        (full.min() < _LEAST, "sharper than a hollow wedge"),
        (falls.max() > 1e-6, "deeper than the keel"),
    ):
        if bad:
            what = f"sections would have to be {words}"
            raise BadInputError(what, _CALL, "give another cb, lcb, cm or cw")
    ends = [-1.0, *_GRID, 1.0]
    return CubicSpline(ends, [0.5, *full, 0.5]), CubicSpline(ends, [0.0, *deep, 0.0])


def _places(ship: Particulars, s: FloatArray) -> FloatArray:
    """Give x, m, of places in the frame of the waterline."""
    found: FloatArray = ship.length * (0.5 * (1.0 + _AFT) * (1.0 + s) - _AFT)
    return found


# --------------------------------------------------------------------------------------
# The contour.

_MARKS = (
    -1.0,
    -0.95,
    -0.9,
    -0.85,
    -0.8,
    -0.76,
    _HEEL,
    _FOREFOOT,
    0.77,
    0.82,
    0.87,
    0.92,
    0.96,
    1.0,
)
"""s of the nodes of the contour below the waterline."""

_STEM, _AFTER = 58.0, 0.02
"""Angle of the stem's head, deg, or that at the waterline if more; overhang of the transom abaft
the waterline at most, in parts of the length."""


def _sheer(ship: Particulars) -> float:
    """Give the standard sheer at FP, m: 50 (L/3 + 10) mm; it is half as much at AP."""
    return 0.05 * (ship.length / 3.0 + 10.0)


def _profile(ship: Particulars, shape: tuple[CubicSpline, CubicSpline]) -> FormDefinition:
    """Give the contour: transom, counter, keel, forefoot, stem."""
    marks = np.array(_MARKS)
    depths = np.array([shape[1](marks, order) for order in range(3)])
    keel = (marks >= _HEEL) & (marks <= _FOREFOOT)
    depths[:, keel] = [[1.0], [0.0], [0.0]]
    labels = ("counter", *(f"keel {number}" for number in range(1, len(marks) - 1)), "FP")
    slope = 2.0 * ship.draught / ((1.0 + _AFT) * ship.length) * -float(depths[1, -1])
    head = max(_STEM, math.degrees(math.atan(slope)))
    rise = ship.depth - ship.draught + _sheer(ship)
    aft = -_AFT * ship.length
    return contour_of(ship, labels, marks, depths, aft, _AFTER, rise, head)


# --------------------------------------------------------------------------------------
# Sections.

_NODES = np.array([
    -0.9995, -0.97, -0.93, -0.88, -0.83, -0.78, -0.72, -0.65, -0.55, -0.42, -0.25, -0.05,
    0.15, 0.32, 0.47, 0.58, 0.67, 0.75, 0.82, 0.88, 0.93, 0.97, 0.9995,
])  # fmt: skip
"""s of the nodes of courses: close where the fullness changes."""

_SQUARE = 0.97
"""What v - u of the corner of a section comes near to as it becomes full."""

_AFTERWARD, _FADES = 0.8, 0.04


def _courses(
    ship: Particulars, profile: FormDefinition, forms: Forms,
    shape: tuple[CubicSpline, CubicSpline],
) -> list[FormDefinition]:  # fmt: skip
    """Give angles, curvatures and tangents at contour and waterline.

    Sections near the triangle are arcs of parabolas; fuller ones have a corner that stays inside
    the box, and tangents and curvatures with which the change of curvature is least (found by
    trying, for half-breadths of 1 to 1.4 draughts).
    """
    x = _places(ship, _NODES)
    wide, deep = forms.value("design_waterline", x), ship.draught * shape[1](_NODES)
    over = shape[0](_NODES) - 0.5
    corner = _corner(over)
    # The side of the largest section is upright at the waterline.
    most = float(_corner(shape[0](_GRID).max() - 0.5))
    v = 0.5 + 0.6 * corner + min((0.5 - 0.6 * most) / most**6, 0.3) * corner**6
    size = np.abs(over)
    pace = 0.5 - 0.13 * size + 16.5 * size**6
    bent = 0.5 * np.maximum(1.0 - (size / 0.36) ** 6, 0.0)
    aft = -_AFT * ship.length
    after = _AFTERWARD * np.exp(-(x - aft) / (_FADES * ship.length))
    values = section_values(ship, wide, deep, np.array([v - corner, v]), pace, bent, after)
    return section_courses(ship, profile, forms, x, values, aft)


def _corner(over: FloatArray) -> FloatArray:
    """Give v - u of the corner of a section by how much its fullness is above 1/2."""
    free = 3.0 * over
    found: FloatArray = free / (1.0 + np.abs(free / _SQUARE) ** 6) ** (1.0 / 6.0)
    return found


# --------------------------------------------------------------------------------------
# Deck, and where lines stand.

_TRANSOM, _BEAM, _BOW = 0.8, (0.4, 0.5), 1.8
"""Breadth of the deck at the transom in parts of the widest; where it is widest, in parts of the
length; its slope at the stem in parts of that of the chord from there."""


def _deck(ship: Particulars, profile: FormDefinition) -> list[FormDefinition]:
    """Give half-breadth and height of the deck edge."""
    stern, bow, head = (profile.value(each) or 0.0 for each in ("transom_x", "stem_x", "stem_y"))
    wide, (first, last) = 0.5 * ship.breadth, (each * ship.length for each in _BEAM)
    entry = -math.degrees(math.atan(_BOW * wide / (bow - last)))
    return [
        course("deck_side", {
            "transom": {"x": stern, "y": _TRANSOM * wide},
            "full": {"x": first, "y": wide, "angle_deg": 0.0},
            "end": {"x": last, "y": wide, "angle_deg": 0.0},
            "stem": {"x": bow, "y": 0.0, "angle_deg": entry},
        }),
        course("deck_height", {
            "transom": {"x": stern, "y": ship.depth + 0.5 * _sheer(ship)},
            "low": {"x": 0.45 * ship.length, "y": ship.depth, "angle_deg": 0.0},
            "stem": {"x": bow, "y": head},
        }),
    ]  # fmt: skip


_INNER = (
    -0.6, -0.35, 0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, *range(4, 17),
    17.0, 17.5, 18.0, 18.5, 19.0, 19.5, 19.75,
)  # fmt: skip
"""None at the ends of the waterline, where sections come to nothing below it."""


def _stations(ship: Particulars, profile: FormDefinition) -> tuple[float, ...]:
    aft, fore = (20.0 * (profile.value(f"{end}_x") or 0.0) for end in ("transom", "stem"))
    ahead = fore / ship.length - 20.0
    return (
        round(0.5 * aft / ship.length - 10.0 * _AFT, 2), *_INNER,
        round(20.0 + 0.3 * ahead, 2), round(20.0 + 0.62 * ahead, 2),
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Notes.


def _notes(
    ship: Particulars, made: _Halves, design: Design, given: tuple[str, ...]
) -> tuple[DesignNote, ...]:
    profile = design.definition("profile")
    areas, line = (coefficients(each, ship) for each in (made.areas, made.line))
    cb = areas.fullness * made.cm
    drawn = "ours, looked at on lines plans"
    cm, cw = (
        "given" if each in given else f"ours: {start:.2f} + .6 (CB - .5)"
        for each, start in (("CM", _CM), ("CW", _CW))
    )
    rise = design.definition("keel_angle").value("node 11_y") or 0.0
    stern, stem = (profile.value(f"{end}_x") or 0.0 for end in ("transom", "stem"))
    return (
        DesignNote("CP", areas.fullness, "", "CB / CM", 0.55, 0.65,
                   remark="the range is that of trawlers, coasters and tugs, Holtrop"),
        DesignNote("CM", made.cm, "", cm, others={"Kerlen 1970": 1.006 - 0.0056 * cb**-3.56}),
        DesignNote("CW", line.fullness, "", cw, others={
            "Schneekluth, (1 + 2 CB)/3": (1.0 + 2.0 * cb) / 3.0,
            "Kristensen, .55 + .45 CB": 0.55 + 0.45 * cb,
        }),
        DesignNote("LCF", 100.0 * line.centroid / ship.length, "% L",
                   "of the fairest waterline that is widest where the largest section stands"),
        DesignNote("half angle of entrance", made.entry, "deg",
                   "by a stem of 55 deg at the waterline, if the waterline is not too fine"),
        DesignNote("rise of floor", 90.0 - rise, "deg", "by CM, at the keel amidships"),
        DesignNote("waterline abaft AP", _AFT * ship.length, "m", f"{drawn}: .04 L"),
        DesignNote("overhang of the transom", -stern, "m",
                   f"{drawn}: .06 L, less where the counter nears the deck; it is upright"),
        DesignNote("overhang of the stem", stem - ship.length, "m",
                   f"{drawn}: 58 deg at the head, or as steep as at the waterline"),
        DesignNote("sheer ahead", _sheer(ship), "m",
                   "load lines 1966, 50 (L/3 + 10) mm; half of it aft"),
        DesignNote("type", ship.length, "m", "trawler",
                   remark="a level keel; no stern frame, no aperture, no rudder, no bulwark: "
                   "set keel nodes of profile for a raked keel"),
    )  # fmt: skip
