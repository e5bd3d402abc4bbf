"""Locality, minimality, rebuilding, undo and atomicity with definitions, mixed with other edits.

What a definition changes is told by a hull that is made of the new definitions from nothing.
"""

from functools import cache
from typing import Any
from unittest import mock

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.model import generated_curves as regenerate
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.forms.generate_points import generated_points
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState, copy_state
from tests.formed import formed
from tests.independent import closure, relofted, snapshot
from tests.long_forms import draws
from tests.properties.test_i03_minimality import passes

Act = dict[str, Any]

made = cache(formed)


def fresh() -> ah.Hull:
    """Give a hull of its own."""
    return ah.Hull(copy_state(made()))


SIZES = {
    ("areas", "run_area"): (0.509, 0.513), ("areas", "entrance_end_angle_deg"): (-56.0, -50.0),
    ("areas", "full"): (93.6, 94.0), ("waterline", "run_start_angle_deg"): (68.0, 72.0),
    ("flare", "AP_y"): (15.0, 25.0), ("flare", "FP_y"): (0.0, 20.0), ("rise", "AP_y"): (15.0, 30.0),
    ("sheer", "FP_y"): (9.5, 11.5), ("deck side", "AP_y"): (2.0, 5.0),
    ("deck side", "fore_x"): (75.0, 82.0),
}  # fmt: skip


@st.composite
def forms(draw: st.DrawFn) -> Act:
    """Draw a value for a definition; of some, the same as it has."""
    name, value = draw(st.sampled_from(sorted(SIZES)))
    low, high = SIZES[name, value]
    size = round(draw(st.floats(low, high)), 4)
    return {"op": "set_form", "definition": name, value: size}


SECTION = st.sampled_from([f"ST {x}" for x in range(15, 86, 10)])


@st.composite
def by_hand(draw: st.DrawFn) -> Act:
    """Draw an edit of a line by hand, or its return to the definitions."""
    line, number = draw(SECTION), draw(st.integers(1, 20))
    point = f"{line} @ adopted {number}"
    return draw(
        st.sampled_from([
            {"op": "move", "point": point, "by": draw(st.floats(-0.01, 0.01))},
            {"op": "delete", "point": point},
            {"op": "set_kind", "point": point, "kind": "tangent"},
            {"op": "reattach", "line": line},
            {"op": "shift_line", "line": line, "position": float(line[3:]) + draw(
                st.sampled_from([-0.5, 0.0, 1.0]))},
            {"op": "move", "point": "deck edge @ adopted 12", "by": 0.02},
        ])
    )  # fmt: skip


def carry_out(hull: ah.Hull, acts: list[Act]) -> bool:
    """Make an edit; tell whether it was made. What is refused leaves the hull as it was."""
    before = hull.fingerprint
    said = []
    for act in acts:
        plain = dict(act)
        if "by" in act:
            by, name = plain.pop("by"), act["point"]
            if name not in hull.points:
                return False
            point = hull.points[name]
            plain |= {axis: getattr(point, axis) + by for axis in point.free}
        said.append(plain)
    try:
        hull.apply("drawn", said)
    except ah.AssocHullError:
        assert hull.fingerprint == before
        return False
    return hull.fingerprint != before


@settings(max_examples=draws(20))
@given(st.lists(forms(), min_size=1, max_size=3))
def test_what_is_lofted_is_what_a_new_hull_has_otherwise(acts: list[Act]) -> None:
    """Exactly the curves with an input that differs there, each once, in a closure that is told."""
    hull = fresh()
    before = snapshot(hull)
    with passes() as heard:
        changed = carry_out(hull, acts)
    if not changed:
        return
    report = hull.history[-1]
    record = definition(hull.state)
    again = ah.Hull(from_definition(record))
    assert again.fingerprint == hull.fingerprint
    wanted = relofted(before, again)
    assert len(report.relofted) == len(set(report.relofted))
    assert set(report.relofted) == wanted
    moved = {key for key, bits in snapshot(again).points.items() if before.points.get(key) != bits}
    generated = {key for key in moved if " @ " in key}
    assert wanted <= closure(hull, generated)
    assert report.planned >= len(heard[0].evaluated[Node.is_curve(heard[0].evaluated)])
    for part in heard:
        assert len(set(part.evaluated.tolist())) == len(part.evaluated)


@settings(max_examples=draws(20))
@given(st.lists(st.lists(st.one_of(forms(), by_hand()), min_size=1, max_size=2), max_size=5))
def test_any_edits_leave_a_hull_that_can_be_made_again(edits: list[list[Act]]) -> None:
    """Rebuilt, it has the same bits; detached lines keep theirs; undo and redo are exact."""
    hull = fresh()
    prints = [hull.fingerprint]
    for acts in edits:
        kept = detached(hull.state)
        if not carry_out(hull, acts):
            continue
        prints.append(hull.fingerprint)
        assert hull.verify() == ()
        named = {str(act.get("line", act.get("point", "")))[:5] for act in acts}
        still = detached(hull.state)
        for line, bits in kept.items():
            if line[:5] not in named and "deck edge" not in line:
                assert still[line] == bits
    known = [each.fingerprint for each in hull.document.history]
    assert len(known) == len(prints) - 1
    for wanted in prints[-2::-1]:
        hull.undo()
        assert hull.fingerprint == wanted
    for wanted in prints[1:]:
        hull.redo()
        assert hull.fingerprint == wanted
    assert hull.verify() == ()


def detached(state: HullState) -> dict[str, bytes]:
    """Give the own points of detached lines, by name of the line."""
    return {
        str(state.lines.name[state.line_of(each.curve)]):
            state.rows.xyz[list(each.rows)].tobytes()
        for each in state.generated if not each.attached
    }  # fmt: skip


def test_curves_that_nothing_reaches_keep_bits_and_revision() -> None:
    """A definition that differs aft only leaves the fore body alone."""
    hull = fresh()
    before = snapshot(hull)
    with hull.edit("fuller aft") as edit:
        edit.set_form("areas", run_area=0.512)
    after = snapshot(hull)
    for x in (55, 65, 75, 85):
        key = f"sections:{x}.000000/1"
        assert after.curves[key] == before.curves[key]
        assert after.curve_revisions[key] == before.curve_revisions[key]


def test_a_failure_anywhere_leaves_the_hull_as_it_was() -> None:
    """Injected into each call that makes points, one after the other."""
    hull = fresh()
    acts: list[Act] = [
        {"op": "set_form", "definition": "sheer", "FP_y": 11.0},
        {"op": "set_form", "definition": "areas", "run_area": 0.512},
    ]
    before, given_points = hull.fingerprint, generated_points
    for number in range(20):
        calls = 0

        def fails(*given: Any, number: int = number) -> Any:
            nonlocal calls
            calls += 1
            if calls > number:
                raise BadInputError("the injected failure", "in a test", "nothing")
            return given_points(*given)

        with mock.patch.object(regenerate, "generated_points", fails):
            if carry_out(hull, acts):
                break
        assert hull.fingerprint == before
        assert hull.verify() == ()
        assert len(attached_curves(hull.state)) == 9
    assert number >= 2
    assert hull.verify() == ()


@pytest.mark.parametrize("turn", [1, -1], ids=["in order", "turned round"])
def test_the_order_within_an_edit_plays_no_part(turn: int) -> None:
    """Two definitions and a point of another line, in one transaction."""
    hull = fresh()
    acts: list[Act] = [
        {"op": "set_form", "definition": "areas", "run_area": 0.512},
        {"op": "set_form", "definition": "flare", "AP_y": 24.0},
        {"op": "delete", "point": "ST 45 @ adopted 5"},
    ]
    hull.apply("both", acts[::turn])
    other = fresh()
    other.apply("both", acts)
    assert other.fingerprint == hull.fingerprint
