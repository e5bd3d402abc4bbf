"""The least principal minors of a layer of fields, each found in the sharpest way there is for it.

With level boundaries the minors are polynomials on cells between nodes and boundaries; that of a
single field with any boundaries is a quotient of polynomials in its strips; that of fields that
widen the hull depends on the half-breadth as well. Several fields whose boundaries are not all
level are left to intervals on boxes that are halved across every side. `field_minors` at the end
chooses. X_x, Y_y, Z_z are entries of the Jacobian, D is the determinant in x and z.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from itertools import product

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.intervals import (
    Interval,
    interval_difference,
    interval_product,
    interval_sum,
)
from assoc_hull.model.program.engine import is_compiled
from assoc_hull.variation.certificate.field_enclosures import enclose_field
from assoc_hull.variation.certificate.minor_search import LeastMinor, Minor, find_least_minor
from assoc_hull.variation.fields.bounded_functions import BlendChain, BoundedFunction
from assoc_hull.variation.fields.field import StackedField, Tube
from assoc_hull.variation.fields.flat_layers import flat_layers
from assoc_hull.variation.fields.layers import FieldLayer, Rake

__all__ = [
    "box_breadth",
    "box_minor",
    "breadth_minor",
    "degrees_of",
    "displacement_slopes",
    "field_cells",
    "field_functions",
    "field_minors",
    "half_breadths",
    "is_level",
    "node_columns",
    "plane_minor",
    "psi_bounds",
    "psi_extremes",
    "search_boxes",
    "strip_minors",
]

# --------------------------------------------------------------------------------------
# Level boundaries: cells along the ship between nodes, and up the hull between boundaries, on
# which the derivatives of all fields, and so the minors, are polynomials of x and z.


def is_level(field: StackedField | Rake) -> bool:
    """Tell whether all boundaries of a field are level."""
    if isinstance(field, Rake):
        return True
    heights = [each.height for each in field.boundaries]
    return all(isinstance(each, BlendChain) and each.level for each in heights)


def strip_heights(fields: Iterable[StackedField | Rake], box: FloatArray) -> FloatArray:
    """Give the heights, rising, m, between which no field has a level boundary."""
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


def node_columns(fields: Iterable[StackedField | Rake], box: FloatArray) -> FloatArray:
    """Give the places along the ship, rising, m, between which no function of x has a node."""
    low, high = float(box[0, 0]), float(box[1, 0])
    found = [low, high]
    for course in field_functions(fields):
        found += course.nodes.tolist()
    return _between(found, low, high)


def field_functions(fields: Iterable[StackedField | Rake]) -> list[BoundedFunction]:
    """Give all functions of x that fields are made of."""
    found = list[BoundedFunction]()
    for field in fields:
        if isinstance(field, Rake):
            found.append(field.course)
            continue
        for piece in field.pieces:
            found += [piece.a, piece.d]
        found += [each.height for each in field.boundaries]
    return found


def _between(found: Sequence[float], low: float, high: float) -> FloatArray:
    """Give places within an interval, rising, its two ends at least."""
    places = np.unique(np.clip(np.array(found), low, high))
    return places if len(places) > 1 else np.array([low, high])


def field_cells(
    fields: Sequence[StackedField | Rake], box: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Give least and greatest x and z of the cells, (m, 2) each."""
    x = node_columns(fields, box)
    z = strip_heights(fields, box)
    lower = np.array(list(product(x[:-1].tolist(), z[:-1].tolist())))
    upper = np.array(list(product(x[1:].tolist(), z[1:].tolist())))
    return lower, upper


def _at_breadth(y: float, parameters: FloatArray) -> FloatArray:
    """Give places (n, 3) of parameters x and z, (n, 2), at half-breadth y."""
    return np.insert(parameters, 1, y, axis=1)


def plane_minor(
    name: str,
    along: Sequence[StackedField | Rake],
    up: Sequence[StackedField | Rake],
    box: FloatArray,
) -> Minor:
    """Give X_x of x-fields, Z_z of z-fields, or the determinant D of both, over x and z."""
    slopes = displacement_slopes([*along, *up])

    def at(parameters: FloatArray) -> FloatArray:
        found = slopes(_at_breadth(0.0, parameters))
        (x_x, x_z), (z_x, z_z) = ((found[:, k, 0], found[:, k, 2]) for k in (0, 2))
        whole: FloatArray = (1.0 + x_x) * (1.0 + z_z) - x_z * z_x
        return whole

    degrees = degrees_of(along), degrees_of(up)
    total = degrees[0][0] + degrees[1][0], degrees[0][1] + degrees[1][1]
    lower, upper = field_cells([*along, *up], box)
    return Minor(name, lower, upper, total, at, lambda parameters: _at_breadth(0.0, parameters))


def displacement_slopes(
    fields: Sequence[StackedField | Rake],
) -> Callable[[FloatArray], FloatArray]:
    """Give what tells the derivatives of all that fields add to places (n, 3), as (n, 3, 3)."""
    layer = FieldLayer("fields", tuple(fields))
    if is_compiled(counts=False) and (flat := flat_layers([layer])) is not None:
        from assoc_hull.variation.fields.compiled_layers import displacement_slopes_at

        return partial(displacement_slopes_at, *flat)

    def at(xyz: FloatArray) -> FloatArray:
        found = np.zeros((*xyz.shape, 3))
        for field in fields:
            found[:, "xyz".index(field.axis)] += field.gradient(xyz)
        return found

    return at


def degrees_of(fields: Sequence[StackedField | Rake]) -> tuple[int, int]:
    """Give the degrees in x and z of what fields add to their own derivative; 0 of none."""
    if not fields:
        return 0, 0
    along = max(course.degree for course in field_functions(fields))
    up = max(each.blend.degree + isinstance(each, Rake) for each in fields)
    return along, up


# --------------------------------------------------------------------------------------
# Fields that widen the hull: Y_y is a polynomial of x, z and the half-breadth. The psi of a tube
# goes over at its radius, where it begins to fall, and where it is zero, so cells have a third
# side outward. Half-breadths count; both sides are alike.

_Fields = Sequence[StackedField | Rake]


def half_breadths(box: FloatArray) -> tuple[float, float]:
    """Give least and greatest half-breadth in a box."""
    reach = np.abs(box[:, 1])
    least = 0.0 if box[0, 1] <= 0.0 <= box[1, 1] else float(reach.min())
    return least, float(reach.max())


def _tube(field: StackedField | Rake) -> Tube | None:
    return None if isinstance(field, Rake) else field.tube


def breadth_minor(fields: _Fields, box: FloatArray) -> Minor:
    """Give Y_y over parameters x, z and half-breadth, m."""
    tubes = [tube for tube in map(_tube, fields) if tube is not None]
    low, high = half_breadths(box)
    ends = [end for tube in tubes for end in (tube.radius, tube.n * tube.radius)]
    steps = np.unique(np.clip([low, high, *ends], low, high))
    steps = steps if len(steps) > 1 else np.array([low, high])
    plane = field_cells(fields, box)
    lower, upper = (
        np.column_stack([np.repeat(part, len(out), axis=0), np.tile(out, len(part))])
        for part, out in zip(plane, (steps[:-1], steps[1:]), strict=True)
    )
    slopes = displacement_slopes(fields)
    degrees = *degrees_of(fields), max((tube.blend.degree for tube in tubes), default=0)

    def at(parameters: FloatArray) -> FloatArray:
        xyz = _breadth_places(parameters)
        total: FloatArray = 1.0 + slopes(xyz)[:, 1, 1]
        return total

    return Minor("Y_y", lower, upper, degrees, at, _breadth_places)


def _breadth_places(parameters: FloatArray) -> FloatArray:
    """Give places (n, 3) of parameters x, z, half-breadth: port side."""
    return parameters[:, [0, 2, 1]]


def psi_bounds(field: StackedField | Rake, low: FloatArray, high: FloatArray) -> Interval:
    """Enclose psi' of a y-field on intervals of the half-breadth, exactly; 1 without a tube."""
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


def psi_extremes(field: StackedField, box: FloatArray) -> list[tuple[float, float]]:
    """Give the least and the greatest psi' of a y-field in a box, each with its half-breadth, m."""
    low, high = half_breadths(box)
    if field.tube is None:
        return [(1.0, low)]
    places = np.unique(np.clip([low, high, *_turns(field.tube)], low, high))
    slopes = field.tube.slope(places)
    ends = dict.fromkeys((int(slopes.argmin()), int(slopes.argmax())))
    return [(float(slopes[k]), float(places[k])) for k in ends]


def _turns(tube: Tube) -> list[float]:
    """Give the half-breadths at which psi' turns, m: where 2 b' + b'' (s + 1 / (n - 1)) is zero."""
    s = np.polynomial.Polynomial([0.0, 1.0])
    blends = {"cubic": 3 * s**2 - 2 * s**3, "quintic": 10 * s**3 - 15 * s**4 + 6 * s**5}
    blend = blends[tube.blend.name]
    turn = (2 * blend.deriv() + blend.deriv(2) * (s + 1.0 / (tube.n - 1.0))).roots()
    inner = [float(np.clip(root.real, 0.0, 1.0)) for root in turn]
    return [tube.radius * (1.0 + (tube.n - 1.0) * part) for part in (0.0, *inner, 1.0)]


# --------------------------------------------------------------------------------------
# Several fields, boundaries not all level: minors are enclosed by intervals on boxes of the
# profile plane. A box on which a minor may be below the margin is halved across every side.

_DEPTH = 14
_MOST = 400_000
"""Boxes at most, before a map counts as undecided."""

_REFUSED = 20_000
_SHARP = 1e-3
"""Of a map that is refused the least value is sought to `_SHARP`, on so many boxes at most."""

_ZOOMS = 18
_CLOSER = 0.4
_SAMPLES = {1: 5, 2: 5, 3: 3}
"""Places on a side, by how many sides boxes have; what they miss is found by halving boxes."""

_Lows = Callable[[FloatArray, FloatArray], FloatArray]
_Values = Callable[[FloatArray], FloatArray]


def search_boxes(
    lows: _Lows, values: _Values, box: tuple[FloatArray, FloatArray], enough: float
) -> tuple[float, float, FloatArray, int, int]:
    """Decide whether a function reaches a margin on boxes.

    Parameters
    ----------
    lows : callable
        Lower bounds on boxes (m, k), (m, k).
    values : callable
        Values at places (m, k).
    box : two (m, k)
        The boxes.
    enough : float
        The margin.

    Returns
    -------
    least, bound : float
        Least value found; lower bound, exact only as far as it decides.
    place : (k,)
        Where the least was found.
    boxes, splits : int
    """
    lower, upper = box
    bound, count, splits = np.inf, 0, 0
    least, where = _first(values, lower, upper)
    for depth in range(_DEPTH + 1):
        count += len(lower)
        low, centre = lows(lower, upper), 0.5 * (lower + upper)
        met = values(centre)
        if met.min() < least:
            best = int(met.argmin())
            least, where = _lowest(values, centre[best], lower[best], upper[best])
        # certified so far: only what may be below the margin matters; refused: sharpen the least
        # value
        open_ = low < (enough if least >= enough else least - _SHARP)
        bound = min(bound, float(low[~open_].min(initial=np.inf)))
        most = _MOST if least >= enough else _REFUSED
        stop = least <= 0.0 or depth == _DEPTH or count + 4 * int(open_.sum()) > most
        if not open_.any() or stop:
            bound = min(bound, float(low.min()))
            break
        splits += int(open_.sum())
        lower, upper = _quartered(lower[open_], upper[open_])
    return least, bound, where, count, splits


def _first(values: _Values, lower: FloatArray, upper: FloatArray) -> tuple[float, FloatArray]:
    """Find a low value on a grid in each of some boxes."""
    k = lower.shape[1]
    grid = (np.array(list(np.ndindex(*(_SAMPLES[k],) * k))) + 0.5) / _SAMPLES[k]
    places = lower[:, None, :] + grid[None, :, :] * (upper - lower)[:, None, :]
    met = values(places.reshape(-1, k))
    box, place = divmod(int(met.argmin()), len(grid))
    return _lowest(values, places[box, place], lower[box], upper[box])


def _lowest(
    values: _Values, start: FloatArray, lower: FloatArray, upper: FloatArray
) -> tuple[float, FloatArray]:
    """Find the least value near a place, zooming in on the least of a grid."""
    k = len(start)
    grid = np.array(list(np.ndindex(*(7,) * k))) / 6.0 - 0.5
    where, reach = start, upper - lower
    least = float(values(start[None, :])[0])
    for _ in range(_ZOOMS):
        places = np.clip(where + grid * reach, lower, upper)
        met = values(places)
        if met.min() < least:
            least, where = float(met.min()), places[int(met.argmin())]
        reach = _CLOSER * reach
    return least, where


def _quartered(lower: FloatArray, upper: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Halve boxes across every one of their sides."""
    middle = 0.5 * (lower + upper)
    parts = [
        (np.where(bits, middle, lower), np.where(bits, upper, middle))
        for bits in np.ndindex(*(2,) * lower.shape[1])
    ]
    return np.concatenate([each[0] for each in parts]), np.concatenate([each[1] for each in parts])


def box_minor(name: str, along: _Fields, up: _Fields, box: FloatArray, enough: float) -> LeastMinor:
    """Decide whether X_x, Z_z or D of fields that move x and z reaches a margin."""

    def lows(lower: FloatArray, upper: FloatArray) -> FloatArray:
        return _enclose_plane(along, up, lower, upper)[0]

    minor = plane_minor(name, along, up, box)
    return _decide(minor, lows, enough)


def box_breadth(fields: _Fields, box: FloatArray, enough: float) -> LeastMinor:
    """Decide whether Y_y of y-fields reaches a margin."""

    def lows(lower: FloatArray, upper: FloatArray) -> FloatArray:
        total = _ones(len(lower))
        for field in fields:
            own = enclose_field(field, lower[:, :2], upper[:, :2]).own
            psi = psi_bounds(field, lower[:, 2], upper[:, 2])
            total = interval_sum(total, interval_product(own, psi))
        return total[0]

    return _decide(breadth_minor(fields, box), lows, enough)


def _decide(minor: Minor, lows: _Lows, enough: float) -> LeastMinor:
    """Search the boxes of a minor and name the place of its least value."""
    least, bound, where, boxes, splits = search_boxes(
        lows, minor.at, (minor.lower, minor.upper), enough
    )
    x, y, z = minor.place(where[None, :])[0].tolist()
    return LeastMinor(minor.name, least, bound, (x, y, z), boxes, splits)


def _enclose_plane(along: _Fields, up: _Fields, lower: FloatArray, upper: FloatArray) -> Interval:
    """Enclose X_x Z_z - X_z Z_x; X_x or Z_z if only one of both moves."""
    x_x, x_z = _derivatives(along, lower, upper)
    z_x, z_z = _derivatives(up, lower, upper)
    one = _ones(len(lower))
    if not up or not along:
        return interval_sum(one, x_x if along else z_z)
    return interval_difference(
        interval_product(interval_sum(one, x_x), interval_sum(one, z_z)), interval_product(x_z, z_x)
    )


def _derivatives(
    fields: _Fields, lower: FloatArray, upper: FloatArray
) -> tuple[Interval, Interval]:
    """Enclose the sums of the derivatives of fields by x and by z on boxes."""
    none = np.zeros(len(lower))
    by_x, by_z = (none, none), (none, none)
    for field in fields:
        found = enclose_field(field, lower, upper)
        by_x, by_z = interval_sum(by_x, found.along), interval_sum(by_z, found.up)
    return by_x, by_z


def _ones(count: int) -> Interval:
    return np.ones(count), np.ones(count)


# --------------------------------------------------------------------------------------
# One field, boundaries along chains or contours. In the strip between two of them, with z = h + s
# g, the minor times the gap g is a polynomial of x and s between the nodes along the ship; D is
# the difference of the two pieces. Below and above the stack the minor is a function of x alone.
#
#     z-field   g (1 + a + Da b) + De b'
#     x-field   g (1 + e_x + De_x b) - De b' (h' + s g')
#     y-field   g (1 + psi' (a + Da b))

_Mask = np.typing.NDArray[np.bool_]
_Where = tuple[
    Callable[[FloatArray], FloatArray],
    Callable[[FloatArray], _Mask],
    Callable[[FloatArray, FloatArray], _Mask],
]

_NAMES = {"x": "X_x", "y": "Y_y", "z": "Z_z"}


def strip_minors(
    field: StackedField, box: FloatArray, psi: float = 1.0, y: float = 0.0
) -> list[Minor]:
    """Give the own minor of a field, strip by strip, from below the stack to above it.

    `psi` is an extreme of the tube's psi' for a y-field, `y` the half-breadth (m) where it has
    that, for the witness.
    """
    last = len(field.boundaries) - 1
    inner = [_strip(field, box, k, psi, y) for k in range(last)]
    return [_below(field, box, psi, y), *inner, _above(field, box, psi, y)]


def _cells(field: StackedField, box: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give least and greatest (x, s), (m, 2) each, of the cells of a strip; s from 0 to 1."""
    x = node_columns([field], box)
    lower = np.stack([x[:-1], np.zeros(len(x) - 1)], axis=1)
    upper = np.stack([x[1:], np.ones(len(x) - 1)], axis=1)
    return lower, upper


def _piece(
    field: StackedField, k: int, x: FloatArray, z: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give e, its derivative by x with the field's own coordinate held, and a."""
    piece = field.pieces[k]
    lever = (x if field.axis == "x" else z) - piece.pivot
    a, along = piece.a.at(x), piece.a.slope(x) * lever + piece.d.slope(x)
    return a * lever + piece.d.at(x), along, a


def _below(field: StackedField, box: FloatArray, psi: float, y: float) -> Minor:
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


def _above(field: StackedField, box: FloatArray, psi: float, y: float) -> Minor:
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


def _outer(field: StackedField, box: FloatArray, k: int, psi: float, where: _Where) -> Minor:
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


def _strip(field: StackedField, box: FloatArray, k: int, psi: float, y: float) -> Minor:
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
    along = max(course.degree for course in field_functions([field]))
    degrees = (along + height, field.blend.degree)
    lower, upper = _cells(field, box)
    return Minor(_NAMES[field.axis], lower, upper, degrees, at, place, gap, within, beyond)


# --------------------------------------------------------------------------------------
# Which of these ways serves a layer.


def field_minors(layer: FieldLayer, box: FloatArray, margin: float) -> list[LeastMinor]:
    """Give the least value of every principal minor that is not 1 by itself.

    The derivatives of y by x and z are no part of any; those of x and z by y are zero. So X_x,
    Z_z, their determinant D, and Y_y are all there is to check. Fields that move nothing in the
    box are left out: one field alone is checked more sharply than two.
    """
    acting = [each for each in layer.fields if _acts(each, box)]
    along, breadth, up = ([each for each in acting if each.axis == axis] for axis in "xyz")
    found = list[LeastMinor]()
    if along:
        found += _plane("X_x", along, [], box, margin)
    if up:
        found += _plane("Z_z", [], up, box, margin)
    if along and up:
        found += _plane("D", along, up, box, margin)
    if breadth:
        found += _breadth(breadth, box, margin)
    return found


def _acts(field: StackedField | Rake, box: FloatArray) -> bool:
    """Tell whether a field's region and a box intersect in the profile plane."""
    region = field.region()
    return all(
        low <= high and low <= box[1, axis] and high >= box[0, axis]
        for axis, (low, high) in ((0, region.x), (2, region.z))
    )


def _plane(
    name: str, along: _Fields, up: _Fields, box: FloatArray, margin: float
) -> list[LeastMinor]:
    """Give the least value of a minor of x and z, by cells, strips or boxes."""
    fields = [*along, *up]
    if all(is_level(each) for each in fields):
        return [find_least_minor(plane_minor(name, along, up, box), margin)]
    alone = fields[0]
    if len(fields) == 1 and isinstance(alone, StackedField):
        return [find_least_minor(each, margin) for each in strip_minors(alone, box)]
    return [box_minor(name, along, up, box, margin)]


def _breadth(fields: _Fields, box: FloatArray, margin: float) -> list[LeastMinor]:
    """Give the least Y_y; a strip's is linear in psi', so both extremes of psi' are enough."""
    if all(is_level(each) for each in fields):
        return [find_least_minor(breadth_minor(fields, box), margin)]
    alone = fields[0]
    if len(fields) > 1 or not isinstance(alone, StackedField):
        return [box_breadth(fields, box, margin)]
    minors = [strip_minors(alone, box, *extreme) for extreme in psi_extremes(alone, box)]
    return [find_least_minor(each, margin) for some in minors for each in some]
