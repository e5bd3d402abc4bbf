"""Layouts and shapes of lines that are courses themselves: profile, deck edge, borders of flats.

Pieces of their layouts: ``ahead``, ``up`` and ``down`` are straight along an axis, ``form`` is any
other; ``^`` after a piece says that it begins at a corner. On the deck edge, the course of
half-breadths is parted at the nodes of the course of heights as well; ``:`` and a letter tell
whose node a piece begins at: that of the side, of the height, or of both.

Examples
--------
>>> from assoc_hull.model.forms.course_layout import course_layout
>>> from assoc_hull.model.definition_part import FormDefinition
>>> stem = FormDefinition(
...     "contour", "profile", "course", nodes=("A", "B", "C"), values={
...         "A_x": 0.0, "A_y": 0.0, "A_angle_deg": 0.0, "B_x": 170.0, "B_y": 0.0,
...         "B_angle_deg": 0.0, "C_x": 180.0, "C_y": 10.0, "C_angle_deg": 80.0})
>>> course_layout(stem)
'ahead+form'
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.model.definition_part import FormDefinition
from assoc_hull.model.forms.courses import corners_of
from assoc_hull.model.forms.forms import Forms

__all__ = ["CourseShape", "DeckShape", "course_layout", "course_shape", "deck_layout", "deck_shape"]

_ONE_NODE = 1e-6
"""Nodes of two courses nearer than this (m) are one."""

_AXES = {"profile": (0, 2, 1), "deck_centre": (0, 2, 1), "flat_of_side": (0, 2, 1),
         "flat_of_bottom": (0, 1, 2)}  # fmt: skip
"""By use: on which axes abscissa and ordinate lie, and the axis across the plane."""


def course_layout(definition: FormDefinition) -> str:
    """Give the layout of a line that is one course.

    Parameters
    ----------
    definition : FormDefinition
        The course.

    Returns
    -------
    str
    """
    corners = corners_of(definition)
    tokens = [
        _token(definition, i) + ("^" if i and corners[i] else "")
        for i in range(len(definition.nodes) - 1)
    ]
    return "+".join(tokens) or "form"


def _token(definition: FormDefinition, piece: int) -> str:
    """Tell whether a piece runs along an axis."""
    first, last = definition.nodes[piece : piece + 2]
    x0, y0, x1, y1 = (
        definition.value(f"{node}_{each}") or 0.0 for node in (first, last) for each in ("x", "y")
    )
    leave = definition.value(f"{first}_leave_angle_deg")
    angles = {
        definition.value(f"{first}_angle_deg") if leave is None else leave,
        definition.value(f"{last}_angle_deg"),
    }
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
        On which axes abscissa and ordinate lie, and the axis across the plane.
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
        return found + 0.0


def course_shape(forms: Forms, use: str) -> CourseShape:
    """Give the shape of a line that is one course.

    Parameters
    ----------
    forms : Forms
        The definitions.
    use : str
        Of the course. A flat of side lies at half the breadth, a flat of bottom on the lowest
        place of the profile.

    Returns
    -------
    CourseShape
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
        number, low, high = (np.array(each)[piece] for each in zip(*self.spans, strict=True))
        share = (high - low) / 4.0
        return number, low + share * t, share


def deck_layout(forms: Forms) -> str:
    """Give the layout of the deck edge.

    Parameters
    ----------
    forms : Forms
        The definitions.

    Returns
    -------
    str
    """
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
    """Give the shape of the deck edge.

    Parameters
    ----------
    forms : Forms
        The definitions.

    Returns
    -------
    DeckShape
    """
    side, height = forms.chain("deck_side"), forms.chain("deck_height")
    stops = np.array([x for x, _ in _stops(forms)])
    middle = 0.5 * (stops[:-1] + stops[1:])
    piece = side.place(middle)[0]
    knots = side.at(np.arange(side.count), np.zeros(side.count))[:, 0]
    spans = []
    for i, number in enumerate(piece.tolist()):
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
    """Give where the nodes of a course stand."""
    return [definition.value(f"{node}_x") or 0.0 for node in definition.nodes]


def _nearest(corners: dict[float, bool], x: float) -> bool:
    return any(corner for at, corner in corners.items() if abs(at - x) <= _ONE_NODE)


def _piece(definition: FormDefinition, x: float) -> int:
    """Give the piece of a course at an abscissa."""
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
