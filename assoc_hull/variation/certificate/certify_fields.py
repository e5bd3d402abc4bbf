"""The least minors of a layer of fields, each found in the sharpest way there is for it.

Minors of fields with level boundaries are polynomials on cells; that of a single field with any
boundaries is a quotient of such in its strips. Several fields with boundaries that run across
one another are left to intervals.
"""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate.certify_boxes import box_breadth, box_minor
from assoc_hull.variation.certificate.certify_breadth import breadth_minor, extremes
from assoc_hull.variation.certificate.certify_layer import is_level, plane_minor
from assoc_hull.variation.certificate.certify_strip import strip_minors
from assoc_hull.variation.certificate.minor_search import Found, search
from assoc_hull.variation.fields.field import Field
from assoc_hull.variation.fields.fields_layer import FieldLayer, Rake

__all__ = ["field_minors"]

_Fields = Sequence[Field | Rake]


def field_minors(layer: FieldLayer, box: FloatArray, margin: float) -> list[Found]:
    """Give the least value of every principal minor that is not 1 by itself.

    The derivatives of y by x and z are no part of any; those of x and z by y are nil. So X_x,
    Z_z, their determinant D, and Y_y are all there is to check. Fields that move nothing in the
    box are left out: one field alone is checked more sharply than two.
    """
    acting = [each for each in layer.fields if _acts(each, box)]
    along, breadth, up = ([each for each in acting if each.axis == axis] for axis in "xyz")
    found = list[Found]()
    if along:
        found += _plane("X_x", along, [], box, margin)
    if up:
        found += _plane("Z_z", [], up, box, margin)
    if along and up:
        found += _plane("D", along, up, box, margin)
    if breadth:
        found += _breadth(breadth, box, margin)
    return found


def _acts(field: Field | Rake, box: FloatArray) -> bool:
    """Tell whether a field's region meets a box."""
    region = field.region()
    return all(
        low <= high and low <= box[1, axis] and high >= box[0, axis]
        for axis, (low, high) in ((0, region.x), (2, region.z))
    )


def _plane(name: str, along: _Fields, up: _Fields, box: FloatArray, margin: float) -> list[Found]:
    fields = [*along, *up]
    if all(is_level(each) for each in fields):
        return [search(plane_minor(name, along, up, box), margin)]
    alone = fields[0]
    if len(fields) == 1 and isinstance(alone, Field):
        return [search(each, margin) for each in strip_minors(alone, box)]
    return [box_minor(name, along, up, box, margin)]


def _breadth(fields: _Fields, box: FloatArray, margin: float) -> list[Found]:
    if all(is_level(each) for each in fields):
        return [search(breadth_minor(fields, box), margin)]
    alone = fields[0]
    if len(fields) > 1 or not isinstance(alone, Field):
        return [box_breadth(fields, box, margin)]
    minors = [strip_minors(alone, box, *extreme) for extreme in extremes(alone, box)]
    return [search(each, margin) for some in minors for each in some]
