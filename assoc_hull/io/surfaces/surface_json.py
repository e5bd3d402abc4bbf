"""Surfaces as JSON: degrees, knots, control nets, weights; numbers come back to the last bit.

The JSON Schema ships beside this module as ``surfaces.schema.json``; ``assoc-hull schema --of
surfaces`` prints it.

Examples
--------
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.surfaces.surface_json import json_of_surfaces, surfaces_of_json
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> found, unit = surfaces_of_json(json_of_surfaces([plate]), "plate.json")[:2]
>>> found[0].name, found[0].net.tobytes() == plate.net.tobytes(), unit
('plate', True, 'm')
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NoReturn

import numpy as np

from assoc_hull.arguments import all_of, once, shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.patches.spline_surface import HIGHEST_DEGREE, SplineSurface
from assoc_hull.io.hull_json import FORMAT as HULL_FORMAT
from assoc_hull.io.units import METRES, unit_note
from assoc_hull.model.value_schema import (
    COUNT,
    POSITIVE,
    REAL,
    TEXT,
    ValueSchema,
    WrongValueError,
    described,
    list_of,
    one_of,
    or_none,
    record,
    tuple_of,
)

__all__ = ["FORMAT", "json_of_surfaces", "surfaces_of_json", "surfaces_schema"]

FORMAT, SCHEMA = "assoc-hull surfaces", 1

_KNOTS = described(list_of(REAL, 4), "in order; control points + degree + 1 of them")
_SURFACE = record(
    {
        "name": described(TEXT, "what tables and messages call it; may be empty"),
        "degrees": described(tuple_of(COUNT, COUNT), "in u and v"),
        "net": described(
            list_of(list_of(tuple_of(REAL, REAL, REAL), 2), 2), "rows of equal u, of [x, y, z]"
        ),
    },
    {
        "knots_u": described(_KNOTS, "left out: one patch, 0 to 1"),
        "knots_v": described(_KNOTS, "left out: one patch, 0 to 1"),
        "weights": described(
            or_none(list_of(list_of(POSITIVE, 2), 2)), "as the net; null: all are equal"
        ),
    },
)
_DOCUMENT = record(
    {
        "format": one_of((FORMAT,)),
        "schema": described(one_of((SCHEMA,)), "version of this form"),
        "unit": described(one_of(tuple(METRES)), "of all lengths"),
        "surfaces": list_of(_SURFACE, 1),
    }
)


def surfaces_schema() -> dict[str, Any]:
    """Give the JSON Schema (draft 2020-12) of surfaces.

    Examples
    --------
    >>> from assoc_hull.io.surfaces.surface_json import surfaces_schema
    >>> surfaces_schema()["required"]
    ['format', 'schema', 'unit', 'surfaces']
    """
    from assoc_hull.io.tables.json_schema import DIALECT

    about = "Spline surfaces, such as shell plates"
    return {"$schema": DIALECT, "title": FORMAT, "description": about, **_DOCUMENT.schema}


def surfaces_of_json(
    text: str, source: str, unit: str | None = None
) -> tuple[list[SplineSurface], str, tuple[str, ...]]:
    """Read surfaces.

    Parameters
    ----------
    text : str
        The document.
    source : str
        Its name, for messages.
    unit : str or None
        The unit of its lengths; None: as it says.

    Returns
    -------
    surfaces : list of SplineSurface
        m.
    unit : str
        The unit.
    notes : tuple of str
        What is to be told.

    Raises
    ------
    BadInputError
        It is no JSON or something else in JSON, or a surface is none.
    """
    document = _document(text, source)
    _require(_DOCUMENT, document, source)
    used = unit or document["unit"]
    found = [
        _surface(each, METRES[used], f"in {source}, surface {place}")
        for place, each in enumerate(document["surfaces"], start=1)
    ]
    return found, used, unit_note(source, document["unit"], used)


def _document(text: str, source: str) -> Any:
    """Take JSON apart."""
    try:
        found = json.loads(text, object_pairs_hook=once, parse_constant=_not_finite)
    except json.JSONDecodeError as error:
        where = f"in {source}, line {error.lineno}, column {error.colno}"
        raise BadInputError(f"this is no JSON ({error.msg})", where, "mend it") from error
    except (ValueError, RecursionError) as error:
        what = f"these are no surfaces ({error})"
        raise BadInputError(what, f"in {source}", "mend it") from error
    form = found.get("format") if isinstance(found, dict) else None
    if form == HULL_FORMAT:
        what = "this is a hull, and no file of surfaces"
        raise BadInputError(what, f"in {source}", "give control nets or an IGES file")
    if form != FORMAT:
        what = f"the format is {shown(form)}"
        raise BadInputError(what, f"in {source}", f"give a document of the format {FORMAT!r}")
    return found


def _not_finite(text: str) -> NoReturn:
    raise ValueError(f"{text} is no finite number")


def _require(form: ValueSchema, document: object, source: str) -> None:
    try:
        form.check(document)
    except WrongValueError as wrong:
        place = "".join(reversed(wrong.path)).removeprefix(".")
        where = f"in {source}, {place}" if place else f"in {source}"
        remedy = "see: assoc-hull schema --of surfaces"
        raise BadInputError(wrong.what, where, remedy) from None


def _surface(given: dict[str, Any], metres: float, where: str) -> SplineSurface:
    net = _rows(given["net"], "the net", where)
    m, n = given["degrees"]
    knots_u, knots_v = (
        np.array(given.get(key) or _bezier_knots(degree, where), np.float64)
        for key, degree in (("knots_u", m), ("knots_v", n))
    )
    told = given.get("weights")
    weights = None if told is None else _rows(told, "the weights", where)
    net = net if metres == 1.0 else net * metres
    try:
        return SplineSurface(given["name"], (m, n), knots_u, knots_v, net, weights)
    except BadInputError as error:
        raise BadInputError(error.what, f"{where}, {error.where}", error.remedy) from error


def _rows(given: list[list[Any]], name: str, where: str) -> FloatArray:
    """Give rows of one length as an array."""
    lengths = {len(row) for row in given}
    if len(lengths) > 1:
        what = f"the rows of {name} have {min(lengths)} to {max(lengths)} points"
        raise BadInputError(what, where, "give each row as many points")
    return np.array(given, np.float64)


def _bezier_knots(degree: int, where: str) -> list[float]:
    if degree > HIGHEST_DEGREE:
        what = f"a degree is {degree}"
        raise BadInputError(what, where, f"give a whole number from 1 to {HIGHEST_DEGREE}")
    return [0.0] * (degree + 1) + [1.0] * (degree + 1)


def json_of_surfaces(surfaces: Sequence[SplineSurface]) -> str:
    """Lay out surfaces as JSON with all digits, m; it ends with a newline.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        At least one.

    Raises
    ------
    BadInputError
        No surface, or something else among them.
    """
    where = "in json_of_surfaces"
    given = all_of(surfaces, SplineSurface, "surfaces", where)
    if not given:
        raise BadInputError("there are no surfaces", where, "give one or more")
    document = {
        "format": FORMAT, "schema": SCHEMA, "unit": "m", "surfaces": [_told(each) for each in given]
    }  # fmt: skip
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


def _told(surface: SplineSurface) -> dict[str, Any]:
    weights = None if surface.weights is None else surface.weights.tolist()
    return {
        "name": surface.name, "degrees": list(surface.degrees),
        "knots_u": surface.knots_u.tolist(), "knots_v": surface.knots_v.tolist(),
        "net": surface.net.tolist(), "weights": weights,
    }  # fmt: skip
