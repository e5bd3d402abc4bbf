"""The minors of a layer of fields, as polynomials on the cells between nodes and boundaries.

Between the nodes along the ship and the level boundaries of the stacks, the derivatives of all
fields are polynomials of x and z, and so are the minors. Every strip below, between and above the
boundaries is a row of cells.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.minor_search import Minor
from assoc_hull.variation.fields.field import Field
from assoc_hull.variation.fields.fields_layer import Rake
from assoc_hull.variation.fields.piecewise_linear import Chain, Course

__all__ = ["cells", "columns", "courses", "degrees_of", "gradients", "is_level", "plane_minor"]


def is_level(field: Field | Rake) -> bool:
    """Tell whether all boundaries of a field are level."""
    if isinstance(field, Rake):
        return True
    heights = [each.height for each in field.boundaries]
    return all(isinstance(each, Chain) and each.level for each in heights)


def rows(fields: Iterable[Field | Rake], box: FloatArray) -> FloatArray:
    """Give the heights, rising, between which no field has a level boundary."""
    low, high = float(box[0, 2]), float(box[1, 2])
    found = [low, high]
    for field in fields:
        if isinstance(field, Rake):
            found += [field.z0, field.z0 + field.w]
            continue
        for each in field.boundaries:
            bounds = each.height.bounds(box[:1, 0], box[1:, 0])
            found += [float(end[0]) for end in bounds]
    return _between(found, low, high)


def columns(fields: Iterable[Field | Rake], box: FloatArray) -> FloatArray:
    """Give the places along the ship, rising, between which no course has a node."""
    low, high = float(box[0, 0]), float(box[1, 0])
    found = [low, high]
    for course in courses(fields):
        found += course.nodes.tolist()
    return _between(found, low, high)


def courses(fields: Iterable[Field | Rake]) -> list[Course]:
    """Give all functions of x that fields are made of."""
    found = list[Course]()
    for field in fields:
        if isinstance(field, Rake):
            found.append(field.course)
            continue
        for piece in field.pieces:
            found += [piece.a, piece.d]
        found += [each.height for each in field.boundaries]
    return found


def _between(found: Sequence[float], low: float, high: float) -> FloatArray:
    places = np.unique(np.clip(np.array(found), low, high))
    return places if len(places) > 1 else np.array([low, high])


def cells(fields: Sequence[Field | Rake], box: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give least and greatest x and z of the cells, (m, 2) each."""
    x = columns(fields, box)
    z = rows(fields, box)
    lower = np.array(list(product(x[:-1].tolist(), z[:-1].tolist())))
    upper = np.array(list(product(x[1:].tolist(), z[1:].tolist())))
    return lower, upper


def _places(y: float, parameters: FloatArray) -> FloatArray:
    return np.insert(parameters, 1, y, axis=1)


def plane_minor(
    name: str, along: Sequence[Field | Rake], up: Sequence[Field | Rake], box: FloatArray
) -> Minor:
    """Give X_x of x-fields, Z_z of z-fields, or the determinant of both."""

    def at(parameters: FloatArray) -> FloatArray:
        xyz = _places(0.0, parameters)
        x_x, x_z = gradients(along, xyz)
        z_x, z_z = gradients(up, xyz)
        whole: FloatArray = (1.0 + x_x) * (1.0 + z_z) - x_z * z_x
        return whole

    degrees = degrees_of(along), degrees_of(up)
    total = degrees[0][0] + degrees[1][0], degrees[0][1] + degrees[1][1]
    lower, upper = cells([*along, *up], box)
    return Minor(name, lower, upper, total, at, lambda parameters: _places(0.0, parameters))


def gradients(fields: Sequence[Field | Rake], xyz: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give the derivatives of the sum of fields by x and by z."""
    total = np.zeros((len(xyz), 3))
    for field in fields:
        total += field.gradient(xyz)
    return total[:, 0], total[:, 2]


def degrees_of(fields: Sequence[Field | Rake]) -> tuple[int, int]:
    """Give the degrees in x and z of the own derivative of fields; 0 of none."""
    if not fields:
        return 0, 0
    along = max(course.degree for course in courses(fields))
    up = max(each.blend.degree + isinstance(each, Rake) for each in fields)
    return along, up
