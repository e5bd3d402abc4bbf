"""The minor of one field whose boundaries follow chains or contours: a quotient of polynomials.

In the strip between two boundaries, with ``z = h + s g``, the minor times the gap g is a
polynomial of x and s between the nodes along the ship:

    z-field   g (1 + a + Da b) + De b'
    x-field   g (1 + e_x + De_x b) - De b' (h' + s g')
    y-field   g (1 + psi' (a + Da b))

with D the difference of the two pieces. Below and above the stack it is a function of x alone.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.certify_layer import columns, courses
from assoc_hull.variation.certificate.minor_search import Minor
from assoc_hull.variation.fields.field import Field

__all__ = ["strip_minors"]

_Mask = np.typing.NDArray[np.bool_]
_Where = tuple[
    Callable[[FloatArray], FloatArray],
    Callable[[FloatArray], _Mask],
    Callable[[FloatArray, FloatArray], _Mask],
]

_NAMES = {"x": "X_x", "y": "Y_y", "z": "Z_z"}


def strip_minors(field: Field, box: FloatArray, psi: float = 1.0, y: float = 0.0) -> list[Minor]:
    """Give the own minor of a field, strip by strip, from below the stack to above it.

    Parameters
    ----------
    field : Field
    box : (2, 3), m
    psi : float
        psi' of a y-field's tube, an extreme of it.
    y : float, m
        Where it has that, for the witness.
    """
    last = len(field.boundaries) - 1
    inner = [_strip(field, box, k, psi, y) for k in range(last)]
    return [_below(field, box, psi, y), *inner, _above(field, box, psi, y)]


def _cells(field: Field, box: FloatArray) -> tuple[FloatArray, FloatArray]:
    x = columns([field], box)
    lower = np.stack([x[:-1], np.zeros(len(x) - 1)], axis=1)
    upper = np.stack([x[1:], np.ones(len(x) - 1)], axis=1)
    return lower, upper


def _piece(
    field: Field, k: int, x: FloatArray, z: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give e, its derivative by x with the field's own coordinate held, and a."""
    piece = field.pieces[k]
    lever = (x if field.axis == "x" else z) - piece.pivot
    a, along = piece.a.at(x), piece.a.slope(x) * lever + piece.d.slope(x)
    return a * lever + piece.d.at(x), along, a


def _below(field: Field, box: FloatArray, psi: float, y: float) -> Minor:
    """Give the minor below the stack."""
    height, floor = field.boundaries[0].height, float(box[0, 2])

    def place(parameters: FloatArray) -> FloatArray:
        x, s = parameters[:, 0], parameters[:, 1]
        z = floor + s * (np.clip(height.at(x), floor, float(box[1, 2])) - floor)
        return np.stack([x, np.full_like(x, y), z], axis=1)

    def within(parameters: FloatArray) -> _Mask:
        return np.asarray(height.at(parameters[:, 0]) >= floor)

    def beyond(lower: FloatArray, upper: FloatArray) -> _Mask:
        return np.asarray(height.bounds(lower[:, 0], upper[:, 0])[1] < floor)

    return _outer(field, box, 0, psi, (place, within, beyond))


def _above(field: Field, box: FloatArray, psi: float, y: float) -> Minor:
    """Give the minor above the stack."""
    height, top = field.boundaries[-1].height, float(box[1, 2])

    def place(parameters: FloatArray) -> FloatArray:
        x, s = parameters[:, 0], parameters[:, 1]
        z = top - s * (top - np.clip(height.at(x), float(box[0, 2]), top))
        return np.stack([x, np.full_like(x, y), z], axis=1)

    def within(parameters: FloatArray) -> _Mask:
        return np.asarray(height.at(parameters[:, 0]) <= top)

    def beyond(lower: FloatArray, upper: FloatArray) -> _Mask:
        return np.asarray(height.bounds(lower[:, 0], upper[:, 0])[0] > top)

    return _outer(field, box, len(field.boundaries) - 1, psi, (place, within, beyond))


def _outer(field: Field, box: FloatArray, k: int, psi: float, where: _Where) -> Minor:
    """Give the minor where one piece acts alone: a function of x."""
    piece = field.pieces[k]

    def at(parameters: FloatArray) -> FloatArray:
        x = parameters[:, 0]
        _, along, a = _piece(field, k, x, np.zeros_like(x))
        return 1.0 + (a + along if field.axis == "x" else psi * a)

    lower, upper = _cells(field, box)
    place, within, beyond = where
    degrees = max(piece.a.degree, piece.d.degree), 0
    return Minor(_NAMES[field.axis], lower, upper, degrees, at, place, None, within, beyond)


def _strip(field: Field, box: FloatArray, k: int, psi: float, y: float) -> Minor:
    """Give the minor between two boundaries."""
    low, high = field.boundaries[k].height, field.boundaries[k + 1].height
    floor, top = float(box[0, 2]), float(box[1, 2])

    def gap(parameters: FloatArray) -> FloatArray:
        return high.at(parameters[:, 0]) - low.at(parameters[:, 0])

    def place(parameters: FloatArray) -> FloatArray:
        x, s = parameters[:, 0], parameters[:, 1]
        z = low.at(x) + s * gap(parameters)
        return np.stack([x, np.full_like(x, y), z], axis=1)

    def at(parameters: FloatArray) -> FloatArray:
        x, s = parameters[:, 0], parameters[:, 1]
        z, g = place(parameters)[:, 2], gap(parameters)
        b, rise = field.blend.value(s), field.blend.slope(s)
        e, e_x, a = _piece(field, k, x, z)
        f, f_x, c = _piece(field, k + 1, x, z)
        own = a + (c - a) * b
        if field.axis == "y":
            return g * (1.0 + psi * own)
        if field.axis == "z":
            return g * (1.0 + own) + (f - e) * rise
        lean = low.slope(x) + s * (high.slope(x) - low.slope(x))
        return g * (1.0 + own + e_x + (f_x - e_x) * b) - (f - e) * rise * lean

    def within(parameters: FloatArray) -> _Mask:
        z = place(parameters)[:, 2]
        return np.asarray((z >= floor) & (z <= top))

    def beyond(lower: FloatArray, upper: FloatArray) -> _Mask:
        (foot, crown), (under, over) = (
            each.bounds(lower[:, 0], upper[:, 0]) for each in (low, high)
        )
        least = foot + lower[:, 1] * (under - foot)
        most = crown + upper[:, 1] * (over - crown)
        return np.asarray((most < floor) | (least > top))

    height = max(low.degree, high.degree)
    along = max(course.degree for course in courses([field]))
    degrees = (along + height, field.blend.degree)
    lower, upper = _cells(field, box)
    return Minor(_NAMES[field.axis], lower, upper, degrees, at, place, gap, within, beyond)
