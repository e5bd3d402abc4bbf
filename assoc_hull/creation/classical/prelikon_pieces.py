"""The pieces of a curve of lines and arcs, as an outline of the net takes them.

Lines stay straight. An arc that meets a line or another arc in one direction stays an arc, within
0.01 mm. Where arcs meet at small angles, as mean circles do, the kernel's own smooth curve runs
through the given points; where a curve turns sharply, or a knuckle is given, it has a corner.

Examples
--------
>>> from assoc_hull.creation.classical.prelikon_pieces import pieces_of
>>> from assoc_hull.geometry.classical.arc_section import round_corners
>>> bilge = round_corners([(0, 0), (10, 0), (10, 9)], radius=[2.5])
>>> [len(each.points) for each in pieces_of(bilge)]
[2, 13, 2]
"""

from __future__ import annotations

from enum import IntEnum

import attrs
import numpy as np

from assoc_hull.creation.classical.outline import Piece, circular, smooth, straight
from assoc_hull.geometry.classical.arc_curve import ArcCurve
from assoc_hull.geometry.curves import FloatArray

__all__ = ["CORNER", "Joint", "joints_of", "pieces_of"]

CORNER = np.radians(5.0)
"""A curve that turns by more (rad) from one piece to the next has a corner there."""

_ONE = 2e-5
"""Directions (rad) that differ by less are one: decimals of a text are no corners."""

_WITHIN = 5e-6
"""How far (m) the points of an arc are laid out for; joints take as much again."""

_NEAREST = 0.015
"""Toward a corner the points of an arc lie at half the distance each time, down to this (m)."""


class Joint(IntEnum):
    """How two pieces go over into one another in the net."""

    TANGENT = 0
    SMOOTH = 1
    CORNER = 2


def joints_of(curve: ArcCurve) -> tuple[Joint, ...]:
    """Tell how the net passes the joints between the pieces of a curve.

    Parameters
    ----------
    curve : ArcCurve
        Of n pieces.

    Returns
    -------
    tuple of Joint
        n - 1 of them.
    """
    turn, curved = np.abs(curve.turns()), curve.arcs.curvature != 0.0
    found = []
    for k, angle in enumerate(turn.tolist()):
        if k + 1 in curve.knuckles or angle > CORNER:
            found.append(Joint.CORNER)
        elif angle <= _ONE or curved[k] != curved[k + 1]:
            found.append(Joint.TANGENT)
        else:
            found.append(Joint.SMOOTH if curved[k] else Joint.CORNER)
    return tuple(found)


def pieces_of(curve: ArcCurve) -> list[Piece]:
    """Give the pieces of a curve for an outline.

    Parameters
    ----------
    curve : ArcCurve
        A section, or a boundary curve.
    """
    joints, arcs = joints_of(curve), curve.arcs
    starts = [0, *(k + 1 for k, each in enumerate(joints) if each != Joint.SMOOTH)]
    found = [
        _run(curve, first, last, joints)
        for first, last in zip(starts, [*starts[1:], len(arcs)], strict=True)
    ]
    return _aligned(found, [joints[k - 1] for k in starts[1:]], arcs.curvature[starts] == 0.0)


def _run(curve: ArcCurve, first: int, last: int, joints: tuple[Joint, ...]) -> Piece:
    """Give the piece of the curve from one piece up to another."""
    arcs, ends = curve.arcs, curve.joints()
    if last - first > 1:
        angles = float(arcs.angle[first]), float(arcs.end_angles()[last - 1])
        return smooth(ends[first : last + 1], *angles)
    if arcs.curvature[first] == 0.0:
        return straight(ends[first], ends[last])
    piece = circular(arcs, first, _WITHIN)
    length = float(arcs.length[first])
    along = np.linspace(0.0, length, len(piece.points))
    sides = (
        first > 0 and joints[first - 1] == Joint.CORNER,
        last < len(arcs) and joints[last - 1] == Joint.CORNER,
    )
    near = _graded(float(along[1]))
    more = [near if sides[0] else np.zeros(0), length - near if sides[1] else np.zeros(0)]
    along = np.unique(np.concatenate([along, *more]))
    points = arcs.at(np.full(len(along), first), along)
    return attrs.evolve(piece, points=points)


def _graded(step: float) -> FloatArray:
    """Give places (m) that approach nil: a spline with a free end does not bend there."""
    count = max(int(np.floor(np.log2(max(step / _NEAREST, 1.0)))), 0)
    return np.asarray(step * 0.5 ** np.arange(1, count + 1))


def _aligned(
    pieces: list[Piece], joints: list[Joint], is_line: np.typing.NDArray[np.bool_]
) -> list[Piece]:
    """Give pieces whose directions agree where they are tangent; a line keeps its own."""
    found = list(pieces)
    for k, joint in enumerate(joints):
        if joint != Joint.TANGENT:
            continue
        if is_line[k + 1]:
            found[k] = attrs.evolve(found[k], finish=found[k + 1].start)
        else:
            found[k + 1] = attrs.evolve(found[k + 1], start=found[k].finish)
    return found
