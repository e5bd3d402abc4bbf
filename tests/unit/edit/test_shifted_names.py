"""A shift of the whole hull says that lines keep the numbers they go by."""

import assoc_hull as ah


def test_a_pure_shift_says_which_numbers_stay() -> None:
    """Sections that moved along keep their names, which is told with their new place."""
    hull = ah.examples.wigley(stations=9, waterlines=5)
    groups = list(hull.groups)
    before = list(hull.groups["sections"].lines)
    with hull.edit("AP 2 m further aft") as edit:
        edit.transform(drivers=groups, shift=(2.0, 0.0, 0.0))
    assert list(hull.groups["sections"].lines) == before
    assert edit.report is not None
    told = [note for note in edit.report.notes if "keep their names" in note]
    assert len(told) == 1
    assert told[0].startswith(f"{len(before)} lines that go by a number")
    assert "edit.rename" in told[0]


def test_other_mappings_say_nothing_of_names() -> None:
    """A hull made longer has its stations where their numbers say."""
    hull = ah.examples.wigley(stations=9, waterlines=5)
    with hull.edit("longer") as edit:
        edit.transform(drivers=list(hull.groups), scale=(1.1, 1.0, 1.0))
    assert edit.report is not None
    assert not any("keep their names" in note for note in edit.report.notes)
