"""Courses: curves of labelled nodes in natural units, by one of four rules.

- ``straight``: straight from node to node.
- ``monotone``: single cubics; slopes that are not given are those of Fritsch and Carlson, by which
  nothing rises or falls that does not do so from node to node. F.N. Fritsch, R.E. Carlson,
  "Monotone piecewise cubic interpolation", SIAM J. Numer. Anal. 17(2), 1980.
- ``spline``: single cubics with continuous second derivatives; at an end without an angle there is
  none.
- ``form``: form-parameter curves of least int of the squared third derivative; an angle that is
  not given is that of the parabola through a node and its neighbours, at an end of an arc.

A node with a ``leave_...`` value is a corner: there a course is parted.

Examples
--------
>>> from assoc_hull.model.forms.courses import course_vertices
>>> from assoc_hull.model.form_definition import FormDefinition
>>> angle = FormDefinition(
...     "angle", "waterline_angle", "course", rule="straight", nodes=("AP", "FP"),
...     values={"AP_x": 0.0, "AP_y": 30.0, "FP_x": 180.0, "FP_y": 0.0},
... )
>>> course_vertices(angle).shape
(1, 7, 2)
"""

from __future__ import annotations

import itertools
import math

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import cubic_vertices, straight_vertices
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.model.form_definition import NODE_FIELDS, FormDefinition

__all__ = ["corners_of", "course_vertices"]

_LEAST_STEP = 1e-6
"""Nodes nearer than this (m) are one."""

_FAR = 1e4
"""So far (m) to both sides a course of one node runs level."""


@attrs.frozen
class _Node:
    """The values of a node."""

    label: str
    x: float
    y: float
    angle_deg: float | None
    curvature: float | None
    tangent: float | None
    leave_angle_deg: float | None
    leave_curvature: float | None
    leave_tangent: float | None

    @property
    def corner(self) -> bool:
        """Whether the course may turn a corner here."""
        return self.leave_angle_deg is not None


def course_vertices(definition: FormDefinition) -> FloatArray:
    """Give the vertices of the pieces between the nodes of a course.

    Parameters
    ----------
    definition : FormDefinition
        A course.

    Returns
    -------
    (m, 7, 2)
        In its own units. A course of one node is level, far to both sides.

    Raises
    ------
    BadInputError
        No node, a node without x or y, two nodes in one place, angles where the rule has
        none, abscissae out of order where the rule is ``monotone`` or ``spline``.
    """
    where = f"in the definition {definition.name!r}"
    nodes = _nodes(definition, where)
    if len(nodes) == 1:
        x, y = nodes[0].x, nodes[0].y
        return straight_vertices((x - _FAR, y), (x + _FAR, y))[None]
    points = np.array([(node.x, node.y) for node in nodes])
    step = np.diff(points, axis=0)
    chord = np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1])
    for number in np.flatnonzero(chord < _LEAST_STEP).tolist():
        raise BadInputError(
            f"the nodes {nodes[number].label!r} and {nodes[number + 1].label!r} are in one place",
            where, "leave one out",
        )  # fmt: skip
    if definition.rule == "straight":
        _no_angles(nodes, where)
        return straight_vertices(points[:-1], points[1:])
    if definition.rule == "monotone":
        return _joined(points, *_monotone_slopes(nodes, _secants(nodes, points, where)))
    if definition.rule == "spline":
        return _joined(points, *_spline_slopes(nodes, _secants(nodes, points, where)))
    return _form(nodes, points, chord)


def corners_of(definition: FormDefinition) -> tuple[bool, ...]:
    """Tell at which nodes a course is parted: at all of a straight one, else where it leaves anew.

    Parameters
    ----------
    definition : FormDefinition
        A course.

    Returns
    -------
    tuple of bool
        One a node.
    """
    if definition.rule == "straight":
        return (True,) * len(definition.nodes)
    return tuple(
        definition.value(f"{node}_leave_angle_deg") is not None for node in definition.nodes
    )


def _nodes(definition: FormDefinition, where: str) -> list[_Node]:
    if not definition.nodes:
        raise BadInputError("the course has no nodes", where, "give at least one")
    found = []
    for label in definition.nodes:
        values = {field: definition.value(f"{label}_{field}") for field in NODE_FIELDS}
        for field in ("x", "y"):
            if values[field] is None:
                raise BadInputError(f"{label}_{field} is None", where, "give a number")
        for field in ("tangent", "leave_tangent"):
            factor = values[field]
            if factor is not None and not factor > 0.0:
                raise BadInputError(
                    f"{label}_{field} is {factor:g}", where, "give a factor above 0, or None for 1"
                )
        found.append(_Node(label, **values))  # type: ignore[arg-type]
    return found


def _no_angles(nodes: list[_Node], where: str) -> None:
    for node in nodes:
        for field in NODE_FIELDS[2:]:
            if getattr(node, field) is not None:
                raise BadInputError(
                    f"{node.label}_{field} is given to a straight course", where,
                    "leave it None, or take the rule 'form'",
                )  # fmt: skip


def _slope(angle_deg: float | None) -> float:
    if angle_deg is None:
        return math.nan
    return math.tan(math.radians(angle_deg)) if angle_deg else 0.0


Secants = tuple[FloatArray, FloatArray]
"""Slope and width of each piece."""


def _secants(nodes: list[_Node], points: FloatArray, where: str) -> Secants:
    """Give slopes and widths of the pieces of a course whose nodes rise in x."""
    width = np.diff(points[:, 0])
    if not (width > 0.0).all():
        number = int(np.flatnonzero(~(width > 0.0))[0])
        raise BadInputError(
            f"the node {nodes[number + 1].label!r} does not lie ahead of the one before it",
            where, "give the nodes by rising x",
        )  # fmt: skip
    return np.diff(points[:, 1]) / width, width


def _joined(points: FloatArray, arrive: FloatArray, leave: FloatArray) -> FloatArray:
    """Join nodes by single cubics with slopes at which each is arrived at and left."""
    # Derivatives are by t, which runs from 0 to 4: a quarter of the width is an even pace in x.
    pace = 0.25 * np.diff(points[:, 0])
    return cubic_vertices(
        points[:-1], points[1:],
        np.stack([pace, pace * leave[:-1]], axis=1), np.stack([pace, pace * arrive[1:]], axis=1),
    )  # fmt: skip


def _given_slopes(nodes: list[_Node]) -> tuple[FloatArray, FloatArray]:
    """Give the slopes with which nodes are arrived at and left, nan where none is given."""
    given = [(_slope(node.angle_deg), _slope(node.leave_angle_deg)) for node in nodes]
    # A node without a value for leaving is left as it was arrived at.
    leave = [before if math.isnan(after) else after for before, after in given]
    return np.array([before for before, _ in given]), np.array(leave)


def _monotone_slopes(nodes: list[_Node], secants: Secants) -> tuple[FloatArray, FloatArray]:
    """Give slopes of single cubics without overshoot."""
    secant, width = secants
    arrive, leave = _given_slopes(nodes)
    for i in range(1, len(nodes) - 1):
        # At a corner neither side knows the slope of the other.
        if not nodes[i].corner:
            free = _inner_slope(secant, width, i)
            arrive[i] = free if math.isnan(arrive[i]) else arrive[i]
            leave[i] = free if math.isnan(leave[i]) else leave[i]
    for i in range(len(secant)):
        # At an end nothing else is known: the parabola that ends with the slope at the other end.
        if math.isnan(leave[i]) and math.isnan(arrive[i + 1]):
            leave[i] = arrive[i + 1] = secant[i]
        elif math.isnan(leave[i]):
            leave[i] = _bounded(1.5 * secant[i] - 0.5 * arrive[i + 1], secant[i])
        elif math.isnan(arrive[i + 1]):
            arrive[i + 1] = _bounded(1.5 * secant[i] - 0.5 * leave[i], secant[i])
    return arrive, leave


def _spline_slopes(nodes: list[_Node], secants: Secants) -> tuple[FloatArray, FloatArray]:
    """Give slopes of cubics whose second derivatives meet where no slope is given."""
    secant, width = secants
    arrive, leave = _given_slopes(nodes)
    last = len(nodes) - 1
    stops = [0, *(i for i in range(1, last) if nodes[i].corner or arrive[i] == arrive[i]), last]
    for low, high in itertools.pairwise(stops):
        count = high - low + 1
        matrix, right = np.zeros((count, count)), np.zeros(count)
        for i in range(1, count - 1):
            one, two = width[low + i - 1], width[low + i]
            matrix[i, i - 1 : i + 2] = two, 2.0 * (one + two), one
            right[i] = 3.0 * (two * secant[low + i - 1] + one * secant[low + i])
        ends = ((0, 1, leave[low], secant[low]), (-1, -2, arrive[high], secant[high - 1]))
        for end, beside, given, chord in ends:
            matrix[end, end] = 1.0
            right[end] = given
            if math.isnan(given):
                # No second derivative at the end.
                matrix[end, beside], right[end] = 0.5, 1.5 * chord
        found = np.linalg.solve(matrix, right)
        leave[low:high], arrive[low + 1 : high + 1] = found[:-1], found[1:]
    return arrive, leave


def _inner_slope(secant: FloatArray, width: FloatArray, i: int) -> float:
    """Give the slope at a node between two others: a harmonic mean of the secants, or level."""
    one, two = float(secant[i - 1]), float(secant[i])
    if one * two <= 0.0:
        return 0.0
    a, b = 2.0 * float(width[i]) + float(width[i - 1]), float(width[i]) + 2.0 * float(width[i - 1])
    return (a + b) / (a / one + b / two)


def _bounded(slope: float, secant: float) -> float:
    """Keep a slope between level and three times the secant."""
    low, high = sorted((0.0, 3.0 * float(secant)))
    return min(max(slope, low), high)


def _form(nodes: list[_Node], points: FloatArray, chord: FloatArray) -> FloatArray:
    """Join nodes by form-parameter curves."""
    angles = _angles(nodes, points, chord)
    start, finish = (
        [
            (node.x, node.y, angle, bend or 0.0, 0.25 * size * (pace or 1.0))
            for node, angle, bend, size, pace in ends
        ]
        for ends in (
            [
                (node, angles[i][0], _leaving(node, "curvature"), c, _leaving(node, "tangent"))
                for i, (node, c) in enumerate(zip(nodes[:-1], chord.tolist(), strict=True))
            ],
            [
                (node, angles[i][1], node.curvature, c, node.tangent)
                for i, (node, c) in enumerate(zip(nodes[1:], chord.tolist(), strict=True))
            ],
        )
    )
    begin, end = (FormEnd.of(*np.array(each).T) for each in (start, finish))
    return form_vertices(begin, end)


def _leaving(node: _Node, field: str) -> float | None:
    """Give what holds where a node is left: its own value, else that of arriving."""
    own: float | None = getattr(node, f"leave_{field}")
    arriving: float | None = getattr(node, field)
    return arriving if own is None else own


def _angles(nodes: list[_Node], points: FloatArray, chord: FloatArray) -> list[tuple[float, float]]:
    """Give the angles (rad) at both ends of each piece."""
    step = np.diff(points, axis=0)
    secant = [math.atan2(dy, dx) for dx, dy in step.tolist()]
    free = [math.nan] * len(nodes)
    for i in range(1, len(nodes) - 1):
        if not nodes[i].corner:
            before, after = float(chord[i - 1]), float(chord[i])
            # The derivative, by chord length, of the parabola through three points.
            x, y = (step[i - 1] / before * after + step[i] / after * before).tolist()
            free[i] = math.atan2(y, x)
    found = []
    for i, along in enumerate(secant):
        first = _given(_leaving(nodes[i], "angle_deg"), free[i])
        last = _given(nodes[i + 1].angle_deg, free[i + 1])
        if math.isnan(first):
            first = along if math.isnan(last) else 2.0 * along - last
        if math.isnan(last):
            last = 2.0 * along - first
        found.append((first, last))
    return found


def _given(angle_deg: float | None, free: float) -> float:
    return free if angle_deg is None else math.radians(angle_deg)
