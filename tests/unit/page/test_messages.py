"""Messages of the page: each field is checked, and whatever is sent gives one sentence at most."""

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import BadInputError
from assoc_hull.page.messages import LONGEST, Apply, Begin, Commit, To, parse

GOOD: dict[str, dict[str, Any]] = {
    "hello": {"version": 1, "token": "a", "author": "anna"},
    "sign": {"author": "anna"},
    "begin": {"gesture": 1, "row": 7, "how": "pull", "radius": [20.0, 8]},
    "to": {"gesture": 1, "seq": 2, "d": 0.012},
    "commit": {"gesture": 1, "seq": 3, "y": 3.5, "z": 1.0, "name": "fuller"},
    "cancel": {"gesture": 1},
    "apply": {"id": 1, "name": "a", "ops": [{"op": "move", "point": "WL 1 x ST 2", "y": 1.0}]},
    "undo": {"id": 1},
    "redo": {"id": 1},
    "parameters": {"id": 1},
    "vary": {"id": 1, "set": {"breadth": 11.5}, "apply": True},
}

WRONG: list[tuple[str, str, Any]] = [
    ("begin", "how", "push"),
    ("begin", "row", -1),
    ("begin", "row", 1.5),
    ("begin", "row", True),
    ("begin", "radius", [1.0]),
    ("begin", "radius", [0.0, 1.0]),
    ("begin", "radius", "wide"),
    ("begin", "gesture", 2**40),
    ("to", "d", True),
    ("to", "d", "0.1"),
    ("to", "d", 1e300),
    ("to", "x", [1.0]),
    ("commit", "name", ""),
    ("commit", "name", "a\nb"),
    ("commit", "name", "a" * 201),
    ("apply", "ops", []),
    ("apply", "ops", ["move"]),
    ("apply", "ops", {"op": "move"}),
    ("hello", "author", "  "),
    ("sign", "author", 7),
    ("undo", "id", None),
    ("vary", "set", {}),
    ("vary", "set", {"breadth": "wide"}),
    ("vary", "set", {"breadth": True}),
    ("vary", "apply", 1),
    ("vary", "accept", 1),
]


@pytest.mark.parametrize("kind", GOOD)
def test_a_message_is_taken_as_it_was_sent(kind: str) -> None:
    """Every field that was given is a field of the message."""
    found = parse(json.dumps({"t": kind, **GOOD[kind]}))
    assert type(found).__name__.lower() == kind
    assert {name: getattr(found, name) for name in GOOD[kind]} == GOOD[kind]


def test_what_is_asked_of_a_drag_is_what_was_given() -> None:
    """Coordinates that were not given are not there, and whole numbers are lengths."""
    found = parse('{"t": "to", "gesture": 1, "seq": 2, "y": 3}')
    assert isinstance(found, To)
    assert found.amounts == {"y": 3.0}
    assert isinstance(parse(json.dumps({"t": "commit", **GOOD["commit"]})), Commit)
    assert isinstance(
        parse(json.dumps({"t": "begin", "gesture": 1, "row": 2, "how": "move"})), Begin
    )
    assert isinstance(parse(json.dumps({"t": "apply", **GOOD["apply"]})), Apply)


@pytest.mark.parametrize(("kind", "field", "value"), WRONG)
def test_a_field_that_does_not_fit_is_named(kind: str, field: str, value: Any) -> None:
    """In one line, with the name of the field."""
    with pytest.raises(BadInputError, match=field) as error:
        parse(json.dumps({"t": kind, **GOOD[kind], field: value}))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("kind", GOOD)
def test_a_field_too_many_or_too_few_is_named(kind: str) -> None:
    """Also those that a class has for itself."""
    for extra in ("more", "__class__", "amounts"):
        with pytest.raises(BadInputError, match="leave it out"):
            parse(json.dumps({"t": kind, **GOOD[kind], extra: 1}))
    first = next(iter(GOOD[kind]))
    rest = {name: value for name, value in GOOD[kind].items() if name != first}
    with pytest.raises(BadInputError, match=f"{first} of {kind} is missing"):
        parse(json.dumps({"t": kind, **rest}))


@pytest.mark.parametrize("text", [
    "", "null", "[]", "3", '"hello"', "{}", '{"t": 7}', '{"t": "Hello"}', '{"t": "__init__"}',
    '{"t": "to", "gesture": 1, "seq": 2, "d": NaN}',
    '{"t": "to", "gesture": 1, "seq": 2, "d": -Infinity}',
    '{"t": "undo", "id": 1, "id": 2}', "[" * 60_000, '{"t": "undo", "id": ' + "9" * 5000 + "}",
    "a" * (LONGEST + 1), "\ud800",
])  # fmt: skip
def test_what_is_no_message_is_one_sentence(text: str) -> None:
    """Nothing of the reader of JSON comes through."""
    with pytest.raises(BadInputError) as error:
        parse(text)
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 400


def told(text: str) -> str:
    """What is wrong with a text; empty if it is a message."""
    try:
        parse(text)
    except BadInputError as error:
        return str(error)
    return ""


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4)
    ),
    max_leaves=8,
)


@given(st.sampled_from(sorted(GOOD)), st.data())
def test_any_value_in_any_field_is_taken_or_told(kind: str, data: st.DataObject) -> None:
    """There is no third way."""
    field = data.draw(st.sampled_from(sorted([*GOOD[kind], "t"])))
    assert "\n" not in told(json.dumps({"t": kind, **GOOD[kind], field: data.draw(VALUES)}))


@given(st.sampled_from(sorted(GOOD)), st.integers(0, 400), st.binary(max_size=3))
def test_a_damaged_text_is_taken_or_told(kind: str, place: int, noise: bytes) -> None:
    """Bytes that were lost or changed on the way never end the server."""
    text = json.dumps({"t": kind, **GOOD[kind]})
    cut = place % len(text)
    assert "\n" not in told(text[:cut] + noise.decode("latin-1") + text[cut + 1 :])
