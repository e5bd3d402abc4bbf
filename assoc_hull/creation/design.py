"""A design: the data of which a hull is created, and the JSON that holds it.

`Design` is particulars, definitions by form parameters, and the planes of lines; it is checked when
it is made and never changed. `design_schema` says what its JSON may hold. What is not given there
is as if it were null; fullness and centroid asked for by ``close`` are written as the numbers that
came of them.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.arguments import all_of, file_path, instance, number, numbers, once, text
from assoc_hull.errors import BadInputError, NameTakenError, UnknownNameError
from assoc_hull.model.form_definition import HALVES, NODE_FIELDS, RULES, USES, FormDefinition
from assoc_hull.model.forms.closure import close_halves
from assoc_hull.model.tables import DECKS, Particulars
from assoc_hull.model.value_schema import (
    NAME,
    NOT_NEGATIVE,
    POSITIVE,
    REAL,
    ValueSchema,
    WrongValueError,
    described,
    list_of,
    one_of,
    or_none,
    record,
)
from assoc_hull.tolerance import Tolerances

__all__ = [
    "DESIGN_FORMAT",
    "Design",
    "design_document",
    "design_json",
    "design_schema",
    "read_design",
]


_LEAST = 1e-6
"""Planes of one family closer than this (m) are one plane."""


def _definitions(given: object) -> tuple[FormDefinition, ...]:
    return tuple(all_of(given, FormDefinition, "definitions", "in a design"))


def _places(given: object) -> tuple[float, ...]:
    """Take positions of planes, in order."""
    found = np.atleast_1d(numbers(given, "a position of lines", "in a design"))
    return tuple(sorted(found.tolist()))


@attrs.frozen
class Design:
    """What a hull is created of.

    Attributes
    ----------
    particulars : Particulars
        Principal dimensions; sections below the draught have the areas of the curve of areas.
    definitions : tuple of FormDefinition
        Curves of form parameters, each of another use.
    stations : tuple of float
        Where sections stand, in twentieths of the length between perpendiculars: 0 at AP,
        20 at FP; below 0 abaft AP. They are named by these numbers.
    waterlines : tuple of float, m
        Heights.
    buttocks : tuple of float, m
        Half-breadths.
    transom : float or None, m
        x of a flat transom; None where the hull ends on its profile.
    tolerances : Tolerances
        Of the net.
    """

    particulars: Particulars
    definitions: tuple[FormDefinition, ...] = attrs.field(converter=_definitions)
    stations: tuple[float, ...] = attrs.field(default=(), converter=_places)
    waterlines: tuple[float, ...] = attrs.field(default=(), converter=_places)
    buttocks: tuple[float, ...] = attrs.field(default=(), converter=_places)
    transom: float | None = None
    tolerances: Tolerances = attrs.field(factory=Tolerances)

    def __attrs_post_init__(self) -> None:
        where = f"in the design of {_named(self.particulars)!r}"
        instance(self.tolerances, Tolerances, "tolerances", where)
        if self.transom is not None:
            number(self.transom, "transom", where)
        _check_uses(self.definitions, where)
        _check_apart("stations", self.station_places, where)
        _check_apart("waterlines", self.waterlines, where)
        _check_apart("buttocks", self.buttocks, where)

    @property
    def station_places(self) -> tuple[float, ...]:
        """Where sections stand, m from AP."""
        return tuple(each * self.particulars.length / 20.0 for each in self.stations)

    def definition(self, use: str) -> FormDefinition:
        """Give the definition of a use, or of that name.

        Raises
        ------
        UnknownNameError
            There is none.
        """
        for each in self.definitions:
            if use in (each.use, each.name):
                return each
        known = tuple(each.use for each in self.definitions)
        raise UnknownNameError("definition", text(use, "use", "in a design"), known)

    def having(self, *definitions: FormDefinition) -> Design:
        """Give the same design with other definitions in the place of those of their uses."""
        new = {each.use: each for each in _definitions(definitions)}
        kept = tuple(new.pop(each.use, each) for each in self.definitions)
        return attrs.evolve(self, definitions=(*kept, *new.values()))

    def closed(
        self,
        *,
        cb: float | None = None,
        cp: float | None = None,
        lcb: float | None = None,
        cw: float | None = None,
        lcf: float | None = None,
    ) -> Design:
        """Give the same design with curves of areas and waterline closed to these.

        Parameters
        ----------
        cb, cp, cw : float or None
            Block, prismatic and waterplane coefficient.
        lcb, lcf : float or None, m
            Centre of buoyancy and of flotation, from midship, forward positive.

        Raises
        ------
        OutOfRangeError
            No entrance closes the curve; the error tells the interval.
        """
        found, ship = self, self.particulars
        areas = {"cb": cb, "cp": cp, "lcb": lcb}
        if any(each is not None for each in areas.values()):
            found = found.having(close_halves(self.definition("sectional_area"), ship, **areas))
        line = {"cw": cw, "lcf": lcf}
        if any(each is not None for each in line.values()):
            found = found.having(close_halves(self.definition("design_waterline"), ship, **line))
        return found

    def swung(self, *, cb: float | None = None, lcb: float | None = None) -> Design:
        """Give the same design with the parallel part of its curve of areas moved to these.

        Run and entrance are stretched toward it, and keep fullness and centroid in parts of their
        own lengths: that leaves more room than `closed`, by which the entrance alone gives.

        Parameters
        ----------
        cb : float or None
            Block coefficient; that of the curve as it is if None.
        lcb : float or None, m
            Centre of buoyancy from midship, forward positive; likewise.

        Returns
        -------
        Design

        Raises
        ------
        BadInputError
            No place of the parallel part gives them, or a half folds back with it.

        Examples
        --------
        >>> from assoc_hull.model.forms.closure import coefficients
        >>> from assoc_hull.shipped.plain_ship import plain_ship_design
        >>> design = plain_ship_design().swung(cb=0.69)
        >>> found = coefficients(design.definition("sectional_area"), design.particulars)
        >>> round(found.block, 9), round(found.centroid, 9)
        (0.69, -0.6)
        """
        from assoc_hull.creation.area_swing import move_parallel_part

        given = {
            name: value if value is None else number(value, name, "in swung")
            for name, value in (("cb", cb), ("lcb", lcb))
        }
        if cb is None and lcb is None:
            return self
        return self.having(
            move_parallel_part(self.definition("sectional_area"), self.particulars, **given)
        )

    def to_json(self) -> str:
        """Give the design as JSON text, every number to its last bit; it ends with a newline."""
        return design_json(self)

    @classmethod
    def from_json(cls, source: str | os.PathLike[str]) -> Design:
        """Take a design from JSON text or from a file.

        Parameters
        ----------
        source : str or path
            Text that begins with ``{``, or the path of a file.

        Raises
        ------
        BadInputError
            It cannot be read, or does not hold a design; the place in it is named.
        OutOfRangeError
            A closure that it asks for has no entrance.
        """
        return read_design(source)


def _named(particulars: object) -> str:
    return instance(particulars, Particulars, "particulars", "in a design").name


def _check_uses(definitions: Sequence[FormDefinition], where: str) -> None:
    """Check that each use stands once, with its kind, and that none lacks."""
    seen: set[str] = set()
    for each in definitions:
        if each.use not in USES:
            raise UnknownNameError("use of a definition", each.use, tuple(USES))
        if each.use in seen:
            raise BadInputError(f"{each.use} is defined twice", where, "leave one out")
        if each.kind != USES[each.use].kind:
            what = f"{each.use} is a definition of kind {each.kind!r}"
            raise BadInputError(what, where, f"give one of kind {USES[each.use].kind!r}")
        seen.add(each.use)
    names = [each.name for each in definitions]
    for name in names:
        if names.count(name) > 1:
            raise NameTakenError("definition", name)
    for use, known in USES.items():
        if known.needed and use not in seen:
            raise BadInputError(f"it lacks {use}", where, f"define the {known.what}")


def _check_apart(title: str, places: Iterable[float], where: str) -> None:
    """Check that no two planes of a family are one."""
    ordered = list(places)
    for one, other in pairwise(ordered):
        if other - one < _LEAST:
            raise BadInputError(f"two of the {title} stand at {one:g} m", where, "leave one out")


# --------------------------------------------------------------------------------------
# JSON:
#
#     {"format": "assoc-hull design", "schema": 1,
#      "particulars": {"name": ..., "length": ..., "breadth": ..., "depth": ..., "draught": ...},
#      "definitions": [
#        {"use": "sectional_area", "values": {"full": ..., ...}, "close": {"cb": 0.75, "lcb": 2.9}},
#        {"use": "keel_angle", "rule": "straight", "nodes": [{"label": "AP", "x": 0, "y": 40}]}],
#      "stations": [...], "waterlines": [...], "buttocks": [...], "transom": null}

DESIGN_FORMAT = "assoc-hull design"
SCHEMA = 1
"""Version of the schema."""

_MAYBE = or_none(REAL)
_HALVES_USES = tuple(use for use, each in USES.items() if each.kind == "halves")
_COURSE_USES = tuple(use for use, each in USES.items() if each.kind == "course")
_CLOSE = ("cb", "cp", "lcb", "cw", "lcf")

_HALVES = record(
    {
        "use": one_of(_HALVES_USES),
        "values": described(
            record({}, dict.fromkeys(HALVES, _MAYBE)), "in the frame from -1 at AP to 1 at FP"
        ),
    },
    {
        "name": NAME,
        "close": described(
            record({}, dict.fromkeys(_CLOSE, _MAYBE)),
            "coefficients and centroids (m from midship, forward positive) by the entrance",
        ),
    },
)
_NODE = record(
    {"label": NAME, "x": described(REAL, "m from AP"), "y": REAL},
    dict.fromkeys(NODE_FIELDS[2:], _MAYBE),
)
_COURSE = record(
    {"use": one_of(_COURSE_USES), "nodes": list_of(_NODE, 1)},
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


_DEFINITION = ValueSchema(_either, {"anyOf": [_HALVES.schema, _COURSE.schema]})
_DESIGN = record(
    {
        "format": ValueSchema(one_of((DESIGN_FORMAT,)).check, {"const": DESIGN_FORMAT}),
        "schema": ValueSchema(one_of((SCHEMA,)).check, {"const": SCHEMA}),
        "particulars": described(_PARTICULARS, "m"),
        "definitions": list_of(_DEFINITION, 1),
        "stations": described(list_of(REAL), "0 at AP, 20 at FP"),
        "waterlines": described(list_of(REAL), "heights, m"),
        "buttocks": described(list_of(REAL), "half-breadths, m"),
    },
    {"transom": described(_MAYBE, "x, m"), "tolerances": _TOLERANCES},
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
    """Give a design as plain values; tolerances only where they differ from the usual ones."""
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
    except WrongValueError as wrong:
        # The path was gathered from the wrong value outward.
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
            text = file.read_text(encoding="utf-8-sig")
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
