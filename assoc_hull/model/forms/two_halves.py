"""Curves of two halves: run, parallel part and entrance, in the frame of the ship.

Sectional-area curves and design waterlines are such curves. The abscissa is -1 at AP, 0 amidships
and 1 at FP; the ordinate is in parts of ``full``, the area of the midship section or half the
breadth. Angles and curvatures are those of the graph in this frame. A half is a form-parameter
curve with an area and, where asked for, a centroid: made, or refused with the values that would do.
Source: S.Y. Kim, S.W. Kang, Trans. SNAK 29(2), 1992.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import straight_vertices
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.shape import least_coordinate, least_rate
from assoc_hull.model.form_definition import FormDefinition

__all__ = [
    "HalfCurve",
    "half_curve_fault",
    "half_curve_vertices",
    "half_fault",
    "half_number",
    "half_vertices",
    "halves_vertices",
    "reachable",
]

_PLACES = 129
"""So many values are tried between the ends."""

_HALVINGS = 44
"""Halvings that bring an edge of the interval to the last digits of a number."""


def reachable(
    made: Callable[[float], bool], least: float, most: float, asked: float
) -> tuple[float, float] | None:
    """Give the interval of values that can be made nearest to one, `asked`, that cannot.

    `made` tells whether a value can be made; outside of `least` and `most` none can. Both ends can
    be made; None if trying at even steps found nothing.
    """
    places = np.linspace(least, most, _PLACES)[1:-1].tolist()
    good = [made(place) for place in places]
    if not any(good):
        return None
    nearest = min(
        (number for number, fits in enumerate(good) if fits),
        key=lambda number: abs(places[number] - asked),
    )
    low = high = nearest
    while low > 0 and good[low - 1]:
        low -= 1
    while high + 1 < len(good) and good[high + 1]:
        high += 1
    below = places[low - 1] if low else least
    above = places[high + 1] if high + 1 < len(places) else most
    return _edge(made, places[low], below), _edge(made, places[high], above)


def _edge(made: Callable[[float], bool], inside: float, outside: float) -> float:
    """Give the last value that can be made on the way out."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if made(middle) else (inside, middle)
    return inside


# --------------------------------------------------------------------------------------
# One half: made, or refused with the values that would do.

_SLACK = 1e-12
"""Of the size of an interval: so far outside a value may lie."""


@attrs.frozen
class HalfCurve:
    """What a half is made of.

    Attributes
    ----------
    name, where : str
        ``"run"`` or ``"entrance"``; what errors say.
    start, finish : (5,)
        Point (x, y), angle (rad), curvature and tangent at its ends, in the frame of the ship.
    area, centroid : float or None
        None where they come out fairest.
    """

    name: str
    where: str
    start: tuple[float, ...]
    finish: tuple[float, ...]
    area: float | None
    centroid: float | None


def half_curve_vertices(half: HalfCurve) -> FloatArray:
    """Give the vertices of a half, (7, 2).

    Raises
    ------
    OutOfRangeError
        A centroid or an area that the half cannot have, with those that it can have.
    BadInputError
        No centroid and no area would do.
    """
    why = half_curve_fault(half)
    if not why:
        return _made(half)
    x0, x1 = half.start[0], half.finish[0]
    most = max(half.start[1], half.finish[1]) * (x1 - x0)
    for name, asked, low, high, unit in (
        ("centroid", half.centroid, x0, x1, "of half the length"),
        ("area", half.area, 0.0, most, ""),
    ):
        found = None if asked is None else _had(half, name, low, high, asked)
        if asked is not None and found is not None:
            whole = f"{half.name}_{name}"
            raise OutOfRangeError(whole, asked, half.where, why, *found, unit)
    what = f"the {half.name}" if half.area is None else f"{half.name}_area of {half.area:.8g}"
    raise BadInputError(
        f"{what} {why}", half.where,
        f"give other tangents than {half.start[4]:.6g} and {half.finish[4]:.6g} at its ends, or "
        "another area and centroid",
    )  # fmt: skip


def _had(
    half: HalfCurve, name: str, low: float, high: float, asked: float
) -> tuple[float, float] | None:
    """Give the areas, or the centroids, with which the half can be made and stays in its box."""

    def other(value: float) -> HalfCurve:
        if name == "area":
            return attrs.evolve(half, area=value)
        return attrs.evolve(half, centroid=value)

    def keeps(value: float) -> bool:
        return made(value) and not _over(other(value))

    def made(value: float) -> bool:
        return not half_curve_fault(other(value))

    return reachable(keeps, low, high, asked) or reachable(made, low, high, asked)


def _over(half: HalfCurve) -> bool:
    """Tell whether a half rises above the higher of its ends: no section has that area."""
    mirrored = _made(half)[None] * np.array([1.0, -1.0])
    top = max(half.start[1], half.finish[1])
    return bool(-least_coordinate(mirrored, 1)[0] > top + 1e-6)


def _made(half: HalfCurve) -> FloatArray:
    """Give the vertices (7, 2), even if they fold back; nan where there are none."""
    area = None if half.area is None else np.array([half.area])
    centroid = None if half.centroid is None else np.array([half.centroid])
    return np.asarray(
        form_vertices(FormEnd.of(*half.start), FormEnd.of(*half.finish), area, centroid)[0]
    )


def half_curve_fault(half: HalfCurve) -> str:
    """Tell why a half cannot be made, in words that follow a value; empty if it can."""
    length = half.finish[0] - half.start[0]
    low, high = sorted((half.start[1], half.finish[1]))
    if half.area is not None:
        if not (low * length - _SLACK <= half.area <= high * length + _SLACK and half.area > 0.0):
            return "asks for an area outside the box between the ends"
        if half.centroid is not None and not _in_box(half, low, high):
            return "asks for a moment outside the box between the ends"
    vertices = _made(half)
    if not np.isfinite(vertices).all():
        return "cannot be met: no curve has this area and centroid"
    if least_rate(vertices[None], 0)[0] < -_SLACK * length:
        return "makes the curve fold back, with two ordinates at one abscissa"
    return ""


def _in_box(half: HalfCurve, low: float, high: float) -> bool:
    """Tell whether the moment about the lower end lies between those of the lowest and highest."""
    assert half.area is not None
    assert half.centroid is not None
    falls = half.finish[1] < half.start[1]
    arm = half.finish[0] - half.centroid if falls else half.centroid - half.start[0]
    square = 0.5 * (half.finish[0] - half.start[0]) ** 2
    return low * square - _SLACK <= half.area * arm <= high * square + _SLACK


# --------------------------------------------------------------------------------------
# Definitions of two halves.

_DEFAULTS = {
    "run_start": -1.0, "run_start_ordinate": 0.0, "run_start_curvature": 0.0,
    "run_end_angle_deg": 0.0, "run_end_curvature": 0.0, "top": 1.0,
    "entrance_start_angle_deg": 0.0, "entrance_start_curvature": 0.0, "entrance_end": 1.0,
    "entrance_end_ordinate": 0.0, "entrance_end_curvature": 0.0,
}  # fmt: skip
"""What stands for a value that is None."""


def halves_vertices(definition: FormDefinition) -> FloatArray:
    """Give the vertices of run, parallel part and entrance in the frame of the ship.

    Parameters
    ----------
    definition : FormDefinition
        Of two halves. A tangent length that is None is an eighth of the chord; area or
        centroid None come out of the least integral of the squared third derivative.

    Returns
    -------
    (2 or 3, 7, 2)
        There is no parallel part where the run ends where the entrance starts.

    Raises
    ------
    OutOfRangeError
        An abscissa out of order; an area or a centroid that no curve between the ends has,
        with those that one has.
    BadInputError
        A value that is needed is None; tangents with which the curve folds back.
    """
    where = f"in the definition {definition.name!r}"
    if not _in_order(definition, where):
        raise _out_of_order(definition, where)
    run, entrance = (half_vertices(definition, name) for name in ("run", "entrance"))
    begin, end = (_value(definition, where, n) for n in ("run_end", "entrance_start"))
    if begin == end:
        return np.stack([run, entrance])
    top = _value(definition, where, "top")
    return np.stack([run, straight_vertices((begin, top), (end, top)), entrance])


def half_number(definition: FormDefinition, name: str) -> float:
    """Give a value of a definition of two halves, or what stands for it where it is None.

    Raises
    ------
    BadInputError
        It is None, and nothing stands for it.
    """
    return _value(definition, f"in the definition {definition.name!r}", name)


def half_fault(definition: FormDefinition, name: str) -> str:
    """Tell why the ``"run"`` or the ``"entrance"`` cannot be made; empty if it can."""
    where = f"in the definition {definition.name!r}"
    return half_curve_fault(_half(definition, where, name, _ENDS[name]))


def half_vertices(definition: FormDefinition, name: str) -> FloatArray:
    """Give the vertices, (7, 2), of the ``"run"`` or the ``"entrance"`` alone.

    Raises
    ------
    OutOfRangeError, BadInputError
        As for `halves_vertices`.
    """
    where = f"in the definition {definition.name!r}"
    return half_curve_vertices(_half(definition, where, name, _ENDS[name]))


_ENDS = {"run": ("run_start", "run_end"), "entrance": ("entrance_start", "entrance_end")}


def _value(definition: FormDefinition, where: str, name: str) -> float:
    found = definition.value(name)
    if found is None:
        found = _DEFAULTS.get(name)
    if found is None:
        raise BadInputError(f"{name} is None", where, "give a number")
    return found


_ORDER = ("run_start", "run_end", "entrance_start", "entrance_end")


def _in_order(definition: FormDefinition, where: str) -> bool:
    """Tell whether the abscissae of a curve rise; the parallel part may have no length."""
    first, second, third, last = (_value(definition, where, each) for each in _ORDER)
    return first < second <= third < last


def _out_of_order(definition: FormDefinition, where: str) -> OutOfRangeError:
    """Give the error of abscissae out of order: which one could lie elsewhere, and where.

    First that is tried with `run_end` and `entrance_start`; if neither alone would do, the error
    names the first that does not rise.
    """
    values = [_value(definition, where, each) for each in _ORDER]
    for number in (1, 2):
        name, asked = _ORDER[number], values[number]

        def made(value: float, name: str = name) -> bool:
            return _sound(definition.having({name: value}), where)

        found = _searched(made, values[number - 1], values[number + 1], asked)
        if found is not None:
            break
    else:
        wrong = next(n for n in (1, 2, 3) if not values[n - 1] < values[n])
        name, asked, found = _ORDER[wrong], values[wrong], (values[wrong - 1], math.inf)
    place = _ORDER.index(name)
    why = f"is not between {_ORDER[place - 1]} and {(*_ORDER, 'the end')[place + 1]}"
    return OutOfRangeError(name, asked, where, why, *found, "of half the length")


def _searched(
    made: Callable[[float], bool], least: float, most: float, asked: float
) -> tuple[float, float] | None:
    """Look for values stretch by stretch, the nearest first: few of them may do."""
    cuts = itertools.pairwise(np.linspace(least, most, 9).tolist())
    for low, high in sorted(cuts, key=lambda ends: abs(0.5 * (ends[0] + ends[1]) - asked)):
        found = reachable(made, low, high, asked)
        if found is not None:
            return found
    return None


def _sound(definition: FormDefinition, where: str) -> bool:
    """Tell whether both halves can be made."""
    if not _in_order(definition, where):
        return False
    return not any(half_fault(definition, name) for name in _ENDS)


def _half(definition: FormDefinition, where: str, name: str, ends: tuple[str, str]) -> HalfCurve:
    """Gather what a half is made from; None tangents get an eighth of the chord."""
    x = [_value(definition, where, end) for end in ends]
    y = [_value(definition, where, _ordinate(end)) for end in ends]
    angle = [math.radians(_value(definition, where, f"{end}_angle_deg")) for end in ends]
    bend = [_value(definition, where, f"{end}_curvature") for end in ends]
    chord = math.sqrt((x[1] - x[0]) ** 2 + (y[1] - y[0]) ** 2)
    if not x[1] > x[0]:
        raise OutOfRangeError(
            ends[1], x[1], where, f"leaves no room for the {name}", x[0], math.inf,
            "of half the length",
        )  # fmt: skip
    pace = []
    for end in ends:
        given = definition.value(f"{end}_tangent")
        if given is not None and not given > 0.0:
            raise OutOfRangeError(
                f"{end}_tangent", given, where, "is no length", 0.0, math.inf, "of half the length"
            )
        pace.append(0.125 * chord if given is None else given)
    start, finish = zip(x, y, angle, bend, pace, strict=True)
    area, centroid = definition.value(f"{name}_area"), definition.value(f"{name}_centroid")
    if area is None and centroid is not None:
        raise BadInputError(
            f"{name}_centroid is given and {name}_area is None", where, "give both, or the area"
        )
    return HalfCurve(name, where, start, finish, area, centroid)


def _ordinate(end: str) -> str:
    """Give the name of the ordinate at an end; both halves share the top."""
    return "top" if end in ("run_end", "entrance_start") else f"{end}_ordinate"
