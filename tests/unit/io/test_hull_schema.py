"""The JSON Schema of `.hull.json` and the reader say the same of every document."""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable
from importlib import resources
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.io.hull_json import (
    dumps_hull_json,
    dumps_hull_schema,
    hull_json_schema,
    read_hull_json,
)
from assoc_hull.model.definition.records import check_definition, check_published
from tests.fuzz.kinds.hulls import edited_text, plain_text
from tests.fuzz.values import change_value
from tests.long_forms import draws

VALIDATOR = Draft202012Validator(hull_json_schema())


def test_the_schema_itself_is_sound() -> None:
    """It is one of draft 2020-12, and every mapping in it says which keys it takes."""
    Draft202012Validator.check_schema(hull_json_schema())
    assert hull_json_schema()["$schema"].endswith("2020-12/schema")


def test_the_schema_that_ships_is_that_of_the_reader() -> None:
    """If not: ``python -m assoc_hull schema -o assoc_hull/io/hull_json.schema.json``."""
    shipped = resources.files("assoc_hull.io").joinpath("hull_json.schema.json")
    assert shipped.read_text("utf-8") == dumps_hull_schema()


@pytest.mark.parametrize("example", ["wigley", "series60_60", "series60_70", "bulk_carrier"])
def test_every_example_is_valid(example: str, request: pytest.FixtureRequest) -> None:
    """The text of each hull that ships has the form that the schema tells."""
    shared = example != "wigley"
    hull = request.getfixturevalue(example) if shared else ah.examples.wigley()
    assert errors_of(dumps_hull_json(hull.state)) == []


@pytest.mark.parametrize("text", [plain_text, edited_text], ids=["plain", "edited"])
def test_a_small_hull_is_valid(text: Callable[[], str]) -> None:
    """Also one with most of what a definition can tell."""
    assert errors_of(text()) == []


def errors_of(text: str) -> list[str]:
    """What is wrong with a text by the schema."""
    return [error.message for error in VALIDATOR.iter_errors(json.loads(text))]


def reader_takes_form(document: Any) -> bool:
    """Whether the reader finds nothing wrong with the form of both halves."""
    try:
        check_definition(document["definition"])
        check_published(document["published"])
    except BadInputError:
        return False
    return True


def counts_as_floats(document: Any) -> bool:
    """Whether a count of a valid document stands there as 1.0, as JSON Schema allows."""
    definition = document["definition"]
    counts = [birth[2] for birth in definition["births"]]
    counts += [point.get("birth") for point in definition["points"]]
    return any(isinstance(count, float) for count in counts)


@settings(max_examples=draws(300))
@given(st.randoms(use_true_random=False), st.booleans(), st.integers(1, 2))
def test_reader_and_schema_agree_on_any_change(rng: Random, edited: bool, count: int) -> None:
    """A changed document is valid if and only if the reader takes its form.

    One difference remains: 1.0 is a whole number to JSON Schema, and none to the reader.
    """
    document = json.loads(edited_text() if edited else plain_text())
    half = "definition" if rng.random() < 0.6 else "published"
    document[half] = change_value(rng, document[half], count)
    try:
        valid = VALIDATOR.is_valid(document)
    except RecursionError:  # jsonschema shows a value that is too deep to be shown
        valid = False
    if not (valid and counts_as_floats(document)):
        assert valid == reader_takes_form(document)


REFUSED: dict[str, Callable[[Any], object]] = {
    "another format": lambda d: d.update(format="gltf"),
    "no format": lambda d: d.pop("format"),
    "newer schema": lambda d: d.update(schema=2),
    "schema of truth": lambda d: d.update(schema=True),
    "missing part": lambda d: d.pop("published"),
    "unknown part": lambda d: d.update(comment=""),
    "fingerprint of number": lambda d: d.update(fingerprint=7),
    "fingerprint cut off": lambda d: d.update(fingerprint=d["fingerprint"][:-1]),
    "definition of text": lambda d: d.update(definition="x"),
    "published of nothing": lambda d: d.update(published=None),
    "no births": lambda d: d["definition"].pop("births"),
    "length of nil": lambda d: d["definition"]["particulars"].update(length=0.0),
    "negative tolerance": lambda d: d["definition"]["tolerances"].update(keep=-1e-9),
    "number too large": lambda d: d["definition"]["lines"][0].update(offset=1e13),
    "text for a number": lambda d: d["definition"]["lines"][0].update(offset="1.0"),
    "unknown family": lambda d: d["definition"]["groups"][0].update(family="ribs"),
    "empty key": lambda d: d["definition"]["points"][0].update(key=""),
    "curve of one point": lambda d: d["definition"]["curves"][0].update(points=["a"]),
    "place in a plane": lambda d: d["definition"]["points"][0].update(value=[0.0, 1.0]),
    "count of nil": lambda d: d["definition"]["births"][0].__setitem__(2, 0),
    "sense of nil": lambda d: next(iter(d["definition"]["curves"][-1]["meets"].values()))[
        0
    ].__setitem__(0, 0),
}


@pytest.mark.parametrize("change", REFUSED.values(), ids=REFUSED.keys())
def test_what_the_reader_refuses_for_form_is_invalid(change: Callable[[Any], object]) -> None:
    """Every kind of rule that the reader has, at the top and below, stands in the schema."""
    document = json.loads(plain_text())
    change(document)
    assert not VALIDATOR.is_valid(document)
    with pytest.raises(BadInputError):
        read_hull_json(json.dumps(document))


def changed_keys(before: str, after: str) -> list[str]:
    """What the lines that differ begin with: the object's own key, or that of the line."""
    found = []
    for line in difflib.unified_diff(before.splitlines(), after.splitlines(), n=0):
        if line[:2] == "+ ":
            text = line[1:].strip().rstrip(",")
            record = json.loads(text) if text[0] == "{" else None
            found.append(record["key"] if record else text.partition('": ')[0].strip('"'))
    return found


def test_one_small_edit_changes_the_lines_of_its_objects_only() -> None:
    """One line each for the moved crossing, the curves that followed, and the fingerprint.

    Points that followed stand on lines of their own; no line but these differs.
    """
    hull = ah.examples.wigley()
    name = "WL 2.5 x ST 7"
    before, was = dumps_hull_json(hull.state), values_of(hull)
    with hull.edit("small") as edit:
        edit.move(name, y=hull.points[name].y + 1e-4)
    after, now = dumps_hull_json(hull.state), values_of(hull)
    changed = changed_keys(before, after)
    followed = {key for key, value in now.items() if value != was[key]}
    expected = {"fingerprint", *hull.history[-1].relofted, *followed}
    assert sorted(changed) == sorted(expected)
    assert 4 <= len(changed) < 0.1 * before.count("\n")
    hull.undo()
    assert dumps_hull_json(hull.state) == before


def values_of(hull: ah.Hull) -> dict[str, bytes]:
    """Place and gap of every point, by key."""
    rows, table = hull.state.live("rows"), hull.state.rows
    numbers = np.column_stack([table.xyz[rows], table.gap[rows]])
    return {table.key[row]: each.tobytes() for row, each in zip(rows, numbers, strict=True)}
