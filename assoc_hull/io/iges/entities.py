"""What entities of an IGES file have in common: names, units, transformations, splines.

Names are properties 406 form 15, transformations entities 124, splines entities 126 and 128. A
spline is given as it stands in the file, before it is moved, in units of the file.

Source: IGES 5.3 (US PRO, 1996), sections 2.2.4.3 (units), 4.21, 4.23, 4.24 and 4.104 (names).
"""

from __future__ import annotations

import contextlib
from typing import Self

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.io.iges.file import UNITS, IgesFile, IgesRecord
from assoc_hull.io.units import METRES, unit_note

__all__ = [
    "IDENTITY",
    "IgesCurve",
    "IgesSurface",
    "Transformation",
    "name_property",
    "property_pointers",
    "readable_name",
    "scale_note",
    "spline_curve",
    "spline_surface",
    "transformation_of",
    "unit_of",
]

# --------------------------------------------------------------------------------------
# Units and names.


def unit_of(file: IgesFile, unit: str | None) -> tuple[str, float, tuple[str, ...]]:
    """Give the unit: its name, the length of one of the file in m, and what is to be reported.

    `unit` is the one that was asked for; None: as the file says.

    Raises
    ------
    BadInputError
        Neither tells one.
    """
    if unit is not None:
        told = UNITS[file.unit][0] if file.metres is not None else None
        return unit, METRES[unit] / file.scale, unit_note(file.source, told, unit)
    if file.metres is None:
        what = f"the file tells no unit of length (its flag is {file.unit})"
        raise BadInputError(what, f"in {file.source}", f"give unit: {', '.join(METRES)}")
    return UNITS[file.unit][0], file.metres / file.scale, ()


def scale_note(file: IgesFile) -> tuple[str, ...]:
    """Report a scale of the model, if there is one."""
    if file.scale == 1.0:
        return ()
    return (f"{file.source} has a model scale of {file.scale:g}: lengths are divided by it.",)


def readable_name(name: str) -> str:
    """Give a name as it was meant: the file was decoded as latin-1, and may be UTF-8."""
    with contextlib.suppress(UnicodeError):
        name = name.encode("latin-1").decode("utf-8")
    return "".join(letter for letter in name if letter.isprintable()).strip()


def property_pointers(file: IgesFile, record: IgesRecord, after: int) -> tuple[int, ...]:
    """Give the numbers of the properties of an entity; as `name_property`."""
    if len(record) <= after + 1:
        return ()
    groups = record.count(after, "the number of groups", len(file.entries))
    if len(record) <= after + 1 + groups:
        return ()
    count = record.count(after + 1 + groups, "the number of properties", len(file.entries))
    return record.pointers(after + 2 + groups, count, "the properties")


def name_property(file: IgesFile, record: IgesRecord, after: int) -> str:
    """Give the name that a property, entity 406 of form 15, gives an entity; empty if none.

    Pointers to groups, then to properties, begin at the value `after` of its record.

    Raises
    ------
    BadInputError
        The pointers are damaged.
    """
    for each in property_pointers(file, record, after):
        entry = file.entries.get(each)
        if entry is not None and (entry.kind, entry.form) == (406, 15):
            return file.record(each).text(2)
    return ""


# --------------------------------------------------------------------------------------
# Transformations, entity 124: a point x becomes R x + T, and then what the transformation of the
# transformation makes of it.

_RIGID = 1e-6
"""A matrix may be this far from a rotation: files with nine digits are nearer."""


@attrs.frozen(eq=False)
class Transformation:
    """A matrix (3, 3) and a shift (3,), in units of the file."""

    matrix: FloatArray
    shift: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.matrix, self.shift)

    def of(self, points: FloatArray) -> FloatArray:
        """Move points (..., 3)."""
        if self is IDENTITY:
            return points
        moved: FloatArray = np.einsum("ij,...j->...i", self.matrix, points) + self.shift
        return moved

    def then(self, other: Transformation) -> Transformation:
        """Give this motion and another after it."""
        if self is IDENTITY or other is IDENTITY:
            return other if self is IDENTITY else self
        return Transformation(other.matrix @ self.matrix, other.matrix @ self.shift + other.shift)

    @property
    def stretch(self) -> float:
        """By which part it changes lengths at most; rotations and reflections do not."""
        sizes = np.linalg.svd(self.matrix, compute_uv=False)
        found = float(np.abs(sizes - 1.0).max())
        return found if found > _RIGID else 0.0

    @classmethod
    def still(cls) -> Self:
        """Give the motion that moves nothing."""
        return cls(np.eye(3), np.zeros(3))


IDENTITY = Transformation.still()


def transformation_of(file: IgesFile, number: int) -> Transformation:
    """Give the motion of an entity 124, by its directory number; 0 moves nothing.

    It holds those that the transformation is moved by itself.

    Raises
    ------
    BadInputError
        The chain runs in a ring, leads to something else, or its matrix flattens space.
    """
    found, met = IDENTITY, list[int]()
    while number:
        if number in met:
            ring = " -> ".join(f"D{each}" for each in [*met, number])
            what = f"transformations run in a ring: {ring}"
            raise BadInputError(what, f"in {file.source}", "export the file again")
        met.append(number)
        found = found.then(_one(file, number))
        number = file.entries[number].transformation
    return found


def _one(file: IgesFile, number: int) -> Transformation:
    record = file.record(number)
    if file.entries[number].kind != 124:
        what = "this is to be a transformation, and is none"
        raise BadInputError(what, record.where, "export the file again")
    rows = record.reals(1, 12, "the matrix").reshape(3, 4)
    found = Transformation(rows[:, :3].copy(), rows[:, 3].copy())
    sizes = np.linalg.svd(found.matrix, compute_uv=False)
    if not 1e-6 < sizes[-1] <= sizes[0] < 1e6:
        what = f"the matrix stretches by {sizes[-1]:.3g} to {sizes[0]:.3g}"
        raise BadInputError(what, record.where, "a matrix that turns is wanted")
    return found


# --------------------------------------------------------------------------------------
# Splines, entities 126 and 128.

_MOST_POINTS, _MOST_DEGREE = 100_000, 25

_POINT = 1e-9
"""A side of this part of the size of a surface is a point."""


@attrs.frozen(eq=False)
class IgesCurve:
    """A spline curve.

    Attributes
    ----------
    degree : int
        Of the pieces.
    knots : (k + degree + 1,)
        In order.
    weights : (k,)
        Above 0.
    points : (k, 3)
        In units of the file; before it is moved.
    span : (float, float)
        The parameters where it begins and ends.
    """

    degree: int
    knots: FloatArray
    weights: FloatArray
    points: FloatArray
    span: tuple[float, float]


@attrs.frozen(eq=False)
class IgesSurface:
    """A spline surface.

    Attributes
    ----------
    degrees : (int, int)
        In u and v.
    knots : ((i + m + 1,), (j + n + 1,))
        In u and v, in order.
    weights : (i, j)
        Above 0.
    net : (i, j, 3)
        In units of the file; before it is moved.
    spans : ((float, float), (float, float))
        The parameters u and v that it is bounded by.
    after : int
        How many values of the record it takes: what comes then are pointers to properties.
    """

    degrees: tuple[int, int]
    knots: tuple[FloatArray, FloatArray]
    weights: FloatArray
    net: FloatArray
    spans: tuple[tuple[float, float], tuple[float, float]]
    after: int

    @property
    def points(self) -> NDArray[np.bool_]:
        """Whether it is a point along its sides, (2, 2): least u, greatest u; least v, greatest v.

        Only of surfaces that are not bounded within their knots, which are repeated at the ends.
        """
        size = float(np.ptp(self.net.reshape(-1, 3), axis=0).max())
        rows = ((self.net[0], self.net[-1]), (self.net[:, 0], self.net[:, -1]))
        found = [
            [
                bool(
                    np.ptp(row, axis=0).max() <= _POINT * size
                    and each[0] == each[degree]
                    and each[-1] == each[-1 - degree]
                    and tuple(span) == (each[0], each[-1])
                )
                for row in pair
            ]
            for pair, each, degree, span in zip(
                rows, self.knots, self.degrees, self.spans, strict=True
            )
        ]
        return np.array(found)


def spline_curve(record: IgesRecord) -> IgesCurve:
    """Read an entity 126.

    Raises
    ------
    BadInputError
        Values are missing, or are no spline.
    """
    (count,), (degree,) = _sizes(record, 1)
    at, (knots,) = _knots(record, 7, (count,), (degree,))
    weights = _weights(record, at, count)
    points = record.reals(at + count, 3 * count, "the control points").reshape(count, 3)
    (span,) = _spans(record, at + 4 * count, (knots,), (degree,))
    return IgesCurve(degree, knots, weights, points, span)


def spline_surface(record: IgesRecord) -> IgesSurface:
    """Read an entity 128; u runs fastest in the file, and last in the net.

    Raises
    ------
    BadInputError
        Values are missing, or are no spline.
    """
    (rows, columns), (m, n) = _sizes(record, 2)
    at, knots = _knots(record, 10, (rows, columns), (m, n))
    count = rows * columns
    weights = _weights(record, at, count).reshape(columns, rows).T
    points = record.reals(at + count, 3 * count, "the control points")
    net = points.reshape(columns, rows, 3).swapaxes(0, 1)
    spans = _spans(record, at + 4 * count, knots, (m, n))
    return IgesSurface(
        (m, n), (knots[0], knots[1]), weights.copy(), net.copy(), (spans[0], spans[1]),
        at + 4 * count + 4,
    )  # fmt: skip


def _sizes(record: IgesRecord, ways: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Give the numbers of control points and the degrees, one in each direction."""
    names = "uv"[:ways]
    counts = tuple(
        1 + record.count(1 + i, f"the upper index of {name}", _MOST_POINTS - 1)
        for i, name in enumerate(names)
    )
    degrees = tuple(
        record.count(1 + ways + i, f"the degree in {name}", _MOST_DEGREE)
        for i, name in enumerate(names)
    )
    for count, degree in zip(counts, degrees, strict=True):
        if not 1 <= degree < count:
            what = f"the degree is {degree} and there are {count} control points in a row"
            raise BadInputError(what, record.where, "a degree of 1 or more needs one point more")
    wanted = int(np.prod(counts))
    if wanted > len(record):
        what = f"{wanted} control points are announced, and the record has {len(record)} values"
        raise BadInputError(what, record.where, "export the file again")
    return counts, degrees


def _knots(
    record: IgesRecord, at: int, counts: tuple[int, ...], degrees: tuple[int, ...]
) -> tuple[int, tuple[FloatArray, ...]]:
    """Give the place in the record behind all knots, and the knots of each direction."""
    found = []
    for count, degree in zip(counts, degrees, strict=True):
        size = count + degree + 1
        knots = record.reals(at, size, "the knots")
        fall = int(np.argmax(np.diff(knots) < 0.0))
        if knots[fall + 1] < knots[fall]:
            what = f"knot {fall + 2} is {knots[fall + 1]:g}, below {knots[fall]:g} before it"
            raise BadInputError(what, record.where, "knots must not fall")
        if not knots[degree] < knots[count]:
            what = f"the knots run from {knots[degree]:g} to {knots[count]:g}"
            raise BadInputError(what, record.where, "knots must rise")
        found.append(knots)
        at += size
    return at, tuple(found)


def _weights(record: IgesRecord, at: int, count: int) -> FloatArray:
    weights = record.reals(at, count, "the weights", default=1.0)
    if not (weights > 0.0).all():
        what = f"weight {int(np.argmin(weights)) + 1} is {weights.min():g}"
        raise BadInputError(what, record.where, "weights must be above 0")
    return weights


def _spans(
    record: IgesRecord, at: int, knots: tuple[FloatArray, ...], degrees: tuple[int, ...]
) -> list[tuple[float, float]]:
    """Give the parameters that bound it; an end that lost a digit is moved onto the knots."""
    ends = record.reals(at, 2 * len(knots), "the bounds of the parameters").reshape(-1, 2)
    found = []
    for (low, high), each, degree in zip(ends.tolist(), knots, degrees, strict=True):
        first, last = float(each[degree]), float(each[-degree - 1])
        slack = 1e-6 * (last - first)
        if not (first - slack <= low < high <= last + slack):
            what = f"the parameters are bounded by {low:g} and {high:g}"
            remedy = f"the knots allow {first:g} to {last:g}"
            raise BadInputError(what, record.where, remedy)
        found.append(
            (first if low <= first + slack else low, last if high >= last - slack else high)
        )
    return found
