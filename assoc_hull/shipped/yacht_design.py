"""Canoe bodies of sailing yachts from six numbers: no flats, no parallel body, no keel, no rudder.

Curve of areas, waterline and contour are drawn for each yacht, not carried from another. With
s from -1 at AP to 1 at FP,

    t = CM a / (sigma b)

is the depth of a section below the waterline in parts of T, a its area in parts of that of the
largest, b its half-breadth in parts of B/2, and sigma its fullness, its area over that of the
rectangle about it: 1/2 at both ends, where sections are triangles that shrink. So the contour
follows from CB, LCB and the waterline. Below the waterline a section is nearly an arc of a parabola
whose corner (u, v), in parts of depth and half-breadth, has v - u = 3 (sigma - 1/2).

Examples
--------
>>> from assoc_hull.shipped.yacht_design import yacht_design
>>> yacht_design().particulars.breadth
3.2
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from assoc_hull.creation.design import Design
from assoc_hull.creation.fairest_halves import fairest_polynomial, halves_of
from assoc_hull.creation.form_definitions import course
from assoc_hull.creation.six_numbers import DesignNote, SixNumbers, TypedDesign
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.two_halves import half_number
from assoc_hull.model.tables import Particulars

__all__ = [
    "contour_of", "draw_yacht", "drawn_design", "drawn_particulars", "rounded", "section_courses",
    "section_values", "yacht_design",
]  # fmt: skip

_CALL = "in a yacht from six numbers"

_SYSSER = "Sysser 1, measured on its offsets"
"""Delft Systematic Yacht Hull Series Geometries, 4TU.ResearchData, DOI 10.4121/21501330."""


def yacht_design() -> Design:
    """Give the design of a canoe body of 10 m on the waterline, CB .393, LCB 3.5 % abaft midship.

    Returns
    -------
    Design
    """
    return draw_yacht(SixNumbers(10.0, 3.2, 0.56, 1.75, 0.393, -0.35)).design


def draw_yacht(
    six: SixNumbers, cm: float | None = None, cw: float | None = None, name: str | None = None
) -> TypedDesign:
    """Draw a canoe body with its notes; `length` is that of the waterline.

    Raises BadInputError where no fair lines have these numbers.
    """
    ship = drawn_particulars("Yacht canoe body", six, name)
    made = _coefficients(six, cm, cw)
    areas, line, entry = _halves(ship, made)
    profile = _profile(ship, _depths(ship, areas, line, made.cm))
    forms = Forms.of([areas, line, profile], ship)
    rest = [*_deck(ship, profile, forms), *_courses(ship, profile, forms)]
    design = drawn_design(ship, [areas, line, profile, *rest], _stations(ship, profile))
    notes = _notes(ship, made, entry, design)
    return TypedDesign(design, notes, cw is not None, drawn=True)


# --------------------------------------------------------------------------------------
# What all types have that are drawn for their numbers.


def drawn_particulars(kind: str, six: SixNumbers, name: str | None) -> Particulars:
    """Give the particulars of a ship of a kind; her name says kind and length if none is given."""
    return Particulars(
        name or f"{kind} {six.length:g} m",
        six.length, six.breadth, six.depth, six.draught, "closed",
    )  # fmt: skip


def drawn_design(
    ship: Particulars, definitions: Sequence[FormDefinition], stations: Sequence[float]
) -> Design:
    """Make a design of areas, waterline, profile and what follows them, with a transom."""
    return Design(
        ship, definitions, stations=stations, waterlines=levels_of(ship),
        buttocks=rounded(0.5 * ship.breadth * np.array(_BUTTOCKS)),
        transom=definitions[2].value("transom_x"),
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Coefficients.


@attrs.frozen
class _Coefficients:
    """What was chosen; `lcb`, `lcf` in % of the length from midship, forward positive."""

    cm: float
    cp: float
    cw: float
    lcb: float
    lcf: float
    given: tuple[str, ...]


def _coefficients(six: SixNumbers, cm: float | None, cw: float | None) -> _Coefficients:
    lcb = 100.0 * six.lcb / six.length
    given = tuple(n for n, value in (("CM", cm), ("CW", cw)) if value is not None)
    # Full curves with their centroid far aft would have two maxima.
    less = min(max(0.05 * (lcb + 2.0), -0.3), 0.0)
    cm = six.cb / (_CP + (0.5 + less) * (six.cb - _CB)) if cm is None else cm
    cw = _CW + (0.3 + less) * (six.cb - _CB) if cw is None else cw
    return _Coefficients(cm, six.cb / cm, cw, lcb, _LCF + 0.52 * (lcb + 2.0), given)


_CB, _CP, _CW, _LCF = 0.36, 0.55, 0.675, -3.2
"""Of Sysser 1, nearly: CB .359, CP .562, CW .675; LCF in % of the length where LCB is -2 %."""

_STEEP, _FINEST, _BLUNTEST = 0.36, 0.9, 1.7
"""Slope of the contour at FP; least and most of the waterline there, in the frame -1 to 1."""


def _halves(ship: Particulars, made: _Coefficients) -> tuple[FormDefinition, FormDefinition, float]:
    """Give curve of areas and waterline, and the half angle of entrance, deg."""
    areas = fairest_polynomial(2, made.cp, 0.02 * made.lcb, {})
    # a'' = b' t' / CM at FP, where sections are triangles: a steeper contour has a finer entrance.
    steep = min(max(_STEEP * ship.length / (2.0 * ship.draught), 2.2), 3.4)
    fine = min(max(made.cm * float(areas.deriv(2)(1.0)) / steep, _FINEST), _BLUNTEST)
    blunt = 2.8 - 0.1 * (made.lcb + 2.0)
    line = fairest_polynomial(1, made.cw, 0.02 * made.lcf, {-1.0: blunt, 1.0: -fine})
    full = made.cm * ship.breadth * ship.draught
    return (
        halves_of(areas, "sectional areas", "sectional_area", full),
        halves_of(line, "design waterline", "design_waterline", 0.5 * ship.breadth),
        math.degrees(math.atan(fine * ship.breadth / ship.length)),
    )


# --------------------------------------------------------------------------------------
# The contour.

_GRID = np.linspace(-1.0, 1.0, 401)[1:-1]

_FULLEST = (0.56, 0.88)
"""Fullness of the middle section within which round sections are fair."""


def _depths(
    ship: Particulars, areas: FormDefinition, line: FormDefinition, cm: float
) -> CubicSpline:
    """Give t over s; its maximum is 1.

    The fullness is 1/2 at both ends, and level there: a section that crosses the end of the
    waterline is a triangle as long as it can.
    """
    forms = Forms.of([areas, line], ship)
    x = 0.5 * ship.length * (1.0 + _GRID)
    ratio = forms.value("sectional_area", x) / forms.value("design_waterline", x)
    ratio = ratio / (2.0 * ship.draught)
    peak = half_number(areas, "run_end")
    side = (_GRID - peak) / np.where(peak > _GRID, 1.0 + peak, 1.0 - peak)
    bump = 1.0 - side * side
    bump = bump * bump * (2.0 - bump)

    def depths(middle: float) -> FloatArray:
        found: FloatArray = ratio / (0.5 + (middle - 0.5) * bump)
        return found

    low, high = _FULLEST
    if not depths(high).max() <= 1.0 <= depths(low).max():
        where = "flatter" if depths(high).max() > 1.0 else "sharper"
        what = f"sections would have to be {where} than round ones"
        raise BadInputError(what, _CALL, "give another cb or cm")
    middle = float(brentq(lambda each: depths(each).max() - 1.0, low, high))
    return CubicSpline([-1.0, *_GRID, 1.0], [0.0, *depths(middle), 0.0])


_MARKS = (-1.0, -0.75, -0.45, -0.1, 0.3, 0.65, 1.0)
"""s of the nodes of the contour below the waterline."""

_STEM, _AFTER, _AHEAD, _RISE = 62.0, 0.12, 0.15, 1.25
"""Angle of the stem's head, deg; overhangs at most, in parts of the length; height of the head
above the waterline, in parts of the freeboard."""


def _profile(ship: Particulars, depths: CubicSpline) -> FormDefinition:
    """Give the contour with a counter abaft the waterline and a stem ahead of it."""
    shape = np.array([depths(_MARKS, order) for order in range(3)])
    labels = ("AP", *(f"keel {number}" for number in range(1, len(_MARKS) - 1)), "FP")
    rise = _RISE * (ship.depth - ship.draught)
    return contour_of(ship, labels, np.array(_MARKS), shape, 0.0, _AFTER, rise, _STEM)


def contour_of(
    ship: Particulars, labels: Sequence[str], marks: FloatArray, shape: FloatArray, aft: float,
    overhang: float, rise: float, head: float,
) -> FormDefinition:  # fmt: skip
    """Give a contour with a counter abaft the waterline and a stem ahead of it.

    `shape` (3, n) are depths in parts of the draught and their derivatives by s at `marks`; `aft`
    (m) is the after end of the waterline, `overhang` at most that of the transom in parts of the
    length, `rise` (m) the height of the stem's head above the waterline, `head` its angle, deg.
    """
    half, free = 0.5 * (ship.length - aft), ship.depth - ship.draught
    nodes: dict[str, Mapping[str, float | None]] = {}
    for label, mark, (deep, *rates) in zip(labels, marks.tolist(), shape.T.tolist(), strict=True):
        slope, bend = (-ship.draught / half**n * rate for n, rate in enumerate(rates, 1))
        nodes[label] = {
            "x": aft + half * (1.0 + mark), "y": ship.draught * (1.0 - deep),
            "angle_deg": math.degrees(math.atan(slope)), "curvature": bend / (1 + slope**2) ** 1.5,
        }  # fmt: skip
    stern, fore = (
        math.tan(math.radians(nodes[end]["angle_deg"] or 0.0)) for end in (labels[0], labels[-1])
    )
    # A counter that would come near the deck is shorter.
    over = min(overhang * ship.length, 0.4 * free / -stern)
    transom = {
        "x": aft - over, "y": ship.draught - 0.92 * stern * over,
        "angle_deg": math.degrees(math.atan(0.8 * stern)),
    }  # fmt: skip
    begin = math.degrees(math.atan(fore))
    ahead = min(rise / math.tan(math.radians(0.5 * (begin + head))), _AHEAD * ship.length)
    # The chord of the stem halves its angles: it bends one way.
    end = min(2.0 * math.degrees(math.atan(rise / ahead)) - begin, 80.0)
    stem = {"x": ship.length + ahead, "y": ship.draught + rise, "angle_deg": end}
    return course("profile", {"transom": transom, **nodes, "stem": stem})


# --------------------------------------------------------------------------------------
# Sections.

_NODES = np.array([-0.9995, *-np.cos(np.linspace(0.35, math.pi - 0.35, 11)), 0.9995])
"""s of the nodes of courses."""


def _courses(ship: Particulars, profile: FormDefinition, forms: Forms) -> list[FormDefinition]:
    """Give angles, curvatures and tangents at contour and waterline, those of parabolas."""
    x = 0.5 * ship.length * (1.0 + _NODES)
    wide = forms.value("design_waterline", x)
    deep = ship.draught - np.array([forms.contour(each)[0] for each in x.tolist()])
    corner = 3.0 * (0.5 * forms.value("sectional_area", x) / (wide * deep) - 0.5)
    corner[[0, -1]] = 0.0
    v, u = 0.5 + 0.6 * corner, 0.5 - 0.4 * corner
    # Near AP a section bends upward as those abaft it do, which end on the contour.
    after = _AFTERWARD * np.exp(-x / (0.08 * ship.length))
    values = section_values(ship, wide, deep, np.array([u, v]), 0.5, 0.5, after)
    return section_courses(ship, profile, forms, x, values, 0.0)


def section_values(
    ship: Particulars, wide: FloatArray, deep: FloatArray, corner: FloatArray,
    pace: float | FloatArray, bent: float | FloatArray, after: FloatArray,
) -> dict[str, FloatArray]:  # fmt: skip
    """Give the values of courses at sections of half-breadths and depths, m, at the waterline.

    `corner` (2, n) is where the tangents at their ends meet, in parts of depth and half-breadth;
    `pace` are tangents in parts of the sides to it, `bent` curvatures in parts of twice those that
    a parabola has; both are .5 for parabolas. `after` bends them upward near the stern.
    """
    u, v = corner
    low, high = np.hypot(deep * u, wide * v), np.hypot(deep * (1.0 - u), wide * (1.0 - v))
    bend, chord = -bent * deep * wide * (v - u), np.hypot(deep, wide)
    flare = np.arctan2(wide * (1.0 - v), deep * (1.0 - u))
    over = -bend / high**3 * (1.0 + after)
    # More than this and a topside would turn back before it comes to the deck edge.
    most = 2.6 * np.maximum(flare - 0.05, 0.02) / (ship.depth - ship.draught)
    return {
        "keel_angle": np.degrees(np.arctan2(wide * v, deep * u)),
        "keel_curvature": bend / low**3 * (1.0 - np.minimum(after, 1.0)),
        "keel_tangent": 4.0 * pace * low / chord,
        "waterline_angle": np.degrees(flare),
        "waterline_curvature": -over * most / np.hypot(over, most),
        "waterline_tangent": 4.0 * pace * high / chord,
    }


def section_courses(
    ship: Particulars, profile: FormDefinition, forms: Forms, x: FloatArray,
    values: Mapping[str, FloatArray], aft: float,
) -> list[FormDefinition]:  # fmt: skip
    """Give courses through values at x, m; `aft` (m) is the after end of the waterline."""
    found = []
    for use, ordinates in values.items():
        nodes: dict[str, Mapping[str, float | None]] = {
            f"node {number}": {"x": float(at), "y": round(float(y), 6)}
            for number, (at, y) in enumerate(zip(x, ordinates, strict=True))
        }
        if use == "keel_angle":
            nodes = _beyond_ends(ship, profile, forms, nodes, values["waterline_angle"], aft)
        elif use == "keel_curvature":
            nodes["stem"] = {"x": profile.value("stem_x"), "y": 0.0}
        found.append(course(use, nodes, rule="spline"))
    return found


_AFTERWARD = 3.0

_STEM_ENTRY = 26.0
"""Half angle of waterlines at the head of the stem, deg."""


def _beyond_ends(
    ship: Particulars, profile: FormDefinition, forms: Forms,
    nodes: Mapping[str, Mapping[str, float | None]], flare: FloatArray, aft: float,
) -> dict[str, Mapping[str, float | None]]:  # fmt: skip
    """Add nodes of the angle at the contour abaft the waterline and ahead of FP."""
    first, *others = nodes.items()
    x = np.array([each["x"] for each in nodes.values()], np.float64)
    y = np.array([each["y"] for each in nodes.values()], np.float64)
    rate, own = (float(CubicSpline(x, each)(x[0], 1)) for each in (flare, y))
    # Abaft the waterline a section begins at the contour with what it has there ahead of its end.
    corner = {
        **first[1], "angle_deg": math.degrees(math.atan(rate)),
        "leave_angle_deg": math.degrees(math.atan(own)),
    }  # fmt: skip
    stern, bow = (profile.value(f"{end}_x") or 0.0 for end in ("transom", "stem"))
    found: dict[str, Mapping[str, float | None]] = {
        "transom": {"x": stern, "y": float(y[0]) + 0.6 * rate * (stern - aft)},
        first[0]: corner, **dict(others),
    }  # fmt: skip
    # Ahead of FP waterlines end with angles between those of entrance and stem.
    entry = math.atan2(float(forms.value("design_waterline", x[-1:])[0]), ship.length - x[-1])
    for number, part in enumerate((0.02, 0.25, 0.5, 0.75, 1.0)):
        place = ship.length + part * (bow - ship.length)
        angle = (1.0 - part) * entry + part * math.radians(_STEM_ENTRY)
        up = float(forms.chain("profile").slope(np.array([place]))[0])
        found[f"stem {number}"] = {
            "x": place, "y": math.degrees(math.atan(math.tan(angle) / up))
        }  # fmt: skip
    return found


# --------------------------------------------------------------------------------------
# Deck, and where lines stand.

_TRANSOM, _FLARED, _SHEER = 0.8, 0.33, 0.06
"""Breadth of the deck at the transom in parts of the widest; how much of its flare at the waterline
a topside keeps; height of the deck there above that amidships, in parts of the freeboard."""


def _deck(ship: Particulars, profile: FormDefinition, forms: Forms) -> list[FormDefinition]:
    """Give half-breadth and height of the deck edge."""
    middle, free = 0.5 * ship.length, ship.depth - ship.draught
    x = np.array([middle])
    wide = float(forms.value("design_waterline", x)[0])
    deep = ship.draught - forms.contour(middle)[0]
    corner = 1.5 * (float(forms.value("sectional_area", x)[0]) / (wide * deep) - 1.0)
    flare = wide * (0.5 - 0.6 * corner) / (deep * (0.5 + 0.4 * corner))
    widest = 0.5 * ship.breadth + _FLARED * free * max(flare, 0.15)
    stern, bow, head = (profile.value(each) for each in ("transom_x", "stem_x", "stem_y"))
    return [
        course("deck_side", {
            "transom": {"x": stern, "y": _TRANSOM * widest},
            "full": {"x": 0.42 * ship.length, "y": widest, "angle_deg": 0.0},
            "stem": {"x": bow, "y": 0.0},
        }),
        course("deck_height", {
            "transom": {"x": stern, "y": ship.depth + _SHEER * free},
            "low": {"x": middle, "y": ship.depth,
                    "angle_deg": math.degrees(math.atan(0.13 * free / ship.length))},
            "stem": {"x": bow, "y": head},
        }),
    ]  # fmt: skip


_INNER = (
    0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, *range(4, 17), 17.0, 17.5, 18.0, 18.5, 19.0, 19.5, 19.75,
)  # fmt: skip
"""None at AP or FP, where sections come to nothing below the waterline."""

_BUTTOCKS = (0.2, 0.4, 0.6, 0.8)
_BELOW, _ABOVE = (0.2, 0.4, 0.6, 0.8), (0.25, 0.5, 0.75)


def rounded(values: FloatArray) -> tuple[float, ...]:
    """Give places, m, to a millimetre."""
    return tuple(round(each, 3) for each in values.tolist())


def _stations(ship: Particulars, profile: FormDefinition) -> tuple[float, ...]:
    aft, fore = ((profile.value(f"{end}_x") or 0.0) for end in ("transom", "stem"))
    after, ahead = 20.0 * aft / ship.length, 20.0 * (fore / ship.length - 1.0)
    return (
        round(0.7 * after, 2), round(0.33 * after, 2), *_INNER,
        round(20.0 + 0.3 * ahead, 2), round(20.0 + 0.62 * ahead, 2),
    )  # fmt: skip


def levels_of(ship: Particulars) -> tuple[float, ...]:
    """Give heights of waterlines."""
    free = ship.depth - ship.draught
    return (
        *rounded(ship.draught * np.array(_BELOW)), ship.draught,
        *rounded(ship.draught + free * np.array(_ABOVE)),
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# Notes.


def _notes(
    ship: Particulars, made: _Coefficients, entry: float, design: Design
) -> tuple[DesignNote, ...]:
    profile, side = design.definition("profile"), design.definition("deck_side")
    ours = "ours, near Sysser 1 of the Delft series"
    cp = "given CM" if "CM" in made.given else f"{ours}: .55 + (.5 + .05 (LCB + 2)) (CB - .36)"
    cw = "given" if "CW" in made.given else f"{ours}: .675 + (.3 + .05 (LCB + 2)) (CB - .36)"
    seen = "the range of the Delft series is from secondary texts: its reports were not seen"
    after, ahead = -(profile.value("transom_x") or 0.0), profile.value("stem_x") or 0.0
    drawn = "ours, looked at on lines plans"
    return (
        DesignNote("CP", made.cp, "", cp, 0.52, 0.6, {_SYSSER: 0.562}, seen),
        DesignNote("CM", made.cm, "", "given" if "CM" in made.given else "CB / CP", 0.62, 0.79,
                   {_SYSSER: 0.638}, seen),
        DesignNote("CW", made.cw, "", cw, 0.65, 0.72, {_SYSSER: 0.675}, seen),
        DesignNote("LCF", made.lcf, "% L", f"{ours}: -3.2 + .52 (LCB + 2)", -9.5, -1.8,
                   {"Sysser 1, LCB -2.1 %": -3.1}, seen),
        DesignNote("half angle of entrance", entry, "deg",
                   "by the slope of the contour at FP, .36 if the waterline is not too fine"),
        DesignNote("overhang aft", after, "m", f"{drawn}: .12 L, shorter where it nears the deck"),
        DesignNote("overhang ahead", ahead - ship.length, "m",
                   f"{drawn}: a stem of 62 deg at its head, .15 L at most"),
        DesignNote("breadth of the deck", 2.0 * (side.value("full_y") or 0.0), "m",
                   f"{drawn}: a third of the flare at the waterline",
                   others={"Sysser 1, in parts of B": 1.14}),
        DesignNote("breadth of the transom", 2.0 * (side.value("transom_y") or 0.0), "m",
                   f"{drawn}: .8 of the deck's; the transom is upright"),
        DesignNote("type", ship.length, "m", "yacht canoe body",
                   remark="no keel, no rudder; length and CB are those of the waterline"),
    )  # fmt: skip
