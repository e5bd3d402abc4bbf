"""What a report tells beside what was asked for."""

from __future__ import annotations

import assoc_hull as ah
from assoc_hull.variation.vary import also_changed


def test_lines_that_went_along_under_their_names_are_told() -> None:
    """A name may say where its line was; nothing is told where all stay."""
    parent = ah.examples.wigley()
    asked = {"draught": 7.0}
    told = "10 waterlines and buttocks went along and kept their names: WL 6.25 is at 7 m"
    assert told in parent.vary(set=asked).report.notes
    assert told not in parent.vary(set=asked, planes="stay").report.notes


def test_values_that_changed_unasked_are_told() -> None:
    """On a hull whose depth goes with its draught; what was asked for is not told again."""
    report = ah.examples.wigley().vary(set={"draught": 7.0}).report
    told = [note for note in report.notes if note.startswith("also changed: ")]
    assert len(told) == 1
    assert "depth 9.375 -> 10.125 m" in told[0]
    assert "draught" not in told[0]
    assert told[0] in str(report)


def test_changes_below_a_millimetre_are_not_told() -> None:
    """They are what lofting leaves over; absent values are no changes."""
    assert also_changed({"depth": 27.0, "breadth": 50.0}, {"depth": 27.0009}, {}) == ()
    assert also_changed({"depth": 27.0}, {"depth": 26.9989}, {}) != ()


def test_sections_named_by_their_place_are_told_where_they_are() -> None:
    """A section called by its metres stays called so; numbers of stations say no place."""
    parent = ah.examples.wigley(stations=5, waterlines=4)
    asked = {"length": 102.0}
    assert not [each for each in parent.vary(set=asked).report.notes if "named" in each]
    with parent.edit("names") as edit:
        edit.rename("ST 1", "ST 25")
        edit.rename("ST 3", "frame 75.0")
    told = "2 sections named by their place went along and kept their names"
    assert f"{told}: frame 75.0 is at 76.5 m" in parent.vary(set=asked).report.notes


def test_numbered_sections_that_moved_along_the_ship_are_told() -> None:
    """A number says a part of the length; nothing is told where all stand at theirs, or stay."""
    parent = ah.examples.wigley(stations=5, waterlines=4)
    asked = {"fore_shift": 0.5}
    (told,) = [each for each in parent.vary(set=asked).report.notes if "kept its number" in each]
    assert told.startswith("1 section moved along the ship and kept its number, ST 3 farthest")
    longer = {"length": 102.0}
    for other in (
        parent.vary(set=asked, stations="x"), parent.vary(set=longer),
        parent.vary(set=longer, stations="x"),
    ):  # fmt: skip
        assert not [each for each in other.report.notes if "number" in each]
