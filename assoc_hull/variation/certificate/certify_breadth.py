"""The minor Y_y of fields that widen: a polynomial of x, z and the half-breadth.

A tube's psi is one between its radius, where it begins to fall, and where it is nil. So cells
have three sides: along the ship, up, and outward. Half-breadths count; both sides are alike.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import Interval
from assoc_hull.variation.certificate.certify_layer import cells, degrees_of
from assoc_hull.variation.certificate.minor_search import Minor
from assoc_hull.variation.fields.field import Field, Tube
from assoc_hull.variation.fields.fields_layer import Rake

__all__ = ["breadth_minor", "extremes", "half_breadths", "psi_bounds"]

_Fields = Sequence[Field | Rake]


def half_breadths(box: FloatArray) -> tuple[float, float]:
    """Give least and greatest half-breadth in a box."""
    reach = np.abs(box[:, 1])
    least = 0.0 if box[0, 1] <= 0.0 <= box[1, 1] else float(reach.min())
    return least, float(reach.max())


def _tube(field: Field | Rake) -> Tube | None:
    return None if isinstance(field, Rake) else field.tube


def breadth_minor(fields: _Fields, box: FloatArray) -> Minor:
    """Give Y_y over parameters x, z and half-breadth."""
    tubes = [tube for tube in map(_tube, fields) if tube is not None]
    low, high = half_breadths(box)
    ends = [end for tube in tubes for end in (tube.radius, tube.n * tube.radius)]
    steps = np.unique(np.clip([low, high, *ends], low, high))
    steps = steps if len(steps) > 1 else np.array([low, high])
    plane = cells(fields, box)
    lower, upper = (
        np.column_stack([np.repeat(part, len(out), axis=0), np.tile(out, len(part))])
        for part, out in zip(plane, (steps[:-1], steps[1:]), strict=True)
    )
    degrees = *degrees_of(fields), max((tube.blend.degree for tube in tubes), default=0)

    def at(parameters: FloatArray) -> FloatArray:
        xyz = _places(parameters)
        total = np.ones(len(xyz))
        for field in fields:
            total += field.gradient(xyz)[:, 1]
        return total

    return Minor("Y_y", lower, upper, degrees, at, _places)


def _places(parameters: FloatArray) -> FloatArray:
    return parameters[:, [0, 2, 1]]


def psi_bounds(field: Field | Rake, low: FloatArray, high: FloatArray) -> Interval:
    """Enclose psi' of a y-field on intervals of the half-breadth, exactly."""
    tube = _tube(field)
    if tube is None:
        return np.ones(len(low)), np.ones(len(low))
    first, last = tube.slope(low), tube.slope(high)
    least, most = np.minimum(first, last), np.maximum(first, last)
    for place in _turns(tube):
        # beyond an end of the interval this is the slope at that end, which counts already
        slope = tube.slope(np.clip(place, low, high))
        least, most = np.minimum(least, slope), np.maximum(most, slope)
    return least, most


def extremes(field: Field, box: FloatArray) -> list[tuple[float, float]]:
    """Give the least and the greatest psi' of a y-field in a box, each with where it is."""
    low, high = half_breadths(box)
    if field.tube is None:
        return [(1.0, low)]
    places = np.unique(np.clip([low, high, *_turns(field.tube)], low, high))
    slopes = field.tube.slope(places)
    ends = dict.fromkeys((int(slopes.argmin()), int(slopes.argmax())))
    return [(float(slopes[k]), float(places[k])) for k in ends]


def _turns(tube: Tube) -> list[float]:
    """Give where psi' turns: there 2 b' + b'' (s + 1 / (n - 1)) is nil."""
    s = np.polynomial.Polynomial([0.0, 1.0])
    blends = {"cubic": 3 * s**2 - 2 * s**3, "quintic": 10 * s**3 - 15 * s**4 + 6 * s**5}
    blend = blends[tube.blend.name]
    turn = (2 * blend.deriv() + blend.deriv(2) * (s + 1.0 / (tube.n - 1.0))).roots()
    inner = [float(np.clip(root.real, 0.0, 1.0)) for root in turn]
    return [tube.radius * (1.0 + (tube.n - 1.0) * part) for part in (0.0, *inner, 1.0)]
