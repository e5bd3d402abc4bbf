"""The canonical text of a hull: same hull, same bytes; bad files are refused."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from hypothesis import given, settings

from assoc_hull.edit.document import Document
from assoc_hull.errors import BadInputError, RingError
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json, write_hull_json
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.network import HullNetwork
from assoc_hull.model.tables import HullState, Particulars
from tests.long_forms import draws
from tests.strategies import (
    Move,
    PinnedEdit,
    apply_edit,
    documents,
    make_document,
    pinned_edits,
    wigley_sources,
)


@pytest.fixture(scope="module")
def state() -> HullState:
    """A small net of three families."""
    return wigley_sources(4, 3, 1).adopt()


@pytest.fixture(scope="module")
def text(state: HullState) -> str:
    """Its canonical text."""
    return dumps_hull_json(state)


@settings(max_examples=draws(15))
@given(documents(), pinned_edits(most=3))
def test_same_hull_same_bytes(document: Document, edits: list[PinnedEdit]) -> None:
    """Written, read and written again, a hull gives the same bytes and fingerprint."""
    for edit in edits:
        apply_edit(document, edit)
    text = dumps_hull_json(document.state)
    back = read_hull_json(text)
    assert dumps_hull_json(back) == text
    assert fingerprint(back) == fingerprint(document.state)


def test_opening_never_recomputes(text: str) -> None:
    """Stored values are put back; no curve is lofted and no plane is met."""
    with mock.patch.object(HullNetwork, "evaluate", side_effect=AssertionError):
        assert dumps_hull_json(read_hull_json(text)) == text


def test_a_difference_of_two_texts_shows_the_edit_only() -> None:
    """Moving one crossing changes its own line, its two curves' lines and the fingerprint."""
    document = make_document(wigley_sources(4, 3))
    before = dumps_hull_json(document.state)
    assert apply_edit(document, PinnedEdit((Move(30, 0.001),), False))
    after = dumps_hull_json(document.state)
    lines = difflib.unified_diff(before.splitlines(), after.splitlines(), n=0)
    added = [line for line in lines if line.startswith("+ ")]
    assert len(added) == 4
    curves = len(document.history[-1].report.relofted)
    assert sum('"knot"' in line for line in added) == curves == 2


def test_each_object_has_a_line_of_its_own(state: HullState, text: str) -> None:
    """Lines of text are as many as objects, and a few more for the frame."""
    found = json.loads(text)
    parts = [
        found["definition"][name] for name in ("groups", "lines", "curves", "points", "births")
    ]
    parts += [found["published"]["curves"], found["published"]["points"]]
    assert 0 < text.count("\n") - sum(map(len, parts)) < 40


def test_whole_numbers_are_written_as_floats() -> None:
    """100 and 100.0 m are one hull, so they give one text."""
    one, other = Particulars("S", 100, 20, 10, 8), Particulars("S", 100.0, 20.0, 10.0, 8.0)
    assert dumps_hull_json(HullState(one)) == dumps_hull_json(HullState(other))


def test_a_name_may_hold_any_character(tmp_path: Path) -> None:
    """Letters of any script, quotes and line breaks come back as they were."""
    name = 'Schiff "Ä" 선박\n\\\u2028 {'
    path = tmp_path / "ship.hull.json"
    write_hull_json(HullState(Particulars(name, 1.0, 1.0, 1.0, 1.0)), path)
    assert read_hull_json(path).particulars.name == name
    assert read_hull_json(str(path)).particulars.name == name


def test_a_byte_order_mark_is_passed_over(state: HullState, text: str, tmp_path: Path) -> None:
    """Editors of Windows put one before the text."""
    path = tmp_path / "ship.hull.json"
    path.write_text(text, encoding="utf-8-sig")
    assert fingerprint(read_hull_json(path)) == fingerprint(state)


def test_what_json_cannot_hold_is_refused() -> None:
    """Neither nan nor half a character reaches a file."""
    with pytest.raises(BadInputError):
        Particulars("S", float("nan"), 1.0, 1.0, 1.0)
    with pytest.raises(BadInputError):
        dumps_hull_json(HullState(Particulars("\ud800", 1, 1, 1, 1)))


def changed(text: str, change: Callable[[dict[str, Any]], object]) -> str:
    """The text with one change; the fingerprint stays."""
    found = json.loads(text)
    change(found)
    return json.dumps(found)


BAD = {
    "another format": (lambda d: d.update(format="gltf"), "'format' is 'gltf'"),
    "no format": (lambda d: d.pop("format"), "'format' is None"),
    "newer schema": (lambda d: d.update(schema=2), "'schema' is 2"),
    "schema of truth": (lambda d: d.update(schema=True), "'schema' is True"),
    "missing part": (lambda d: d.pop("published"), "'published' is missing"),
    "unknown part": (lambda d: d.update(comment=""), "'comment' is unknown"),
    "definition of text": (lambda d: d.update(definition="x"), "'definition' is no JSON object"),
    "published of nothing": (lambda d: d.update(published=None), "'published' is no JSON object"),
    "other fingerprint": (lambda d: d.update(fingerprint="0" * 64), "fingerprint"),
    "fingerprint of number": (lambda d: d.update(fingerprint=7), "fingerprint"),
    "moved point": (
        lambda d: d["definition"]["points"][0]["value"].__setitem__(1, 9.0),
        "fingerprint",
    ),
    "moved knot": (
        lambda d: next(iter(d["published"]["curves"].values()))["knot"].__setitem__(1, 1e-3),
        "fingerprint",
    ),
    "unknown point": (
        lambda d: d["definition"]["curves"][0]["points"].append("nobody"),
        "no point 'nobody'",
    ),
    "knots that descend": (
        lambda d: next(iter(d["published"]["curves"].values()))["knot"].__setitem__(1, -1.0),
        "knot 1 is",
    ),
}


@pytest.mark.parametrize(("change", "message"), BAD.values(), ids=BAD.keys())
def test_a_bad_document_is_refused(
    text: str, tmp_path: Path, change: Callable[[dict[str, Any]], object], message: str
) -> None:
    """Wrong schema, keys, types, references or content: file, place, number and remedy."""
    path = tmp_path / "bad.hull.json"
    path.write_text(changed(text, change), encoding="utf-8")
    with pytest.raises(BadInputError) as caught:
        read_hull_json(path)
    assert message in caught.value.what
    assert str(path) in caught.value.where
    assert caught.value.remedy


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param(b"", "no JSON", id="empty"),
        pytest.param(b"offsets\n1 2 3\n", "no JSON", id="text"),
        pytest.param(b"[1, 2]", "no JSON object", id="list"),
        pytest.param(b"\x89PNG\r\n\xff\x00", "no UTF-8", id="binary"),
        pytest.param(b'{"format": "assoc-hull", "schema": NaN}', "NaN", id="nan"),
        pytest.param(b'{"format": "a", "format": "b"}', "twice", id="key twice"),
        pytest.param(b'{"a": ' + b"[" * 100_000, "no hull", id="too deep"),
        pytest.param(b'{"schema": ' + b"9" * 5000 + b"}", "", id="number too long"),
    ],
)
def test_a_file_that_is_no_hull_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    """Whatever the bytes are, the error names the file and what to do."""
    path = tmp_path / "bad.hull.json"
    path.write_bytes(content)
    with pytest.raises(BadInputError) as caught:
        read_hull_json(path)
    assert message in caught.value.what
    assert str(path) in caught.value.where


def test_any_other_error_names_the_file_too(text: str) -> None:
    """Driven links in a ring are an error of the file, like all that it may hold wrong."""
    ring = RingError(("a", "b", "a"))
    with (
        mock.patch("assoc_hull.io.hull_json.from_definition", side_effect=ring),
        pytest.raises(BadInputError, match=r"a -> b -> a.*in the text"),
    ):
        read_hull_json(text)


def test_a_truncated_file_is_refused_wherever_it_ends(text: str) -> None:
    """No beginning of a file makes a hull."""
    for end in range(1, len(text) - 1, len(text) // 23):
        with pytest.raises(BadInputError, match="line"):
            read_hull_json(text[:end])


def test_infinite_numbers_are_refused(text: str) -> None:
    """A number too large for a float is named, with its place."""
    with pytest.raises(BadInputError, match=r"particulars\.length"):
        read_hull_json(text.replace('"length": 100.0', '"length": 1e999'))


def test_a_folder_or_missing_file_is_refused(state: HullState, tmp_path: Path) -> None:
    """Reading and writing name the place that cannot be used."""
    for place in (tmp_path, tmp_path / "no" / "such.hull.json", "no\0name"):
        with pytest.raises(BadInputError):
            read_hull_json(place)
    for place in (tmp_path, tmp_path / "no" / "such.hull.json"):
        with pytest.raises(BadInputError):
            write_hull_json(state, place)


def test_a_write_that_fails_leaves_the_old_file(state: HullState, tmp_path: Path) -> None:
    """The file is replaced whole or not at all, and nothing is left beside it."""
    path = tmp_path / "ship.hull.json"
    path.write_text("old", encoding="utf-8")
    with (
        mock.patch.object(os, "replace", side_effect=OSError("disk full")),
        pytest.raises(BadInputError, match="disk full"),
    ):
        write_hull_json(state, path)
    assert [each.name for each in tmp_path.iterdir()] == [path.name]
    assert path.read_text(encoding="utf-8") == "old"
    path.chmod(0o640)
    write_hull_json(state, path)
    assert path.stat().st_mode & 0o777 == 0o640
    assert fingerprint(read_hull_json(path)) == fingerprint(state)
