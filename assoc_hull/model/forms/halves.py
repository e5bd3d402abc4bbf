"""Curves of two halves: run, parallel part and entrance, in the frame of the ship.

Their abscissa is -1 at AP, 0 amidships and 1 at FP; their ordinate is in parts of ``full``, which
is the area of the midship section, or half the breadth. Angles and curvatures are those of the
graph in this frame. S.Y. Kim, S.W. Kang, Trans. SNAK 29(2), 1992.

Examples
--------
>>> from assoc_hull.model.definition_part import FormDefinition
>>> from assoc_hull.model.forms.halves import halves_vertices
>>> areas = FormDefinition("areas", "sectional_area", "halves", values={
...     "full": 1.0, "run_start_angle_deg": 60.0, "run_start_curvature": -2.0, "run_end": -0.3,
...     "run_area": 0.55, "run_centroid": -0.59, "entrance_start": 0.2, "entrance_area": 0.6,
...     "entrance_centroid": 0.52, "entrance_end_angle_deg": -50.0,
...     "entrance_end_curvature": -2.0,
... })
>>> halves_vertices(areas)[0, 3].round(9).tolist()
[-0.92217359, 0.787861836]
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import straight_vertices
from assoc_hull.model.definition_part import FormDefinition
from assoc_hull.model.forms.half import Half, fault_of, vertices_of
from assoc_hull.model.forms.reachable import reachable

__all__ = ["half_fault", "half_number", "half_vertices", "halves_vertices"]

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
    return fault_of(_half(definition, where, name, _ENDS[name]))


def half_vertices(definition: FormDefinition, name: str) -> FloatArray:
    """Give the vertices, (7, 2), of the ``"run"`` or the ``"entrance"`` alone.

    Raises
    ------
    OutOfRangeError, BadInputError
        As for `halves_vertices`.
    """
    where = f"in the definition {definition.name!r}"
    return vertices_of(_half(definition, where, name, _ENDS[name]))


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
    """Give the error of abscissae out of order: which could lie elsewhere, and where."""
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


def _half(definition: FormDefinition, where: str, name: str, ends: tuple[str, str]) -> Half:
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
    return Half(name, where, start, finish, area, centroid)


def _ordinate(end: str) -> str:
    """Give the name of the ordinate at an end; both halves share the top."""
    return "top" if end in ("run_end", "entrance_start") else f"{end}_ordinate"
