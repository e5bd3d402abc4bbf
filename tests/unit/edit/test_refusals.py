"""Edits that once left a hull inconsistent, or raised an error outside the family."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import assoc_hull as ah

POINT, LINE = "WL 2.5 x ST 3", "WL 2.5"
Act = Callable[[Any], object]

REFUSED: dict[str, Act] = {
    "one-way towards the boundary": lambda e: e.associate("sections", "boundary", two_way=False),
    "boundary taken back": lambda e: e.dissociate("boundary", "sections"),
    "move, then shift of its line": lambda e: (e.move(POINT, y=3.02), e.shift_line(LINE, 2.6)),
    "move, then its line removed": lambda e: (e.move(POINT, y=3.02), e.remove_line(LINE)),
    "move, then one-way": lambda e: (
        e.move(POINT, y=3.02),
        e.associate("sections", "waterlines", two_way=False),
    ),
    "tangent out of the plane": lambda e: e.set_end(LINE, "start", tangent=(1, 0.2, 0.5)),
    "curvature out of the plane": lambda e: e.set_end(LINE, "start", curvature=(0, 0, 0.1)),
    "direction out of the plane": lambda e: e.set_kind(POINT, "tangent", direction=(1, 0, 0.3)),
    "section at the very end": lambda e: e.add_line("sections", 1e-9),
    "waterline at the very keel": lambda e: e.add_line("waterlines", 1e-9),
    "shift to the very keel": lambda e: e.shift_line(LINE, 1e-9),
    "move through the centre plane": lambda e: e.move("deck edge x ST 3", y=-0.5),
    "pull without end": lambda e: e.pull(POINT, 1e5),
    "two_way no truth value": lambda e: e.associate("sections", "waterlines", two_way="nope"),
    "number too large": lambda e: e.move(POINT, y=10**400),
    "kind no text": lambda e: e.set_kind(POINT, []),
    "role no text": lambda e: e.set_role(POINT, []),
    "group no text": lambda e: e.add_line(None, 3.0),
    "lines no list": lambda e: e.renew_roles(None),
    "point no address": lambda e: e.move(3, y=1.0),
    "name not printable": lambda e: e.rename(LINE, "\ud800"),
    "name of a group": lambda e: e.rename(LINE, "sections"),
    "name like a key": lambda e: e.rename(LINE, "waterlines:3.750000"),
    "name like an address": lambda e: e.rename(LINE, POINT),
    "radius of three": lambda e: e.pull(POINT, 0.01, (1.0, 2.0, 3.0)),
    "radius nil": lambda e: e.pull(POINT, 0.01, (0.0, 2.0)),
    "span turned round": lambda e: e.reshape(LINE, [[40, 3, 2.5]], span=(50.0, 30.0)),
    "shape no places": lambda e: e.reshape(LINE, "abc", span=(30.0, 50.0)),
    "fade of one": lambda e: e.reshape(LINE, [[40, 3, 2.5]], span=(30.0, 50.0), fade=(1.0,)),
}
TANGENTS: tuple[object, ...] = (
    "abc", ["a"], {}, [1, [2], 3], 1j, object(), (0, 0, 0), (1e300, 0, 0),
)  # fmt: skip


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A small net; every edit here is refused, so it may be shared."""
    return ah.examples.wigley(stations=9, waterlines=6)


@pytest.mark.parametrize("act", REFUSED.values(), ids=REFUSED.keys())
def test_the_edit_is_refused_and_the_hull_is_as_it_was(hull: ah.Hull, act: Act) -> None:
    """An error of the family that can be printed; not one bit changed, no step recorded."""
    before = hull.fingerprint
    with pytest.raises(ah.AssocHullError) as caught, hull.edit("try") as edit:
        act(edit)
    assert str(caught.value)
    assert hull.fingerprint == before
    assert hull.history == ()


@pytest.mark.parametrize("tangent", TANGENTS, ids=[type(each).__name__ for each in TANGENTS])
def test_what_is_no_direction_is_refused(hull: ah.Hull, tangent: Any) -> None:
    """Text, lists of text, mappings, ragged lists, objects, nil, numbers beyond any ship."""
    before = hull.fingerprint
    with pytest.raises(ah.errors.BadInputError), hull.edit("try") as edit:
        edit.set_end(LINE, "start", tangent=tangent)
    assert hull.fingerprint == before


def test_a_fold_of_a_line_made_in_the_same_edit_is_found() -> None:
    """A new line has no shape before the edit that could excuse a fold."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    before = hull.fingerprint
    with pytest.raises(ah.errors.RefusedEditError):
        _fold(hull)
    assert hull.fingerprint == before


def _fold(hull: ah.Hull) -> None:
    with hull.edit("fold") as edit:
        line = edit.add_line("buttocks", 2.0)
        start = line.curves[0].at(3.0)
        edit.insert(line.curves[0], (start[0] - 8.0, 2.0, start[2] - 0.02), lead=False)
