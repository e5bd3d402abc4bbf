"""Swing a curve of sectional areas to a prismatic coefficient and a centre of buoyancy.

The ends of the parallel part move, and each half keeps the fullness and the centroid that it has,
in parts of its own length; that is a quadratic equation. Where the halves would overlap, or one of
them would be too short for a ship, the parallel part stays and the fullness of the halves gives:
their centroids then come out fairest. Lengths are in the frame of the ship, -1 at AP to 1 at FP.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import attrs
import numpy as np
from scipy.optimize import root, root_scalar

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.integrals import form_integrals
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.model.forms.closure import coefficients
from assoc_hull.model.forms.two_halves import half_fault, half_number, half_vertices
from assoc_hull.model.tables import Particulars

__all__ = ["SwungAreas", "half_sums", "move_parallel_part", "scaled_half", "swing_areas"]

_GAP = 0.02
"""The parallel part is at least this long, so that its ends are two places."""

_SHORTEST = (0.40, 0.36, 0.32)
"""No half is shorter: a fifth of the length; less for full ships, where no other curve has both."""

_FULLNESS = (0.45, 0.80)
"""Fullness of a half within which curves of the kind used here rise all the way."""


@attrs.frozen
class SwungAreas:
    """A curve of areas with the coefficients asked for.

    Attributes
    ----------
    definition : FormDefinition
        The curve.
    way : str
        How it was reached, in words.
    """

    definition: FormDefinition
    way: str


def half_sums(definition: FormDefinition, half: str) -> tuple[float, float]:
    """Give area and centroid of a half as it is made."""
    found = form_integrals(half_vertices(definition, half)[None])
    area = float(found.area[0])
    return area, float(found.moment[0]) / area


def scaled_half(definition: FormDefinition, half: str, inner: float) -> FormDefinition:
    """Let the parallel part begin elsewhere: the half is stretched toward it, its end stays."""
    start, finish = _ENDS[half]
    fixed, moved = (start, finish) if half == "run" else (finish, start)
    outer = half_number(definition, fixed)
    stretch = (inner - outer) / (half_number(definition, moved) - outer)
    changes: dict[str, float | None] = {moved: inner}
    for side in ("start", "end"):
        changes |= _stretched_end(definition, f"{half}_{side}", stretch)
    area, centroid = (definition.value(f"{half}_{name}") for name in ("area", "centroid"))
    if area is not None:
        changes[f"{half}_area"] = area * stretch
    if centroid is not None:
        changes[f"{half}_centroid"] = outer + (centroid - outer) * stretch
    return definition.having(changes)


_ENDS = {"run": ("run_start", "run_end"), "entrance": ("entrance_start", "entrance_end")}


def _stretched_end(definition: FormDefinition, end: str, stretch: float) -> dict[str, float | None]:
    """Give angle, curvature and tangent of an end when abscissae are stretched."""
    angle = math.radians(definition.value(f"{end}_angle_deg") or 0.0)
    along, up = stretch * math.cos(angle), math.sin(angle)
    size = math.hypot(along, up)
    found: dict[str, float | None] = {f"{end}_angle_deg": math.degrees(math.atan2(up, along))}
    for name, factor in (("curvature", stretch / size**3), ("tangent", size)):
        value = definition.value(f"{end}_{name}")
        if value is not None:
            found[f"{end}_{name}"] = value * factor
    return found


def swing_areas(definition: FormDefinition, fullness: float, centroid: float) -> SwungAreas:
    """Give a curve of areas of this fullness (prismatic coefficient) and centroid.

    Parameters
    ----------
    definition : FormDefinition
        A curve of areas that runs from -1 to 1 and has the ordinate 1 in its parallel part.
    fullness, centroid : float
        Of the whole curve; the centroid in half lengths from midship, forward positive.

    Raises
    ------
    BadInputError
        No curve of this kind has them.
    """
    ends = _swung(definition, fullness, centroid)
    if ends is not None and ends[1] - ends[0] < _GAP:
        middle = float(np.clip(0.5 * (ends[0] + ends[1]), -0.25, 0.2))
        return _both_areas(definition, fullness, centroid, middle - 0.5 * _GAP, middle + 0.5 * _GAP)
    if ends is None or ends[1] > 1.0 - _SHORTEST[0]:
        return _shortened(definition, fullness, centroid, "entrance")
    if ends[0] < _SHORTEST[0] - 1.0:
        return _shortened(definition, fullness, centroid, "run")
    found = scaled_half(scaled_half(definition, "run", ends[0]), "entrance", ends[1])
    return SwungAreas(_sound(found), "both halves keep their fullness; the parallel part moves")


def move_parallel_part(
    definition: FormDefinition, ship: Particulars, *, cb: float | None, lcb: float | None
) -> FormDefinition:
    """Give a curve of areas with a block coefficient and a centre of buoyancy (m from midship).

    Its halves may end anywhere; what is None stays. Raises BadInputError where no place of the
    parallel part gives both.
    """
    old = coefficients(definition, ship)
    assert old.block is not None
    full = old.block / old.fullness
    wanted = old.block if cb is None else cb, old.centroid if lcb is None else lcb
    inner = [half_number(definition, name) for name in ("run_end", "entrance_start")]
    outer = [half_number(definition, name) for name in ("run_start", "entrance_end")]
    sums = [half_sums(definition, half) for half in _ENDS]

    def miss(ends: FloatArray) -> list[float]:
        # By sums: a trial may be no curve that can be drawn.
        area, moment = ends[1] - ends[0], 0.5 * (ends[1] ** 2 - ends[0] ** 2)
        for end, place, fixed, (own, at) in zip(ends, inner, outer, sums, strict=True):
            by = (end - fixed) / (place - fixed)
            area += own * by
            moment += own * by * (fixed + (at - fixed) * by)
        return [0.5 * area * full - wanted[0], moment / area - 2.0 * wanted[1] / ship.length]

    found = root(miss, np.array(inner), tol=1e-14)
    low, high = found.x.tolist()
    why = ""
    if not (float(np.abs(found.fun).max()) < 1e-10 and outer[0] < low <= high < outer[1]):
        why = "no place of the parallel part gives them"
    else:
        swung = scaled_half(scaled_half(definition, "run", low), "entrance", high)
        faults = [f"the {half} {half_fault(swung, half)}" for half in _ENDS
                  if half_fault(swung, half)]  # fmt: skip
        why = ", and ".join(faults)
    if why:
        what = f"cb of {wanted[0]:.6g} with lcb of {wanted[1]:.6g} m: {why}"
        remedy = f"ask for less than this change from {old.block:.6g} and {old.centroid:.6g} m"
        raise BadInputError(what, f"in the definition {definition.name!r}", remedy)
    return swung


def _swung(
    definition: FormDefinition, fullness: float, centroid: float
) -> tuple[float, float] | None:
    """Give the ends of the parallel part by which halves that keep their shape do it."""
    run, entrance = (half_sums(definition, half) for half in ("run", "entrance"))
    first, last = (half_number(definition, name) for name in ("run_end", "entrance_start"))
    f_r, g_r = run[0] / (1.0 + first), (1.0 + run[1]) / (1.0 + first)
    f_e, g_e = entrance[0] / (1.0 - last), (1.0 - entrance[1]) / (1.0 - last)
    # Area by the lengths of run and entrance, r and e: 2 C = 2 - (1 - f_r) r - (1 - f_e) e.
    slope, offset = (1.0 - f_r) / (1.0 - f_e), (2.0 - 2.0 * fullness) / (1.0 - f_e)
    length = np.polynomial.Polynomial([0.0, 1.0])
    other = offset - slope * length
    moment = (
        f_r * length * (g_r * length - 1.0)
        + f_e * other * (1.0 - g_e * other)
        + 0.5 * ((1.0 - other) ** 2 - (length - 1.0) ** 2)
        - 2.0 * fullness * centroid
    )
    found: list[tuple[float, float]] = [
        (each.real - 1.0, 1.0 - float(other(each.real)))
        for each in moment.roots().tolist()
        if abs(each.imag) < 1e-12 and each.real > 0.0 and other(each.real) > 0.0
    ]
    return min(found, key=lambda ends: abs(ends[0] - first), default=None)


def _free(definition: FormDefinition, half: str, area: float) -> FormDefinition:
    """Give the curve with another area of a half, whose centroid comes out fairest."""
    return definition.having({f"{half}_area": area, f"{half}_centroid": None})


def _both_areas(
    definition: FormDefinition, fullness: float, centroid: float, first: float, last: float
) -> SwungAreas:
    """Hold a parallel part that is next to none, and solve the areas of both halves."""
    start = scaled_half(scaled_half(definition, "run", first), "entrance", last)
    total = 2.0 * fullness - (last - first)

    def made(run: float) -> FormDefinition:
        return _free(_free(start, "run", run), "entrance", total - run)

    low, high = ((1.0 + first) * each for each in _FULLNESS)
    found = _solved(made, centroid, (low, high))
    return SwungAreas(found, "no parallel part is left: the fullness of both halves gives")


def _shortened(
    definition: FormDefinition, fullness: float, centroid: float, half: str
) -> SwungAreas:
    """Let the fullness of a half give; where that does not do, the half is shorter as well."""
    sign = 1.0 if half == "entrance" else -1.0
    for short in _SHORTEST:
        try:
            return _one_area(definition, fullness, centroid, half, sign * (1.0 - short))
        except BadInputError:
            if short == _SHORTEST[-1]:
                raise
    raise AssertionError


def _one_area(
    definition: FormDefinition, fullness: float, centroid: float, half: str, inner: float
) -> SwungAreas:
    """Hold the length of one half, and solve its area and the length of the other."""
    start = scaled_half(definition, half, inner)
    other = "run" if half == "entrance" else "entrance"
    sign = 1.0 if half == "entrance" else -1.0

    def made(place: float) -> FormDefinition:
        swung = scaled_half(start, other, place)
        kept = half_sums(swung, other)[0]
        return _free(swung, half, 2.0 * fullness - kept - sign * (inner - place))

    ends = sign * (_SHORTEST[0] - 1.0), inner - sign * _GAP
    bounds = min(ends), max(ends)
    found = _solved(made, centroid, bounds)
    part = 0.5 * (1.0 - abs(inner))
    why = f"the {half} is not shortened below {part:.2g} of the length: its fullness gives"
    return SwungAreas(found, why)


def _solved(
    made: Callable[[float], FormDefinition], centroid: float, bounds: tuple[float, float]
) -> FormDefinition:
    """Give the curve of a family with a centroid; the first crossing of even steps is refined."""

    def miss(value: float) -> float:
        # Faults are asked for first: an error would look for intervals, which takes long.
        found = made(value)
        if any(half_fault(found, half) for half in _ENDS):
            return math.nan
        return _centroid(found) - centroid

    places = np.linspace(*bounds, 25)
    values = np.array([miss(each) for each in places])
    for left, right, a, b in zip(places, places[1:], values, values[1:], strict=False):
        if np.isfinite([a, b]).all() and a * b <= 0.0:
            best = root_scalar(miss, bracket=(left, right), xtol=1e-15, rtol=1e-14).root
            return _sound(made(best))
    raise BadInputError("no curve of areas has this fullness and centroid", "in a swing", "_")


def _centroid(definition: FormDefinition) -> float:
    run, entrance = (half_sums(definition, half) for half in ("run", "entrance"))
    first, last = (half_number(definition, name) for name in ("run_end", "entrance_start"))
    area = run[0] + entrance[0] + last - first
    return (run[0] * run[1] + entrance[0] * entrance[1] + 0.5 * (last**2 - first**2)) / area


def _sound(definition: FormDefinition) -> FormDefinition:
    """Take a curve whose halves can be made, are of a sound fullness, and give numbers for None."""
    changes: dict[str, float | None] = {}
    for half, (start, finish) in _ENDS.items():
        fault = half_fault(definition, half)
        if fault:
            raise BadInputError(f"the {half} {fault}", "in a swing", "_")
        area, centroid = half_sums(definition, half)
        full = area / (half_number(definition, finish) - half_number(definition, start))
        if not _FULLNESS[0] <= full <= _FULLNESS[1]:
            raise BadInputError(f"the {half} has a fullness of {full:.3f}", "in a swing", "_")
        changes |= {f"{half}_area": area, f"{half}_centroid": centroid}
    return definition.having(changes)
