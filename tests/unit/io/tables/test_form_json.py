"""Form parameters as JSON: both documents have the form of the schemas that ship."""

from __future__ import annotations

import json
from collections.abc import Callable
from importlib import resources
from typing import Any

import attrs
import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.analysis.form.form_parameters import CATALOGUE, form_report
from assoc_hull.analysis.form.parameter import FormParameter, FormValue
from assoc_hull.io.tables.form_parameters import (
    catalogue_json,
    catalogue_schema,
    form_json,
    form_schema,
)
from assoc_hull.io.tables.json_schema import dumps_schema
from tests.form_entries import bare, doubted, passed_on

OWN = (bare, doubted, passed_on)
SCREW = ah.form.Screw(height=2.0, diameter=3.0)


@pytest.fixture(scope="module")
def values() -> str:
    """The form parameters of a hull, some without a number and one with a warning."""
    hull = ah.examples.wigley()
    return form_json(form_report(hull, draughts=(6.0, 5.0), screw=SCREW, further=OWN))


@pytest.mark.parametrize(
    ("name", "schema"),
    [("form_catalogue", catalogue_schema), ("form_parameters", form_schema)],
)
def test_the_schemas_that_ship_are_sound_and_those_of_the_code(
    name: str, schema: Callable[[], dict[str, Any]]
) -> None:
    """If not: ``python -m assoc_hull schema --of NAME -o assoc_hull/io/NAME.schema.json``."""
    Draft202012Validator.check_schema(schema())
    shipped = resources.files("assoc_hull.io").joinpath(f"{name}.schema.json")
    assert shipped.read_text("utf-8") == dumps_schema(schema())


def valid(schema: dict[str, Any], document: Any) -> bool:
    """Whether a document has the form of a schema."""
    return Draft202012Validator(schema).is_valid(document)


def test_both_documents_are_valid(values: str) -> None:
    """Those of the whole catalogue, of entries of one's own, and of a hull."""
    assert valid(catalogue_schema(), json.loads(catalogue_json()))
    assert valid(catalogue_schema(), json.loads(catalogue_json(OWN)))
    assert valid(form_schema(), json.loads(values))


def test_names_are_those_of_the_python_objects(values: str) -> None:
    """Every attribute but the function; every number to its last bit."""
    (entry, *_) = json.loads(catalogue_json())["entries"]
    told = {field.name for field in attrs.fields(FormParameter)} - {"compute"}
    assert set(entry) == told
    found = json.loads(values)["values"]
    own = ah.examples.wigley().form_parameters(draughts=(6.0, 5.0), screw=SCREW, further=OWN)
    assert {symbol: FormValue(**value) for symbol, value in found.items()} == dict(own)


def test_the_catalogue_is_told_whole() -> None:
    """In its order, with all that an entry says."""
    entries = json.loads(catalogue_json())["entries"]
    assert [each["symbol"] for each in entries] == list(CATALOGUE)
    for each in entries:
        entry = CATALOGUE[each["symbol"]]
        assert {**each, "needs": tuple(each["needs"])} == {
            name: getattr(entry, name) for name in each
        }


def first(values: Any) -> Any:
    """The value of the first entry."""
    return next(iter(values["values"].values()))


DAMAGED_VALUES: dict[str, Callable[[Any], object]] = {
    "another format": lambda d: d.update(format="assoc-hull"),
    "newer schema": lambda d: d.update(schema=2),
    "no header": lambda d: d.pop("header"),
    "unknown key": lambda d: d.update(comment=""),
    "fingerprint cut off": lambda d: d["header"].update(fingerprint="0a"),
    "length of nil": lambda d: d["header"].update(length=0.0),
    "heeled": lambda d: d["position"].update(heel_deg=3.0),
    "draught of text": lambda d: d["position"].update(draught_aft="6"),
    "screw without diameter": lambda d: d["screw"].update(diameter=None),
    "neither number nor reason": lambda d: first(d).update(number=None),
    "both number and reason": lambda d: first(d).update(reason="no bulb"),
    "empty reason": lambda d: d["values"]["bare"].update(reason=""),
    "number of text": lambda d: first(d).update(number="1.0"),
    "no unit": lambda d: first(d).pop("unit"),
    "further key of a value": lambda d: first(d).update(error=0.1),
    "doubts of text": lambda d: d.update(doubts="ST 7 is open"),
}


@pytest.mark.parametrize("change", DAMAGED_VALUES.values(), ids=DAMAGED_VALUES.keys())
def test_damaged_values_are_invalid(values: str, change: Callable[[Any], object]) -> None:
    """Each kind of rule at each level is one of the schema."""
    document = json.loads(values)
    change(document)
    assert not valid(form_schema(), document)


DAMAGED_CATALOGUES: dict[str, Callable[[Any], object]] = {
    "another format": lambda d: d.update(format="assoc-hull form parameters"),
    "no entries": lambda d: d.update(entries=[]),
    "entries by symbol": lambda d: d.update(entries={}),
    "empty symbol": lambda d: d["entries"][0].update(symbol=""),
    "no definition": lambda d: d["entries"][0].pop("definition"),
    "unknown part": lambda d: d["entries"][0].update(table="bulb"),
    "needs of text": lambda d: d["entries"][0].update(needs="shape"),
    "part of a digit": lambda d: d["entries"][0].update(digits=2.5),
    "further key": lambda d: d["entries"][0].update(compute="V / (Lpp B T)"),
}


@pytest.mark.parametrize("change", DAMAGED_CATALOGUES.values(), ids=DAMAGED_CATALOGUES.keys())
def test_damaged_catalogues_are_invalid(change: Callable[[Any], object]) -> None:
    """Each kind of rule at each level is one of the schema."""
    document = json.loads(catalogue_json())
    change(document)
    assert not valid(catalogue_schema(), document)
