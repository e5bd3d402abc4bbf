"""Designs as JSON.

    {"format": "assoc-hull design", "schema": 1,
     "particulars": {"name": ..., "length": ..., "breadth": ..., "depth": ..., "draught": ...},
     "definitions": [
       {"use": "sectional_area", "values": {"full": ..., ...}, "close": {"cb": 0.75, "lcb": 2.9}},
       {"use": "keel_angle", "rule": "straight", "nodes": [{"label": "AP", "x": 0, "y": 40}]}],
     "stations": [...], "waterlines": [...], "buttocks": [...], "transom": null}

What is not given is as if it were null. ``close`` asks for the entrance that gives the fullness
and the centroid; what is written has the numbers that came of it.

Examples
--------
>>> from assoc_hull.creation.design_json import design_schema
>>> design_schema()["properties"]["schema"]
{'const': 1}
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs

from assoc_hull.arguments import file_path, once
from assoc_hull.creation.design import Design
from assoc_hull.errors import BadInputError
from assoc_hull.model.definition_part import HALVES, NODE_FIELDS, RULES, FormDefinition
from assoc_hull.model.forms.closure import close_halves
from assoc_hull.model.state import DECKS, Particulars
from assoc_hull.model.uses import USES
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    Form,
    WrongError,
    listed,
    one_of,
    or_none,
    record,
    told,
)
from assoc_hull.tolerance import Tolerances

__all__ = ["DESIGN_FORMAT", "design_document", "design_json", "design_schema", "read_design"]

DESIGN_FORMAT = "assoc-hull design"
SCHEMA = 1
"""Version of the form."""

_MAYBE = or_none(REAL)
_HALVES_USES = tuple(use for use, each in USES.items() if each.kind == "halves")
_COURSE_USES = tuple(use for use, each in USES.items() if each.kind == "course")
_CLOSE = ("cb", "cp", "lcb", "cw", "lcf")

_HALVES = record(
    {
        "use": one_of(_HALVES_USES),
        "values": told(
            record({}, dict.fromkeys(HALVES, _MAYBE)), "in the frame from -1 at AP to 1 at FP"
        ),
    },
    {
        "name": NAME,
        "close": told(
            record({}, dict.fromkeys(_CLOSE, _MAYBE)),
            "coefficients and centroids (m from midship, forward positive) by the entrance",
        ),
    },
)
_NODE = record(
    {"label": NAME, "x": told(REAL, "m from AP"), "y": REAL},
    dict.fromkeys(NODE_FIELDS[2:], _MAYBE),
)
_COURSE = record(
    {"use": one_of(_COURSE_USES), "nodes": listed(_NODE, 1)},
    {"name": NAME, "rule": one_of(RULES)},
)
_PARTICULARS = record(
    {"name": NAME, **dict.fromkeys(("length", "breadth", "depth", "draught"), POSITIVE)},
    {"deck": one_of(DECKS)},
)
_TOLERANCES = record({}, {each.name: NOT_NEGATIVE for each in attrs.fields(Tolerances)})


def _either(value: object) -> None:
    """Check a definition by the form that its use asks for."""
    halves = isinstance(value, dict) and value.get("use") in _HALVES_USES
    (_HALVES if halves else _COURSE).check(value)


_DEFINITION = Form(_either, {"anyOf": [_HALVES.schema, _COURSE.schema]})
_DESIGN = record(
    {
        "format": Form(one_of((DESIGN_FORMAT,)).check, {"const": DESIGN_FORMAT}),
        "schema": Form(one_of((SCHEMA,)).check, {"const": SCHEMA}),
        "particulars": told(_PARTICULARS, "m"),
        "definitions": listed(_DEFINITION, 1),
        "stations": told(listed(REAL), "0 at AP, 20 at FP"),
        "waterlines": told(listed(REAL), "heights, m"),
        "buttocks": told(listed(REAL), "half-breadths, m"),
    },
    {"transom": told(_MAYBE, "x, m"), "tolerances": _TOLERANCES},
)


def design_schema() -> dict[str, Any]:
    """Give the JSON Schema of a design."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": DESIGN_FORMAT,
        "description": "What a hull is created of: particulars, definitions, places of lines.",
        **_DESIGN.schema,
    }


def design_json(design: Design) -> str:
    """Give a design as JSON text; it ends with a newline."""
    return json.dumps(design_document(design), indent=1, allow_nan=False) + "\n"


def design_document(design: Design) -> dict[str, Any]:
    """Give a design as plain values."""
    usual = attrs.asdict(Tolerances())
    found: dict[str, Any] = {
        "format": DESIGN_FORMAT,
        "schema": SCHEMA,
        "particulars": attrs.asdict(design.particulars),
        "definitions": [_definition(each) for each in design.definitions],
        "stations": list(design.stations),
        "waterlines": list(design.waterlines),
        "buttocks": list(design.buttocks),
        "transom": design.transom,
    }
    own = {n: v for n, v in attrs.asdict(design.tolerances).items() if v != usual[n]}
    return found | ({"tolerances": own} if own else {})


def _definition(definition: FormDefinition) -> dict[str, Any]:
    given = {name: value for name, value in definition.values.items() if value is not None}
    found: dict[str, Any] = {"use": definition.use, "name": definition.name}
    if definition.kind == "halves":
        return found | {"values": given}
    nodes = [
        {"label": node}
        | {field: given[f"{node}_{field}"] for field in NODE_FIELDS if f"{node}_{field}" in given}
        for node in definition.nodes
    ]
    return found | {"rule": definition.rule, "nodes": nodes}


def read_design(source: str | os.PathLike[str]) -> Design:
    """Take a design from JSON text or a file; see `Design.from_json`."""
    found, where = _loaded(source)
    try:
        _DESIGN.check(found)
    except WrongError as wrong:
        way = "".join(reversed(wrong.path)).lstrip(".")
        place = f"at {way}, {where}" if way else where
        raise BadInputError(wrong.what, place, "mend it") from None
    ship = Particulars(**found["particulars"])
    return Design(
        ship,
        [_read_definition(each, ship) for each in found["definitions"]],
        found["stations"], found["waterlines"], found["buttocks"], found.get("transom"),
        Tolerances(**found.get("tolerances", {})),
    )  # fmt: skip


def _loaded(source: str | os.PathLike[str]) -> tuple[Any, str]:
    """Give what a text or a file holds, and how it is named in errors."""
    if isinstance(source, str) and source.lstrip()[:1] == "{":
        text, where = source, "in the design"
    else:
        file = Path(file_path(source, "in a design"))
        where = f"in {file}"
        try:
            text = file.read_text(encoding="utf-8")
        except OSError as error:
            raise BadInputError(
                f"{error.strerror or error}", where, "check name and place"
            ) from error
        except ValueError as error:
            raise BadInputError("it is no text", where, "give a JSON file") from error
    try:
        return json.loads(text, object_pairs_hook=once), where
    except (ValueError, RecursionError) as error:
        raise BadInputError(f"it is no JSON: {error}", where, "mend it") from error


def _read_definition(given: Mapping[str, Any], ship: Particulars) -> FormDefinition:
    use = given["use"]
    name = given.get("name", use.replace("_", " "))
    if use in _HALVES_USES:
        found = FormDefinition(name, use, "halves", given["values"])
        return close_halves(found, ship, **given["close"]) if "close" in given else found
    nodes = given["nodes"]
    values = {
        f"{node['label']}_{field}": node[field]
        for node in nodes for field in NODE_FIELDS if field in node
    }  # fmt: skip
    labels = tuple(node["label"] for node in nodes)
    return FormDefinition(name, use, "course", values, given.get("rule", "form"), labels)
