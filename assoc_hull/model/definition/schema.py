"""The form of a definition and of published values: which keys, which types, which numbers.

Only the form is checked here; whether names refer to something is found when the tables are
made. The same tables give the JSON Schema (`assoc_hull.io.hull_json`).

Examples
--------
>>> from assoc_hull.model.definition.schema import check_definition
>>> check_definition({"particulars": {"name": "S"}})
Traceback (most recent call last):
...
assoc_hull.errors.BadInputError: the key 'tolerances' is missing, in the definition; ...
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import EndKind, PointKind
from assoc_hull.model.definition.records import code_words
from assoc_hull.model.features import FEATURE_KINDS
from assoc_hull.model.form_definition import FORM_KINDS, GENERATED, RULES
from assoc_hull.model.kinds import FAMILIES, OWN, BoundaryKind, Role, Sort, State
from assoc_hull.model.tables import DECKS, Particulars
from assoc_hull.model.value_schema import (
    COUNT,
    INDEX,
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    TEXT,
    TRUTH,
    ValueSchema,
    WrongValueError,
    described,
    list_of,
    mapping_of,
    one_of,
    or_none,
    record,
    tuple_of,
)
from assoc_hull.tolerance import Tolerances

__all__ = ["DEFINITION", "PUBLISHED", "check_definition", "check_published"]

_REMEDY = "take the file from where it was written, or write it anew"

_VECTOR = described(list_of(REAL, 3, 3), "x forward, y to port, z up; a place in m")
_MEETS = described(
    mapping_of(list_of(tuple_of(REAL, REAL, REAL, REAL))),
    "by key of a line: parameter on this curve and place (t, x, y, z; m) of each meeting",
)
_SHAPE = {
    "knot": described(list_of(REAL, 2), "chord length from the start to each point, m"),
    "leave": described(list_of(_VECTOR, 2), "derivative with which the curve leaves each point"),
    "arrive": described(list_of(_VECTOR, 2), "derivative with which it arrives at each point"),
}
_END = record({"kind": one_of(code_words(EndKind)), "vector": _VECTOR})
_STATE = one_of(code_words(State)[1:])

_LINE = record(
    {"key": NAME, "name": NAME, "group": TEXT},
    {"normal": _VECTOR, "offset": REAL, "boundary": one_of(code_words(BoundaryKind)), "note": NAME},
)
_CURVE = record(
    {
        "key": NAME,
        "line": TEXT,
        "points": described(list_of(TEXT, 2), "keys of its points, along it"),
        "meets": described(
            mapping_of(list_of(tuple_of(one_of((1, -1)), or_none(TEXT)), 1)),
            "by key of a line: sense of each meeting, and the key of its crossing",
        ),
    },
    {
        "start": _END,
        "finish": _END,
        "kept": described(
            record({"state": _STATE, **_SHAPE, "xyz": list_of(_VECTOR, 2), "meets": _MEETS}),
            "the last good shape of a curve that could not be made",
        ),
    },
)
_RIDING = record(
    {
        "anchors": tuple_of(or_none(TEXT), or_none(TEXT)),
        "base": _VECTOR,
        "from": tuple_of(_VECTOR, _VECTOR),
        "weight": REAL,
    }
)
_POINT = record(
    {"key": NAME, "sort": one_of(code_words(Sort)), "curves": list_of(TEXT, 1, 2)},
    {
        "role": one_of(code_words(Role)),
        "birth": described(COUNT, "which crossing of its pair of lines it is, ever"),
        "contact": TRUTH,
        "sign": one_of((1, -1)),
        "label": NAME,
        "override": one_of(code_words(Role)),
        "kinds": list_of(one_of(code_words(PointKind)), 1, 2),
        "directions": list_of(_VECTOR, 1, 2),
        "limit": described(REAL, "largest gap of a watched crossing, m"),
        "riding": described(_RIDING, "between which points an adopted point rides"),
        "value": _VECTOR,
        "state": _STATE,
        "faired": described(_VECTOR, "how far fairing has taken it from its given value, m"),
        "first_role": described(
            one_of(code_words(Role)), "of a crossing before its association was switched"
        ),
        "stands_for": described(NAME, "key of the crossing whose place a stand-in holds"),
    },
)


_FEATURE = record(
    {
        "key": NAME,
        "kind": one_of(FEATURE_KINDS),
        "name": NAME,
        "lines": described(list_of(TEXT, 1), "keys of the lines that it lies on"),
        "points": described(list_of(TEXT, 1), "keys of the points that it owns, along the line"),
    },
    {
        "centre": _VECTOR,
        "radius": POSITIVE,
        "normal": _VECTOR,
        "offset": described(REAL, "normal . place on its plane, m"),
        "direction": _VECTOR,
        "side": described(
            one_of((1, -1)), "1: centre or region lies left of its points, -1: right"
        ),
        "gap": described(NOT_NEGATIVE, "how far its points lie off it at most, m"),
    },
)


_CORNER = described(
    tuple_of(or_none(REAL), or_none(REAL), or_none(REAL)), "of a box, m; null where it has no bound"
)
_RULING = record(
    {
        "a": described(NAME, "name of a group, or key of a line"),
        "b": described(NAME, "likewise"),
        "two_way": TRUTH,
        "low": _CORNER,
        "high": _CORNER,
    }
)


_TUNNEL = record(
    {
        "name": NAME,
        "x": described(REAL, "of its axis, from AP, m"),
        "z": described(REAL, "of its axis, from the base line, m"),
        "radius": described(POSITIVE, "of its inside, m"),
    }
)


_BODY = record(
    {
        "name": NAME,
        "group": described(NAME, "hatches, deck houses, boxes, bossings and so on"),
        "sections": described(
            list_of(list_of(_VECTOR, 3), 2), "closed, from aft forward, of as many points each, m"
        ),
        "corners": described(list_of(INDEX), "points at which edges run along"),
        "both": described(TRUTH, "its mirror image stands on the other side"),
        "sign": described(one_of((1, -1)), "1: stands on the hull, -1: is taken from it"),
    }
)


_FORM = record(
    {
        "use": described(NAME, "what is taken from it; each use stands once"),
        "name": NAME,
        "kind": one_of(FORM_KINDS),
        "rule": described(one_of(RULES), "how a course runs between its nodes"),
        "nodes": described(list_of(NAME), "labels of the nodes of a course, in order"),
        "values": described(mapping_of(REAL), "by name: m, m2, degrees, 1/m or parts"),
    }
)
_MADE = record(
    {
        "curve": described(TEXT, "key of the curve"),
        "what": described(one_of(GENERATED), "what is generated"),
        "layout": described(TEXT, "of which pieces"),
        "points": described(list_of(TEXT), "keys of its generated points, along the curve"),
        "marks": described(
            list_of(tuple_of(NOT_NEGATIVE, NOT_NEGATIVE)),
            "of each point: number of the piece, and parameter (0 to 4) on it",
        ),
    },
    {
        "attached": described(
            TRUTH, "whether the points are those of the definitions; if not told, so"
        )
    },
)


def _fields(cls: type, form: ValueSchema, leave: Collection[str] = ()) -> Mapping[str, ValueSchema]:
    """Give the forms of an attrs class of numbers, and perhaps a name."""
    names = [each.name for each in attrs.fields(cls) if each.name not in leave]
    return {name: TEXT if name == "name" else form for name in names}


_DECK = described(one_of(DECKS), "between the deck edges to port and starboard; open if not told")


DEFINITION = record(
    {
        "particulars": described(
            record(_fields(Particulars, POSITIVE, ("deck",)), {"deck": _DECK}), "m"
        ),
        "tolerances": described(record(_fields(Tolerances, NOT_NEGATIVE)), "m, parts and degrees"),
        "groups": list_of(
            record(
                {"name": NAME, "family": one_of((*FAMILIES, OWN))},
                {"members": described(list_of(NAME), "keys of lines and names of groups")},
            )
        ),
        "associations": described(
            list_of(record({"a": TEXT, "b": TEXT, "two_way": TRUTH})),
            "lines of group a generate points on those of b, and back if two_way",
        ),
        "lines": list_of(_LINE),
        "curves": list_of(_CURVE),
        "points": list_of(_POINT),
        "births": described(
            list_of(tuple_of(TEXT, TEXT, COUNT)),
            "keys of two lines, and how many crossings the pair ever had",
        ),
        "retired": described(
            record(dict.fromkeys(("lines", "curves", "points"), list_of(NAME))),
            "keys that must not come back",
        ),
    },
    {
        "features": described(
            list_of(_FEATURE), "circles, arcs, flats and so on; none if not told"
        ),
        "rulings": described(list_of(_RULING), "which lines rule where; none if not told"),
        "tunnels": described(list_of(_TUNNEL), "through the hull athwartships; none if not told"),
        "bodies": described(list_of(_BODY), "beside the net; none if not told"),
        "definitions": described(list_of(_FORM), "curves of form parameters; none if not told"),
        "generated": described(list_of(_MADE), "curves that come from these; none if not told"),
    },
)
PUBLISHED = record(
    {
        "curves": mapping_of(record({**_SHAPE, "meets": _MEETS})),
        "points": mapping_of(record({}, {"value": _VECTOR, "gap": described(REAL, "m")})),
    }
)


def check_definition(value: object) -> None:
    """Check the form of a definition.

    Raises
    ------
    BadInputError
        With the way to what is wrong, the value and the remedy.
    """
    _check(DEFINITION, value, "the definition")


def check_published(value: object) -> None:
    """Check the form of published values.

    Raises
    ------
    BadInputError
        With the way to what is wrong, the value and the remedy.
    """
    _check(PUBLISHED, value, "the published values")


def _check(form: ValueSchema, value: object, name: str) -> None:
    try:
        form.check(value)
    except WrongValueError as wrong:
        path = "".join(reversed(wrong.path)).lstrip(".")
        where = f"in {name}" + (f", at {path}" if path else "")
        raise BadInputError(wrong.what, where, _REMEDY) from None
