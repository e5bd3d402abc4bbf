"""Whether the border of a face is that of its surface: then it is not trimmed.

A border is given as curves in the parameters of the surface. The control points of a spline enclose
it, so a piece between two knots whose control points lie on one side of the box of the parameters
lies there as well; and a border on the sides of the box that covers all four of them is the box.
Nothing is sampled.

Source: IGES 5.3 (US PRO, 1996), sections 4.33 to 4.35 (141 to 144), 4.145 and 4.147 (508, 510).

Examples
--------
>>> import numpy as np
>>> from assoc_hull.io.iges.trim import is_box
>>> box = ((0.0, 1.0), (0.0, 2.0))
>>> corners = np.array([[0.0, 0], [1, 0], [1, 2], [0, 2], [0, 0]])
>>> sides = [corners[i : i + 2] for i in range(4)]
>>> is_box(sides, box), is_box(sides[:3], box)
(True, False)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.iges.file import IgesFile
from assoc_hull.io.iges.record import Record
from assoc_hull.io.iges.spline import spline_curve
from assoc_hull.io.iges.transform import motion_of

__all__ = ["Box", "borders_of_face", "is_box", "parameter_curves"]

Box = tuple[tuple[float, float], tuple[float, float]]

_NEAR = 1e-6
"""So far from a side, as a part of the box, digits that a file leaves out may put a point."""

_MOST = 10_000
_AGAIN = "export the file again"


def is_box(pieces: list[FloatArray], box: Box, points: NDArray[np.bool_] | None = None) -> bool:
    """Tell whether pieces of a closed border are the sides of a box.

    Parameters
    ----------
    pieces : list of (k, 2)
        Control points of each piece.
    box : ((float, float), (float, float))
        The least and greatest u, and v.
    points : (2, 2) bool or None
        Whether the surface is a point along the side of least u, greatest u, least v, greatest v:
        of such a side a border need not speak.
    """
    low, high = (np.array(ends) for ends in zip(*box, strict=True))
    covered = np.zeros((2, 2)) if points is None else points.astype(np.float64)
    for piece in pieces:
        place = (piece - low) / (high - low)
        on = (np.abs(place[:, :, None] - [0.0, 1.0]) < _NEAR).all(axis=0)
        if not (on.any() and (np.abs(place - 0.5) < 0.5 + _NEAR).all()):
            return False
        covered += on * np.abs(place[-1] - place[0])[::-1, None]
    return bool((covered > 1.0 - 10.0 * _NEAR).all())


def parameter_curves(file: IgesFile, number: int, met: tuple[int, ...] = ()) -> list[FloatArray]:
    """Give a curve in the parameters of a surface in pieces, each inside its control points.

    Parameters
    ----------
    file : IgesFile
        The file.
    number : int
        Of a line (110), polyline (106), spline (126), or a chain of such (102).
    met : tuple of int
        The chains that it is a part of.

    Returns
    -------
    list of (k, 2)
        Control points; empty if it is a curve of another kind.

    Raises
    ------
    BadInputError
        A damaged curve, or a chain that is a part of itself.
    """
    record = file.record(number)
    if number in met or len(met) > 20:
        raise BadInputError("chains of curves run in a ring", record.where, _AGAIN)
    entry = file.entries[number]
    if entry.kind == 102:
        count = record.count(1, "the number of curves", _MOST)
        parts = record.pointers(2, count, "the curves")
        found: list[FloatArray] = []
        for each in parts:
            more = parameter_curves(file, each, (*met, number))
            if not more:
                return []
            found += more
            if len(found) > _MOST:  # chains of chains grow without end, and no border has so many
                what = f"a border has more than {_MOST} pieces"
                raise BadInputError(what, record.where, _AGAIN)
        return found
    pieces = _pieces(record, entry.kind, entry.form)
    motion = motion_of(file, entry.transformation)
    return [motion.of(piece)[:, :2] for piece in pieces]


def _pieces(record: Record, kind: int, form: int) -> list[FloatArray]:
    """Give the pieces (k, 3) of one curve; none if its kind does not tell them."""
    if kind == 110:
        return [record.reals(1, 6, "the line").reshape(2, 3)]
    if kind == 106 and form in (1, 2, 11, 12, 63):
        return _legs(_polyline(record))
    if kind != 126:
        return []
    curve = spline_curve(record)
    d, knots = curve.degree, curve.knots
    first, last = curve.span
    held = [
        i for i in range(d, len(curve.points))
        if knots[i] < knots[i + 1] and knots[i + 1] > first and knots[i] < last
    ]  # fmt: skip
    return [curve.points[i - d : i + 1] for i in held]


def _polyline(record: Record) -> FloatArray:
    """Give the points (k, 3) of an entity 106: pairs at one height, or triples."""
    kind = record.count(1, "the kind of points", 2)
    count = record.count(2, "the number of points", _MOST)
    if kind == 2:
        return record.reals(3, 3 * count, "the points").reshape(count, 3)
    flat = record.reals(4, 2 * count, "the points").reshape(count, 2)
    return np.column_stack([flat, np.zeros(count)])


def _legs(points: FloatArray) -> list[FloatArray]:
    return [points[i : i + 2] for i in range(len(points) - 1)]


def borders_of_face(file: IgesFile, number: int) -> list[list[int]] | None:
    """Give the borders of a face, each as numbers of curves in the parameters of its surface.

    Parameters
    ----------
    file : IgesFile
        The file.
    number : int
        Of a trimmed (144), bounded (143) surface or a face (510).

    Returns
    -------
    list of list of int, or None
        None: the border is said to be that of the surface. Curves that are missing are 0.

    Raises
    ------
    BadInputError
        A damaged entity.
    """
    record = file.record(number)
    match file.entries[number].kind:
        case 144:
            return _of_trimmed(file, record)
        case 143:
            count = record.count(3, "the number of borders", _MOST)
            return [_of_boundary(file, each) for each in record.pointers(4, count, "the borders")]
        case _:
            count = record.count(2, "the number of borders", _MOST)
            return [_of_loop(file, each) for each in record.pointers(4, count, "the borders")]


def _of_trimmed(file: IgesFile, record: Record) -> list[list[int]] | None:
    """Give the borders of a trimmed surface: curves on it, entities 142."""
    outer = record.whole(2, "the flag of the border", default=0)
    count = record.count(3, "the number of holes", _MOST)
    inner = record.pointers(5, count, "the holes")
    if not outer and not count:
        return None
    ring = record.pointers(4, 1, "the border") if outer else ()
    return [[*file.record(each).pointers(3, 1, "the curve")] for each in (*ring, *inner)]


def _of_boundary(file: IgesFile, number: int) -> list[int]:
    """Give the curves of a boundary, entity 141."""
    record = file.record(number)
    count, at = record.count(4, "the number of curves", _MOST), 5
    found: list[int] = []
    for _ in range(count):
        more = record.count(at + 2, "the number of parameter curves", _MOST)
        found += record.pointers(at + 3, more, "the curves") or (0,)
        at += 3 + more
    return found


def _of_loop(file: IgesFile, number: int) -> list[int]:
    """Give the curves of a loop, entity 508: of each edge one or some, each after a flag."""
    record = file.record(number)
    count, at = record.count(1, "the number of edges", _MOST), 2
    found: list[int] = []
    for _ in range(count):
        more = record.count(at + 4, "the number of parameter curves", _MOST)
        found += record.pointers(at + 5, 2 * more, "the curves")[1::2] or (0,)
        at += 5 + 2 * more
    return found
