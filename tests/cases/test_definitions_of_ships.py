"""Definitions of the ships that ship: what one value lofts again, undo, lines that are detached."""

from collections.abc import Callable

import pytest

import assoc_hull as ah
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition
from tests.independent import relofted, snapshot

CASES = {
    "the run of the carrier": (
        "bulk_carrier_180m", {"definition": "sectional_area", "run_area": 0.5112}, "ST 4"
    ),
    "the flare of the container ship": (
        "container_ship_225m", {"definition": "deck_angle", "x 215_y": 61.0}, "ST 19"
    ),
    "the bulb": ("container_ship_225m", {"definition": "bulb_area", "FP_y": 33.0}, "ST 19"),
}  # fmt: skip


@pytest.fixture(params=CASES)
def case(
    request: pytest.FixtureRequest, shipped: Callable[[str], ah.Hull]
) -> tuple[ah.Hull, dict[str, object], str]:
    """Give a ship of its own, a change of one value, and a section that is to be detached."""
    name, change, line = CASES[request.param]
    return ah.Hull(from_definition(definition(shipped(name).state))), change, line


def test_one_value_lofts_what_depends_on_it_and_nothing_else(
    case: tuple[ah.Hull, dict[str, object], str],
) -> None:
    """The curves are those with an input that differs in a hull made of the new definitions."""
    hull, change, line = case
    start, before = hull.fingerprint, snapshot(hull)
    report = hull.apply("one value", [{"op": "set_form", **change}])
    assert report is not None
    again = ah.Hull(from_definition(definition(hull.state)))
    assert again.fingerprint == hull.fingerprint
    wanted = relofted(before, again)
    assert set(report.relofted) == wanted
    assert 0 < len(wanted) < len(before.curves)
    assert hull.check() == ()
    hull.undo()
    assert hull.fingerprint == start
    point = next(each for each in hull.points if each.startswith(f"{line} @ adopted"))
    hull.apply("by hand", [{"op": "delete", "point": point}])
    kept = snapshot(hull)
    hull.apply("one value", [{"op": "set_form", **change}])
    curves = {each.id for each in hull.lines[line].curves}
    own = {key: bits for key, bits in kept.points.items() if any(key.startswith(c) for c in curves)}
    now = snapshot(hull).points
    assert own
    assert all(now[key] == bits for key, bits in own.items())
    assert [each.object for each in hull.check()] == [line]
    assert hull.verify() == ()
    hull.undo(2)
    assert hull.fingerprint == start


def test_a_shift_along_a_level_keel_leaves_the_hull_consistent(
    shipped: Callable[[str], ah.Hull],
) -> None:
    """Ends of sections follow their planes along a profile of which no bit changes."""
    carrier = shipped("bulk_carrier_180m")
    varied = carrier.vary(set={"fore_shift": 0.5}).hull
    assert varied.verify() == ()
    assert len(varied.check()) == 1  # all detached lines in one finding
    before, after = (hull.lines["ST 14"].position for hull in (carrier, varied))
    assert before is not None
    assert after is not None
    assert after > before


def test_no_section_comes_in_another_number_of_curves(shipped: Callable[[str], ah.Hull]) -> None:
    """Where the bulb would no longer close at a section the edit is refused, with the way out."""
    hull = shipped("container_ship_225m")
    before = hull.fingerprint
    with pytest.raises(
        ah.errors.RefusedEditError, match=r"ST 20\.45 would come in 1 curves instead of 2"
    ):
        hull.apply("a shorter bulb", [{"op": "set_form", "definition": "profile", "tip_x": 229.5}])
    assert hull.fingerprint == before
