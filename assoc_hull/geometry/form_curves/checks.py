"""What is wrong, or merely worth knowing, about the parameters of a form-parameter curve.

The bounds come first: between which areas and centroids a curve can lie by its ends alone, and
between which centroids it runs forward. `check_parameters` looks at the 14 numbers before there
is a curve, `check_shape` at the curve. The table of codes stands above the checks.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormParameters
from assoc_hull.geometry.form_curves.integrals import (
    MiddleTerms,
    centroid_extreme,
    form_integrals,
    middle_terms,
    with_middle,
)
from assoc_hull.geometry.form_curves.shape import (
    crosses_itself,
    form_inflections,
    least_coordinate,
    least_rate,
)

__all__ = [
    "SEVERITIES",
    "FormMessage",
    "area_limits",
    "centroid_box",
    "centroid_limits",
    "check_parameters",
    "check_shape",
    "forward_centroids",
]

# --------------------------------------------------------------------------------------
# Bounds by the ends alone: all are necessary; `centroid_limits` is sharp for curves that rise, or
# fall, all the way.

Place = tuple[float, float]
"""Abscissa and ordinate."""


def area_limits(start: Place, finish: Place) -> tuple[float, float]:
    """Give the areas between which a curve can stay between the heights of its ends."""
    low, high = sorted((start[1], finish[1]))
    length = abs(finish[0] - start[0])
    return low * length, high * length


def centroid_box(start: Place, finish: Place, area: float) -> tuple[float, float]:
    """Give the centroids between which the moment about the lower end fits into the box of both.

    The area is above 0.
    """
    if finish[1] < start[1]:
        low, high = centroid_box((-finish[0], finish[1]), (-start[0], start[1]), area)
        return -high, -low
    half = 0.5 * (finish[0] - start[0]) ** 2 / area
    return start[0] + half * start[1], start[0] + half * finish[1]


def centroid_limits(start: Place, finish: Place, area: float) -> tuple[float, float]:
    """Give the centroids of curves with an area (int y dx) that rise, or fall, all the way.

    They are nan if the ends are equally high, or the area is not within `area_limits`.
    """
    if finish[1] < start[1]:
        low, high = centroid_limits((-finish[0], finish[1]), (-start[0], start[1]), area)
        return -high, -low
    length, height = finish[0] - start[0], finish[1] - start[1]
    if not (height > 0.0 and length > 0.0 and area > 0.0):
        return math.nan, math.nan
    full = (area / length - start[1]) / height
    if not 0.0 <= full <= 1.0:
        return math.nan, math.nan
    base, rest = 0.5 * start[1] * length * length, height * full * length * length
    low = start[0] + (base + 0.5 * full * rest) / area
    return low, start[0] + (base + rest * (1.0 - 0.5 * full)) / area


# --------------------------------------------------------------------------------------
# Centroids with which curves of an area run forward: dx/dt nowhere below 0.
#
# All middle vertices of an area lie on a line; the least dx/dt of the curve is a concave function
# of the place on it, so those that run forward are a stretch of that line. On the side of the
# extreme of the moment on which the chosen root lies, the moment is monotone: the stretch is an
# interval of centroids, and every centroid in it has a curve that runs forward.

_THIRDS, _HALVES = 70, 60
"""Steps toward the largest least rate, and toward both ends of the stretch."""


def forward_centroids(ends: FloatArray, area: FloatArray) -> FloatArray:
    """Give the least and the largest centroid with which curves of an area run forward, (n, 2).

    Ends (n, 6, 2) are P0, P1, P2, P4, P5, P6; the area (n,), int y dx, is above 0. It is nan where
    no curve of the area runs forward, or where its abscissae do not depend on the middle vertex of
    the area.
    """
    terms = middle_terms(ends)
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = _bracket(ends)
        low, high = _beside_extreme(ends, terms, area, low, high)
        top = _highest(ends, terms, area, low, high)
        fine = _rate(ends, terms, area, top) >= 0.0
        edges = [_edge(ends, terms, area, top, each) for each in (low, high)]
        found = np.stack([_centroid(terms, area, each) for each in edges], axis=1)
    return np.where(fine[:, None], np.sort(found, axis=1), np.nan)


def _bracket(ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give abscissae of the middle vertex beyond which a curve runs back for certain."""
    x = ends[:, :, 0]
    return x[:, 2] - np.abs(x[:, 2] - x[:, 1]), x[:, 3] + np.abs(x[:, 4] - x[:, 3])


def _beside_extreme(
    ends: FloatArray, terms: MiddleTerms, area: FloatArray, low: FloatArray, high: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Keep the side of the extreme of the moment on which the nearest root lies."""
    at, want = centroid_extreme(ends, area)
    lies = np.isfinite(at)
    low = np.where(lies & (want >= at), np.maximum(low, at), low)
    high = np.where(lies & (want < at), np.minimum(high, at), high)
    return np.minimum(low, high), high


def _ordinate(terms: MiddleTerms, area: FloatArray, x: FloatArray) -> FloatArray:
    """Give the ordinates of middle vertices of the area."""
    return np.asarray((area - terms.area + terms.lever[:, 1] * x) / terms.lever[:, 0])


def _rate(ends: FloatArray, terms: MiddleTerms, area: FloatArray, x: FloatArray) -> FloatArray:
    return least_rate(with_middle(ends, x, _ordinate(terms, area, x)), 0)


def _centroid(terms: MiddleTerms, area: FloatArray, x: FloatArray) -> FloatArray:
    return np.asarray(terms.moment_at(x, _ordinate(terms, area, x)) / area)


def _highest(
    ends: FloatArray, terms: MiddleTerms, area: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Find where the least rate is largest: it is concave, so thirds can be left out."""
    for _ in range(_THIRDS):
        one, two = low + (high - low) / 3.0, high - (high - low) / 3.0
        left = _rate(ends, terms, area, one) >= _rate(ends, terms, area, two)
        low, high = np.where(left, low, one), np.where(left, two, high)
    return np.asarray(0.5 * (low + high))


def _edge(
    ends: FloatArray, terms: MiddleTerms, area: FloatArray, inside: FloatArray, outside: FloatArray
) -> FloatArray:
    """Find the last place from inside that runs forward."""
    whole = _rate(ends, terms, area, outside) >= 0.0
    near, far = inside, outside
    for _ in range(_HALVES):
        middle = 0.5 * (near + far)
        forward = _rate(ends, terms, area, middle) >= 0.0
        near, far = np.where(forward, middle, near), np.where(forward, far, middle)
    return np.where(whole, outside, near)


# --------------------------------------------------------------------------------------
# The checks. A curve is taken as rising, from its start up and forward to its finish; a falling one
# is mirrored first. C0 to C6 look at parameters alone, the rest at the curve that they make:
#
# | code | about |
# |---|---|
# | C0 | the finish lies ahead of the start; tangents and area are above 0 |
# | C1 | end angles within 0 and 90 degrees |
# | C2 | curvature at a level or upright end does not lead out of the box of both ends |
# | C3 | the area fits into that box |
# | C4 | so does the moment about the lower end; about x = 0 that would hold for x above 0 only |
# | C4s | the centroid is that of some rising curve of this area: a sharp bound |
# | C5.1, C5.2, C5.3 | start below, above, along the chord: what must hold without inflection |
# | C6 | the area lies between the chord and the two end tangents: so does one without inflection |
# | back, box | the abscissa runs back, the ordinate leaves the box |
# | inflections, loop | the curvature changes its sign, the curve intersects itself |
#
# Conditions C1 to C5 are those of Kim & Kang 1992; C5 looks at the curvature of both ends here.

SEVERITIES = ("error", "warning", "info")

_SAME = 1e-9
"""rad, or a part of the size: so near, two angles or two lengths are one."""


@attrs.frozen
class FormMessage:
    """A remark about a curve.

    Attributes
    ----------
    code : str
        Which condition: see the table in `assoc_hull.geometry.form_curves.checks`.
    severity : str
        One of `SEVERITIES`.
    text : str
        What is so, with the numbers; for a quantity, also which ones would do.
    """

    code: str
    severity: str
    text: str

    def __str__(self) -> str:
        return f"{self.code} {self.severity}: {self.text}"


def check_parameters(curve: FormParameters) -> tuple[FormMessage, ...]:
    """Look at the parameters of a curve; area and centroid that are nan are left out."""
    up = curve.rising
    found = [*_sound(curve)]
    if up.finish_x > up.start_x:
        found += [*_angles(up), *_curvatures(up), *_contents(curve), *_arc(up), *_tangent_area(up)]
    return tuple(found)


def _sound(curve: FormParameters) -> Iterator[FormMessage]:
    """Check C0."""
    if not curve.finish_x > curve.start_x:
        ahead = curve.finish_x - curve.start_x
        text = f"the finish must lie ahead of the start, and lies {ahead:.6g} ahead"
        yield FormMessage("C0", "error", text)
    for name in ("start_tangent", "finish_tangent", "area"):
        value = getattr(curve, name)
        if value <= 0.0:
            text = f"{name.replace('_', ' ')} of {value:.6g}; allowed: above 0"
            yield FormMessage("C0", "error", text)


def _angles(up: FormParameters) -> Iterator[FormMessage]:
    """Check C1."""
    for angle in (up.start_angle, up.finish_angle):
        if not -_SAME <= angle <= 0.5 * math.pi + _SAME:
            text = (
                f"end angle {math.degrees(angle):.6g} deg (of the curve as rising) outside 0..90 "
                "deg: the curve may fold back"
            )
            yield FormMessage("C1", "warning", text)


def _curvatures(up: FormParameters) -> Iterator[FormMessage]:
    """Check C2."""
    chord = math.hypot(up.finish_x - up.start_x, up.finish_y - up.start_y)
    ends = (
        ("start", up.start_angle, up.start_curvature, 1.0),
        ("finish", up.finish_angle, up.finish_curvature, -1.0),
    )
    for end, angle, curvature, inward in ends:
        for what, at, sign in (("level", 0.0, inward), ("upright", 0.5 * math.pi, -inward)):
            if abs(angle - at) <= _SAME and sign * curvature * chord < -_SAME:
                rule = "0 or more" if sign > 0.0 else "0 or less"
                text = (
                    f"curvature {curvature:.6g} at the {what} {end} (of the curve as rising) "
                    f"pushes the curve outside the box of its ends; allowed: {rule}"
                )
                yield FormMessage("C2", "warning", text)


def _contents(curve: FormParameters) -> Iterator[FormMessage]:
    """Check C3, C4 and C4s."""
    if math.isnan(curve.area):
        return
    start, finish = (curve.start_x, curve.start_y), (curve.finish_x, curve.finish_y)
    low, high = area_limits(start, finish)
    if not _within(curve.area, low, high):
        text = f"area {curve.area:.8g} outside the box of the ends; allowed {_span(low, high)}"
        yield FormMessage("C3", "error", text)
    if math.isnan(curve.centroid) or curve.area <= 0.0:
        return
    low, high = centroid_box(start, finish, curve.area)
    if not _within(curve.centroid, low, high):
        text = (
            f"moment outside the box of the ends, with the centroid at {curve.centroid:.8g}; "
            f"allowed {_span(low, high)}"
        )
        yield FormMessage("C4", "error", text)
    low, high = centroid_limits(start, finish, curve.area)
    if low <= high and not _within(curve.centroid, low, high):
        text = (
            f"no monotone curve has its centroid at {curve.centroid:.8g} with this area; "
            f"allowed {_span(low, high)}"
        )
        yield FormMessage("C4s", "warning", text)


def _within(value: float, low: float, high: float) -> bool:
    room = 1e-12 * max(abs(low), abs(high))
    return low - room <= value <= high + room


def _span(low: float, high: float) -> str:
    return f"in [{low:.8g}, {high:.8g}]"


def _arc(up: FormParameters) -> Iterator[FormMessage]:
    """Check C5: what an arc without inflection needs."""
    length, height = up.finish_x - up.start_x, up.finish_y - up.start_y
    beta, room = math.atan2(height, length), _SAME / math.hypot(length, height)
    one, two = up.start_angle - beta, up.finish_angle - beta
    bends = (up.start_curvature, up.finish_curvature)
    if abs(one) <= _SAME:
        code, fine = "C5.3", abs(two) <= _SAME and all(abs(each) <= room for each in bends)
        rule = "is straight: the finish along the chord as well, both curvatures 0"
    elif one < 0.0:
        code, fine = "C5.1", two > _SAME and all(each >= -room for each in bends)
        rule = "is hollow: the finish steeper than the chord, both curvatures 0 or more"
    else:
        code, fine = "C5.2", two < -_SAME and all(each <= room for each in bends)
        rule = "is round: the finish less steep than the chord, both curvatures 0 or less"
    if not fine:
        angles = [math.degrees(each) for each in (up.start_angle, beta)]
        text = (
            f"inflection inside: a curve (as rising) that starts at {angles[0]:.6g} deg, its chord "
            f"at {angles[1]:.6g} deg, has none only if it {rule}"
        )
        yield FormMessage(code, "info", text)


def _tangent_area(up: FormParameters) -> Iterator[FormMessage]:
    """Check C6."""
    length, height = up.finish_x - up.start_x, up.finish_y - up.start_y
    beta = math.atan2(height, length)
    one, two = up.start_angle - beta, up.finish_angle - beta
    if math.isnan(up.area) or abs(one) <= _SAME or abs(two) <= _SAME or one * two > 0.0:
        return
    if max(abs(one), abs(two)) >= 0.5 * math.pi:
        return
    trapezoid = 0.5 * (up.start_y + up.finish_y) * length
    # Between chord and end tangents lies a triangle on the chord.
    triangle = 0.5 * (length**2 + height**2) / (1.0 / math.tan(one) - 1.0 / math.tan(two))
    low, high = sorted((trapezoid, trapezoid + triangle))
    if not _within(up.area, low, high):
        text = f"area {up.area:.8g} needs an inflection or overshoot; without, {_span(low, high)}"
        yield FormMessage("C6", "info", text)


def _forward(vertices: FloatArray) -> str:
    """Say with which centroids the curve would run forward."""
    area = form_integrals(vertices[None]).area
    ends = np.delete(vertices, 3, axis=0)[None]
    low, high = forward_centroids(ends, area)[0].tolist() if area[0] > 0.0 else (math.nan,) * 2
    if math.isnan(low):
        return "allowed: 0 or more, with no centroid of this area; change tangents, angles or area"
    return f"allowed: 0 or more, with this area by a centroid {_span(low, high)}"


def check_shape(vertices: FloatArray) -> tuple[FormMessage, ...]:
    """Look at a curve itself, (7, 2)."""
    found = list[FormMessage]()
    pace = float(least_rate(vertices[None], 0)[0])
    size = float(abs(vertices[6] - vertices[0]).max()) * _SAME
    if pace < -size:
        text = f"the abscissa runs back, at a pace of {pace:.6g} at the least; {_forward(vertices)}"
        found.append(FormMessage("back", "warning", text))
    ends = sorted(
        float((vertices[k, 1] + 4.0 * vertices[k + 1, 1] + vertices[k + 2, 1]) / 6.0)
        for k in (0, 4)
    )
    low = float(least_coordinate(vertices[None], 1)[0])
    high = -float(least_coordinate(-vertices[None], 1)[0])
    if low < ends[0] - size or high > ends[1] + size:
        text = (
            f"the ordinate runs from {low:.8g} to {high:.8g}, beyond those of the ends; "
            f"allowed {_span(*ends)}"
        )
        found.append(FormMessage("box", "warning", text))
    bends = form_inflections(vertices)
    if bends:
        places = ", ".join(f"{each:.4g}" for each in bends)
        text = f"curvature changes its sign {len(bends)} time(s), at t = {places}"
        found.append(FormMessage("inflections", "warning", text))
    if crosses_itself(vertices):
        found.append(FormMessage("loop", "warning", "the curve meets itself"))
    return tuple(found)
