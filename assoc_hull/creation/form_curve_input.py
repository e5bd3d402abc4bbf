"""What is handed in for a form-parameter curve: checked, and made into vertices."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from typing import Any, Literal

import numpy as np

from assoc_hull.arguments import all_of, choice, number, numbers, positive, shown
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.checks import FormMessage
from assoc_hull.geometry.form_curves.curve import FormEnd, end_vertices
from assoc_hull.geometry.form_curves.middle import fair_vertex, with_middle
from assoc_hull.geometry.form_curves.parameters import NAMES, FormParameters
from assoc_hull.geometry.form_curves.shape import ENERGIES
from assoc_hull.geometry.form_curves.solve import required_middle
from assoc_hull.geometry.form_curves.tangents import (
    FASTEST,
    SLOWEST,
    chords,
    fairest_tangents,
    usual_tangents,
)

__all__ = [
    "PARAMETER_NAMES",
    "Tangents",
    "angles_of",
    "kept_of",
    "made",
    "parameters_of",
    "plane_place",
    "vertices_of",
]  # fmt: skip

Tangents = Literal["default", "auto"] | tuple[float, float] | None
"""How tangent lengths are told."""

_WHERE = "in a form-parameter curve"
_LARGEST, _FARTHEST = 1e12, 1e6
"""Of areas and the like; of coordinates."""

PARAMETER_NAMES = tuple(f"{n}_deg" if n.endswith("_angle") else n for n in NAMES)
"""As they are typed: angles in degrees."""


def vertices_of(given: object) -> FloatArray:
    """Take seven vertices, (7, 2)."""
    try:
        found = np.array(given, np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.empty(0)
    if found.shape != (7, 2) or not (np.abs(found) <= _FARTHEST).all() or _truth(given):
        what = f"the vertices are {shown(given)}"
        raise BadInputError(what, _WHERE, "give seven finite places (x, y)")
    return found + 0.0


def _truth(given: object) -> bool:
    return np.asarray(given).dtype == bool


def notes_of(given: Iterable[FormMessage]) -> tuple[FormMessage, ...]:
    """Take remarks about a curve."""
    return tuple(all_of(given, FormMessage, "notes", _WHERE))


def angles_of(given: tuple[float, float] | None) -> tuple[float, float] | None:
    """Take the angles of both ends, rad."""
    return None if given is None else plane_place(given, "angles")


def plane_place(given: object, name: str, where: str = _WHERE) -> tuple[float, float]:
    """Take a place (x, y)."""
    found = numbers(given, name, where)
    if found.shape != (2,):
        raise BadInputError(f"{name} is {shown(given)}", where, "give (x, y)")
    x, y = found.tolist()
    return x, y


def kept_of(given: object, vertex: int) -> set[str]:
    """Take what is to be kept while a vertex is dragged."""
    where = "in drag"
    if not isinstance(given, Collection) or isinstance(given, str | bytes):
        raise WrongTypeError(f"keep is {shown(given)}", where, 'give ("area", "centroid") or ()')
    kept = {choice(each, "an item of keep", ("area", "centroid"), where) for each in given}
    if kept == {"centroid"}:
        raise BadInputError("keep is the centroid alone", where, 'give ("area", "centroid")')
    if vertex == 3 and len(kept) == 2:
        what = "area and centroid are kept, and the middle vertex is where they put it"
        raise BadInputError(what, where, 'drag another vertex, or keep ("area",) or ()')
    return kept


def parameters_of(given: object) -> tuple[dict[str, Any], Tangents]:
    """Take parameters by name; tangents go apart."""
    if not isinstance(given, Mapping):
        raise WrongTypeError(f"the parameters are {shown(given)}", _WHERE, "give them by name")
    for name in given:
        if name not in PARAMETER_NAMES:
            raise UnknownNameError("parameter of a curve", str(name), PARAMETER_NAMES)
    values = dict(given)
    pair = [values.pop(f"{end}_tangent", None) for end in ("start", "finish")]
    if (pair[0] is None) != (pair[1] is None):
        raise BadInputError("one tangent is given, and the other is not", _WHERE, "give both")
    for name in PARAMETER_NAMES:
        if name not in values and ("curvature" in name or "stretch" in name):
            values[name] = 0.0
        values.setdefault(name, None)
    return values, None if pair[0] is None else (pair[0], pair[1])


def made(
    values: Mapping[str, Any], tangents: Tangents, energy: str
) -> tuple[FloatArray, tuple[FormMessage, ...], tuple[float, float]]:
    """Make the vertices, (7, 2), what is to be said of them, and the angles at both ends."""
    known = _checked(values)
    area, centroid = known.integrals()
    start, finish = known.ends()
    choice(energy, "energy", ENERGIES, _WHERE)
    pace, notes = _tangents(tangents, start, finish, (area, centroid), energy)
    start, finish = (
        FormEnd(e.x, e.y, e.angle, e.curvature, pace[:, k], e.stretch)
        for k, e in enumerate((start, finish))
    )
    ends = np.concatenate([end_vertices(start), end_vertices(finish)], axis=1)
    if np.isnan(area[0]):
        middle = fair_vertex(ends)
    else:
        middle = required_middle(ends, area, None if np.isnan(centroid[0]) else centroid)
    found = with_middle(ends, middle[:, 0], middle[:, 1])[0]
    if not (np.abs(found) <= _FARTHEST).all():
        what = f"these parameters put a vertex {np.abs(found).max():.3g} away"
        raise BadInputError(what, _WHERE, "give smaller curvatures, stretches or tangents")
    return found, notes, (known.start_angle, known.finish_angle)


def _checked(values: Mapping[str, Any]) -> FormParameters:
    """Check the numbers; tangents are none of them."""
    found = dict[str, float]()
    for name in PARAMETER_NAMES:
        if name.endswith("_tangent"):
            found[name] = 1.0
        elif name in ("area", "centroid") and values[name] is None:
            found[name] = math.nan
        elif name.endswith("_angle_deg"):
            found[name.removesuffix("_deg")] = math.radians(number(values[name], name, _WHERE))
        else:
            found[name] = _large(values[name], name)
    if math.isnan(found["area"]) and not math.isnan(found["centroid"]):
        raise BadInputError("a centroid is given without an area", _WHERE, "give the area as well")
    if found["area"] == 0.0 and not math.isnan(found["centroid"]):
        raise BadInputError("an area of 0 has no centroid", _WHERE, "leave the centroid out")
    return FormParameters(**found)


def _large(value: object, name: str) -> float:
    """Take a number: areas are squares of lengths, curvatures inverses of small ones."""
    if isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= _LARGEST:
        return float(value)
    return number(value, name, _WHERE)


def _tangents(
    given: Tangents,
    start: FormEnd,
    finish: FormEnd,
    integrals: tuple[FloatArray, FloatArray],
    energy: str,
) -> tuple[FloatArray, tuple[FormMessage, ...]]:
    """Give the tangent lengths, (1, 2), and what is to be said of them."""
    if (given is None or isinstance(given, str)) and not chords(start, finish)[0] > 0.0:
        remedy = "give ends that differ, or tangents"
        raise BadInputError("start and finish are one place", _WHERE, remedy)
    if given is None or (isinstance(given, str) and given == "default"):
        return usual_tangents(start, finish), ()
    if isinstance(given, str):
        choice(given, "tangents", ("default", "auto"), _WHERE)
        found = fairest_tangents(start, finish, *integrals, energy)
        if not np.isfinite(found.tangents).all():
            # No curve at any pace: that of the usual tangents has a reason to tell.
            return usual_tangents(start, finish), ()
        return found.tangents, tuple(_bounds(found.at_bound[0].tolist(), start, finish))
    pair = [positive(each, "a tangent", _WHERE) for each in plane_place(given, "tangents")]
    return np.array([pair]), ()


def _bounds(active: list[bool], start: FormEnd, finish: FormEnd) -> list[FormMessage]:
    """Say which tangent is held by a bound."""
    even = float(chords(start, finish)[0]) / 4.0
    return [
        FormMessage(
            "bound",
            "info",
            f"the tangent at the {end} is at a bound: from {SLOWEST * even:.6g} to "
            f"{FASTEST * even:.6g}; the fairest curve would have it beyond",
        )
        for end, held in zip(("start", "finish"), active, strict=True)
        if held
    ]
