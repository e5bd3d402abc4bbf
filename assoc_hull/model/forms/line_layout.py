"""Layouts: the pieces that a generated line is made of where it stands.

A layout is a text of pieces, joined by ``+`` in order along the line. It depends on the definitions
and the place only, never on how the net was edited, and says also which points are knuckles or
tangent, and how the line ends. Lines that are courses themselves (profile, deck edge, borders of
flats) have a piece for each stretch between nodes; sections change their layout along the ship.
"""

from __future__ import annotations

import itertools
import math

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import EndKind, FloatArray, IntArray, PointKind
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.courses import corners_of
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.sections import breadth_at, bulb_layout, in_middle_body, span_of
from assoc_hull.model.tables import Ends

__all__ = [
    "COURSES",
    "CourseShape",
    "DeckShape",
    "buttock_layout",
    "course_layout",
    "course_shape",
    "deck_layout",
    "deck_shape",
    "ends_for",
    "flat_points",
    "joints_of",
    "layout_at",
    "water_layout",
]

# --------------------------------------------------------------------------------------
# Lines that are courses themselves. Pieces: ``ahead``, ``up`` and ``down`` are straight along an
# axis, ``form`` is any other; ``^`` after a piece says that it begins at a corner. On the deck
# edge, the course of half-breadths is divided at the nodes of the course of heights as well;
# ``:side``, ``:height`` or ``:both`` says whose node a piece begins at.

_ONE_NODE = 1e-6
"""Nodes of two courses nearer than this (m) are one."""

_AXES = {"profile": (0, 2, 1), "deck_centre": (0, 2, 1), "flat_of_side": (0, 2, 1),
         "flat_of_bottom": (0, 1, 2)}  # fmt: skip
"""By use: the axes of abscissa and ordinate, and the axis across the plane."""


def course_layout(definition: FormDefinition) -> str:
    """Give the layout of a line that is one course."""
    corners = corners_of(definition)
    tokens = [
        _token(definition, i) + ("^" if i and corners[i] else "")
        for i in range(len(definition.nodes) - 1)
    ]
    return "+".join(tokens) or "form"


def _token(definition: FormDefinition, piece: int) -> str:
    """Give the word for a piece of a course: the axis that it runs along, or ``"form"``."""
    first, last = definition.nodes[piece : piece + 2]
    # A value that is missing is refused where the course is made.
    x0, y0, x1, y1 = (
        definition.value(f"{node}_{each}") or 0.0 for node in (first, last) for each in ("x", "y")
    )
    leave = definition.value(f"{first}_leave_angle_deg")
    # How a corner is arrived at belongs to the piece before.
    angles = {
        definition.value(f"{first}_angle_deg") if leave is None else leave,
        definition.value(f"{last}_angle_deg"),
    }
    # A straight course has no angles to ask for.
    straight = definition.rule == "straight"
    if y0 == y1 and x1 > x0 and (straight or angles == {0.0}):
        return "ahead"
    if x0 == x1 and y1 > y0 and (straight or angles == {90.0}):
        return "up"
    if x0 == x1 and y1 < y0 and (straight or angles == {-90.0}):
        return "down"
    return "form"


@attrs.frozen(eq=False)
class CourseShape:
    """One course in a plane.

    Attributes
    ----------
    chain : FormChain
        The course.
    axes : tuple of int
        Those of abscissa and ordinate, and the axis across the plane.
    across : float, m
        The coordinate across the plane.
    """

    chain: FormChain
    axes: tuple[int, int, int]
    across: float

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 3), m."""
        return self._in_space(self.chain.at(piece, t), self.across)

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 3), m."""
        return self._in_space(self.chain.tangent(piece, t), 0.0)

    def _in_space(self, plane: FloatArray, across: float) -> FloatArray:
        found = np.empty((len(plane), 3))
        found[:, self.axes[0]], found[:, self.axes[1]] = plane.T
        found[:, self.axes[2]] = across
        return found + 0.0  # -0.0 becomes 0.0: fingerprints are of bits


def course_shape(forms: Forms, use: str) -> CourseShape:
    """Give the shape of a line that is one course, by its use.

    A flat of side lies at half the breadth, a flat of bottom on the lowest contour at its middle,
    all others in the centre plane.
    """
    chain = forms.chain(use)
    across = 0.0
    if use == "flat_of_side":
        across = 0.5 * forms.particulars.breadth
    if use == "flat_of_bottom":
        heights = forms.contour(0.5 * float(chain.start[0] + chain.finish[0]))
        across = heights[0] if heights else 0.0
    return CourseShape(chain, _AXES[use], across)


@attrs.frozen(eq=False)
class DeckShape:
    """The deck edge: half-breadths and heights over x.

    Attributes
    ----------
    side, height : FormChain
        The two courses.
    spans : tuple of (int, float, float)
        Of each piece: the piece of `side`, and between which t on it.
    """

    side: FormChain
    height: FormChain
    spans: tuple[tuple[int, float, float], ...]

    def at(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give points, (k, 3), m."""
        plane = self.side.at(*self._place(piece, t)[:2])
        x = np.clip(plane[:, 0], self.height.start[0], self.height.finish[0])
        return np.column_stack([plane[:, 0], plane[:, 1], self.height.ordinate(x)])

    def tangent(self, row: IntArray, piece: IntArray, t: FloatArray) -> FloatArray:
        """Give derivatives by t, (k, 3), m."""
        number, at, share = self._place(piece, t)
        x = np.clip(self.side.at(number, at)[:, 0], self.height.start[0], self.height.finish[0])
        plane = self.side.tangent(number, at) * share[:, None]
        return np.column_stack([plane, plane[:, 0] * self.height.slope(x)])

    def _place(self, piece: IntArray, t: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Give piece and t on `side`, and the derivative of that t by the given one."""
        number, low, high = (np.array(each)[piece] for each in zip(*self.spans, strict=True))
        share = (high - low) / 4.0
        return number, low + share * t, share


def deck_layout(forms: Forms) -> str:
    """Give the layout of the deck edge."""
    side, height = (forms.needed(use, "for the deck edge") for use in ("deck_side", "deck_height"))
    tokens = []
    corners = [dict(zip(_stands(each), corners_of(each), strict=True)) for each in (side, height)]
    stops = _stops(forms)
    for i, (x, whose) in enumerate(stops[:-1]):
        between = 0.5 * (x + stops[i + 1][0])
        level = all(_token(each, _piece(each, between)) == "ahead" for each in (side, height))
        corner = any(_nearest(found, x) for found in corners) if i else False
        token = ("ahead" if level else "form") + ("^" if corner else "")
        tokens.append(f"{token}:{whose}" if i else token)
    return "+".join(tokens)


def deck_shape(forms: Forms) -> DeckShape:
    """Give the shape of the deck edge."""
    side, height = forms.chain("deck_side"), forms.chain("deck_height")
    stops = np.array([x for x, _ in _stops(forms)])
    middle = 0.5 * (stops[:-1] + stops[1:])
    piece = side.place(middle)[0]
    knots = side.at(np.arange(side.count), np.zeros(side.count))[:, 0]
    spans = []
    for i, number in enumerate(piece.tolist()):
        # at its own nodes a piece begins and ends exactly at t = 0 and 4
        ends = [
            end if abs(x - edge) <= _ONE_NODE else float(side.place(np.array([x]))[1][0])
            for x, edge, end in (
                (stops[i], knots[number], 0.0),
                (stops[i + 1], np.append(knots, side.finish[0])[number + 1], 4.0),
            )
        ]
        spans.append((number, ends[0], ends[1]))
    return DeckShape(side, height, tuple(spans))


def _stands(definition: FormDefinition) -> list[float]:
    """Give the abscissae of the nodes of a course, m."""
    return [definition.value(f"{node}_x") or 0.0 for node in definition.nodes]


def _nearest(corners: dict[float, bool], x: float) -> bool:
    return any(corner for at, corner in corners.items() if abs(at - x) <= _ONE_NODE)


def _piece(definition: FormDefinition, x: float) -> int:
    """Give the piece of a course at an abscissa, the first or last beyond its ends."""
    stands = _stands(definition)
    return min(max(int(np.searchsorted(stands, x)) - 1, 0), max(len(stands) - 2, 0))


def _stops(forms: Forms) -> list[tuple[float, str]]:
    """Give where the pieces of the deck edge begin and end, and whose node is there."""
    side, height = (forms.definitions[use] for use in ("deck_side", "deck_height"))
    mine, other = _stands(side), _stands(height)
    low, high = mine[0], mine[-1]
    if len(mine) < 2:
        raise BadInputError(
            "the course has one node", f"in the definition {side.name!r}", "give it two ends"
        )
    if len(other) > 1 and not (other[0] <= low + _ONE_NODE and other[-1] >= high - _ONE_NODE):
        raise BadInputError(
            f"the course from x = {other[0]:g} to {other[-1]:g} m is shorter than the deck edge "
            f"from {low:g} to {high:g} m", f"in the definition {height.name!r}", "extend it",
        )  # fmt: skip
    found = [(x, "both" if any(abs(x - o) <= _ONE_NODE for o in other) else "side") for x in mine]
    found += [
        (x, "height") for x in other if low < x < high and all(abs(x - m) > _ONE_NODE for m in mine)
    ]
    return sorted(found)


# --------------------------------------------------------------------------------------
# Waterlines, buttocks: between the two places where they come onto a flat and leave it they are
# straight.

_LEAST_FLAT = 0.1
"""A shorter flat (m) is none."""


def water_layout(forms: Forms, z: float) -> str:
    """Give the flat that a waterline at height z (m) runs along.

    ``"side"`` is the flat of side, ``"parallel"`` the parallel middle body below it, ``""`` none.
    """
    if _side(forms, z) is not None:
        return "side"
    if forms.has("bilge_radius") and z <= forms.particulars.draught:
        low, high = span_of(forms)
        if high - low > _LEAST_FLAT and math.isfinite(breadth_at(forms, z)):
            return "parallel"
    return ""


def buttock_layout(forms: Forms, y: float) -> str:
    """Give ``"bottom"`` where a buttock at y (m) runs along the flat of bottom, else ``""``."""
    return "" if _bottom(forms, y) is None else "bottom"


def flat_points(forms: Forms, what: str, layout: str, place: float) -> FloatArray:
    """Give the two places, (2, 3) m, where a line comes onto its flat and leaves it.

    `what` is a waterline at z = `place` (m) or a buttock at y, `layout` from `water_layout` or
    `buttock_layout`; nan where the flat no longer reaches so far.
    """
    if what == "buttock":
        level = _bottom(forms, place)
        return np.full((2, 3), math.nan) if level is None else level
    z = place
    found = np.full((2, 3), z)
    if layout == "side":
        ends = _side(forms, z)
        found[:, 0] = (math.nan, math.nan) if ends is None else ends
        found[:, 1] = 0.5 * forms.particulars.breadth
    else:
        found[:, 0] = span_of(forms)
        found[:, 1] = breadth_at(forms, z)
    return found


def _side(forms: Forms, z: float) -> tuple[float, float] | None:
    """Give where (x, m) the flat of side begins and ends at a height."""
    if not forms.has("flat_of_side"):
        return None
    chain = forms.chain("flat_of_side")
    places = chain.meets(1, z)
    if len(places) != 2:
        return None
    piece, t = (np.array(each) for each in zip(*places, strict=True))
    low, high = chain.at(piece, t)[:, 0].tolist()
    between = float(chain.ordinate(np.array([0.5 * (low + high)]))[0])
    # the border of the flat must lie below the waterline between them: the flat is above its border
    return (low, high) if high - low > _LEAST_FLAT and between < z else None


def _bottom(forms: Forms, y: float) -> FloatArray | None:
    """Give where a buttock comes onto the flat of bottom and leaves it, (2, 3) m."""
    if not forms.has("flat_of_bottom"):
        return None
    chain = forms.chain("flat_of_bottom")
    places = chain.meets(1, y)
    if len(places) != 2:
        return None
    piece, t = (np.array(each) for each in zip(*places, strict=True))
    low, high = chain.at(piece, t)[:, 0].tolist()
    if not high - low > _LEAST_FLAT:
        return None
    heights = [forms.contour(x)[:1] for x in (low, high)]
    between = float(chain.ordinate(np.array([0.5 * (low + high)]))[0])
    # on a raked keel the line is not level where it leaves the flat
    if heights[0] != heights[1] or not heights[0] or between <= y:
        return None
    return np.array([(x, y, heights[0][0]) for x in (low, high)])


# --------------------------------------------------------------------------------------
# Sections, and any line by what it is. The pieces of sections:
#
# ==========  ==========================================================================
# level       flat of bottom, from the contour outward
# siding      half siding, from the contour outward to a corner
# curve       from there to the flat of side, or to the draught
# arc         the bilge of the parallel middle body
# upright     flat of side up to the draught
# bulb        the bulb up to its neck
# upper       from the neck to the draught
# round       a bulb that closes, ahead of the stem
# topside     to the flat of side, or to the deck edge
# wall        along the flat of side to the deck edge
# ==========  ==========================================================================

COURSES = {
    "profile": "profile",
    "deck centre": "deck_centre",
    "flat of side": "flat_of_side",
    "flat of bottom": "flat_of_bottom",
}
"""Lines that are one course in a plane, and its use."""

_LEAST_PIECE = 0.01
"""Shorter pieces of sections (m) are left out."""

_ACROSS, _UP, _AHEAD = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
_NONE = (0.0, 0.0, 0.0)

Vector = tuple[float, float, float]

_ROUND = {"bulb": (_ACROSS, None), "round": (_ACROSS, (0.0, -1.0, 0.0))}
"""The directions in which pieces start and end square to the centre plane."""

_STRAIGHT = {"level": _ACROSS, "upright": _UP, "up": _UP, "down": (0.0, 0.0, -1.0), "ahead": _AHEAD}
"""The direction in which pieces that are straight by their nature run."""


def layout_at(forms: Forms, what: str, place: float, part: int = 0) -> str:
    """Give the layout of a line; empty where nothing is generated on a line.

    `place` (m) is x of a section, z of a waterline, y of a buttock, without meaning for others;
    `part` is the number of the curve, from below, of a section in several.

    Raises
    ------
    BadInputError
        A definition that is needed is missing, or does not reach so far.
    """
    if what in ("section", "transom"):
        return _section(forms, place, part)
    if what == "waterline":
        return water_layout(forms, place)
    if what == "buttock":
        return buttock_layout(forms, place)
    if what == "deck edge":
        return deck_layout(forms)
    if what in COURSES:
        return course_layout(forms.needed(COURSES[what], f"for the {what}"))
    raise BadInputError(f"{what!r} cannot be generated", "in a net", "generate a section")


def _section(forms: Forms, x: float, part: int) -> str:
    where = f"at the section x = {x:g} m"
    heights = forms.contour(x)
    if not heights:
        raise BadInputError("the profile does not reach so far", where, "extend it")
    below = bulb_layout(forms, x, part, heights)
    if below == "round":
        return below
    deck = float(forms.value("deck_height", x)[0])
    draught = forms.particulars.draught
    if not deck > max(draught, heights[-1]) + _LEAST_PIECE:
        raise BadInputError(
            f"the deck edge at z = {deck:g} m is not above the draught and the contour", where,
            "raise deck_height, or let it reach so far",
        )  # fmt: skip
    if heights[0] > draught - _LEAST_PIECE or below == "":
        return "topside"
    if forms.has("bilge_radius") and in_middle_body(forms, x):
        return "level+arc+upright+topside"
    side = float(forms.value("flat_of_side", x)[0])
    if below:
        return f"{below}+topside" + (
            "+wall" if draught + _LEAST_PIECE < side < deck - _LEAST_PIECE else ""
        )
    first = _first(forms, x)
    if side < draught - _LEAST_PIECE:
        return f"{first}curve+upright+topside"
    if draught + _LEAST_PIECE < side < deck - _LEAST_PIECE:
        return f"{first}curve+topside+wall"
    return f"{first}curve+topside"


def _first(forms: Forms, x: float) -> str:
    """Give the piece that lies level beside the contour, with its ``+``; empty if there is none."""
    if float(forms.value("flat_of_bottom", x, 0.0)[0]) > _LEAST_PIECE:
        return "level+"
    if float(forms.value("half_siding", x, 0.0)[0]) > _LEAST_PIECE:
        return "siding+"
    return ""


def joints_of(layout: str) -> list[tuple[PointKind, Vector]]:
    """Give kind and direction at the joints between the pieces of a layout."""
    tokens = layout.split("+")
    found = []
    for before, after in itertools.pairwise(tokens):
        old, new = before.partition(":")[0].rstrip("^"), after.partition(":")[0].rstrip("^")
        if old == "siding" or after.endswith("^"):
            found.append((PointKind.KNUCKLE, _NONE))
        elif old in _STRAIGHT or new in _STRAIGHT:
            found.append((PointKind.TANGENT, _STRAIGHT.get(old) or _STRAIGHT[new]))
        elif new == "wall":
            found.append((PointKind.TANGENT, _UP))
        else:
            found.append((PointKind.SMOOTH, _NONE))
    return found


def ends_for(layout: str) -> Ends:
    """Give the end conditions of a line of a layout: tangent where a straight piece ends it."""
    tokens = [each.partition(":")[0].rstrip("^") for each in layout.split("+")]
    given = [_STRAIGHT.get(token) for token in (tokens[0], tokens[-1])]
    # a bulb starts square to the centre plane, and one that closes ends so
    first, last = _ROUND.get(tokens[0], (None, None))
    given = [first or given[0], last or given[1]]
    kinds = [EndKind.FREE if each is None else EndKind.TANGENT for each in given]
    return Ends((kinds[0], kinds[1]), (given[0] or _NONE, given[1] or _NONE))
