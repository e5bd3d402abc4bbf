"""Curves of two halves: run, parallel part and entrance, in the frame of the ship.

Their abscissa is -1 at AP, 0 amidships and 1 at FP; their ordinate is in parts of ``full``, which
is the area of the midship section, or half the breadth. Angles and curvatures are those of the
graph in this frame. S.Y. Kim, S.W. Kang, Trans. SNAK 29(2), 1992.

Examples
--------
>>> from assoc_hull.model.forms.definition import FormDefinition
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

import math

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_chain import straight_vertices
from assoc_hull.geometry.form_curve import FormEnd, form_vertices
from assoc_hull.geometry.form_extremes import least_coordinate, least_rate
from assoc_hull.model.forms.definition import FormDefinition
from assoc_hull.model.forms.reachable import reachable

__all__ = ["half_number", "half_vertices", "halves_vertices"]

_DEFAULTS = {
    "run_start": -1.0, "run_start_ordinate": 0.0, "run_start_curvature": 0.0,
    "run_end_angle_deg": 0.0, "run_end_curvature": 0.0, "top": 1.0,
    "entrance_start_angle_deg": 0.0, "entrance_start_curvature": 0.0, "entrance_end": 1.0,
    "entrance_end_ordinate": 0.0, "entrance_end_curvature": 0.0,
}  # fmt: skip
"""What stands for a value that is None."""

_SLACK = 1e-12
"""Of the size of an interval: so far outside a value may lie."""


@attrs.frozen
class _Half:
    """One half: names of its values, and the values."""

    name: str
    where: str
    start: tuple[float, ...]
    finish: tuple[float, ...]
    area: float | None
    centroid: float | None


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
    for least, name, most in (
        ("run_start", "run_end", "entrance_start"),
        ("run_end", "entrance_start", "entrance_end"),
    ):
        _ordered(definition, where, least, name, most)
    run = _vertices(_half(definition, where, "run", ("run_start", "run_end")))
    entrance = _vertices(_half(definition, where, "entrance", ("entrance_start", "entrance_end")))
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


def half_vertices(definition: FormDefinition, name: str) -> FloatArray:
    """Give the vertices, (7, 2), of the ``"run"`` or the ``"entrance"`` alone.

    Raises
    ------
    OutOfRangeError, BadInputError
        As for `halves_vertices`.
    """
    where = f"in the definition {definition.name!r}"
    ends = {"run": ("run_start", "run_end"), "entrance": ("entrance_start", "entrance_end")}[name]
    return _vertices(_half(definition, where, name, ends))


def _value(definition: FormDefinition, where: str, name: str) -> float:
    found = definition.value(name)
    if found is None:
        found = _DEFAULTS.get(name)
    if found is None:
        raise BadInputError(f"{name} is None", where, "give a number")
    return found


def _ordered(definition: FormDefinition, where: str, low: str, name: str, high: str) -> None:
    least, value, most = (_value(definition, where, each) for each in (low, name, high))
    if not least <= value <= most:
        why = f"is not between {low} and {high}"
        raise OutOfRangeError(name, value, where, why, least, most, "of half the length")


def _half(definition: FormDefinition, where: str, name: str, ends: tuple[str, str]) -> _Half:
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
    return _Half(name, where, start, finish, area, centroid)


def _ordinate(end: str) -> str:
    """Give the name of the ordinate at an end; both halves share the top."""
    return "top" if end in ("run_end", "entrance_start") else f"{end}_ordinate"


def _vertices(half: _Half) -> FloatArray:
    """Give the vertices of a half; a refusal tells what can be had."""
    why = _fault(half)
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
    half: _Half, name: str, low: float, high: float, asked: float
) -> tuple[float, float] | None:
    """Give the areas, or the centroids, with which the half can be made and stays in its box."""

    def keeps(value: float) -> bool:
        other = attrs.evolve(half, **{name: value})
        return not _fault(other) and not _over(other)

    def made(value: float) -> bool:
        return not _fault(attrs.evolve(half, **{name: value}))

    return reachable(keeps, low, high, asked) or reachable(made, low, high, asked)


def _over(half: _Half) -> bool:
    """Tell whether a half rises above the higher of its ends: no section has that area."""
    mirrored = _made(half)[None] * np.array([1.0, -1.0])
    top = max(half.start[1], half.finish[1])
    return bool(-least_coordinate(mirrored, 1)[0] > top + 1e-6)


def _made(half: _Half) -> FloatArray:
    """Give the vertices, whatever they are worth; nan where there are none."""
    area = None if half.area is None else np.array([half.area])
    centroid = None if half.centroid is None else np.array([half.centroid])
    return np.asarray(
        form_vertices(FormEnd.of(*half.start), FormEnd.of(*half.finish), area, centroid)[0]
    )


def _fault(half: _Half) -> str:
    """Tell why a half cannot be made; empty if it can."""
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


def _in_box(half: _Half, low: float, high: float) -> bool:
    """Tell whether the moment about the lower end lies between those of the lowest and highest."""
    assert half.area is not None
    assert half.centroid is not None
    falls = half.finish[1] < half.start[1]
    arm = half.finish[0] - half.centroid if falls else half.centroid - half.start[0]
    square = 0.5 * (half.finish[0] - half.start[0]) ** 2
    return low * square - _SLACK <= half.area * arm <= high * square + _SLACK
