"""What a report prints of points and steps is what a person calls them."""

from pathlib import Path

import assoc_hull as ah
from assoc_hull.edit.step import Movement, movement_words


def test_a_report_names_the_point_that_moved_most_by_its_lines(tmp_path: Path) -> None:
    """No key of the tables and no bare place, also when the step is read from its file."""
    hull = ah.examples.wigley(stations=9, waterlines=5)
    hull.save(tmp_path / "ship.hull")
    with hull.edit("fuller") as edit:
        edit.pull("WL 3.125 x ST 7", d=0.05, radius=(20.0, 3.0))
    told = str(edit.report)
    assert " at WL 3.125 x ST 7 (87.500, " in told
    assert ":" not in told.removeprefix("fuller:")
    hull.close()
    again = ah.open(tmp_path / "ship.hull")
    assert str(again.history[0]) == told
    again.close()


def test_a_movement_of_an_older_file_tells_the_place_alone() -> None:
    """Steps that older versions kept have keys and no names: a key is never printed."""
    old = Movement("waterlines:2.500000 x sections:70.000000 +1", 0.01, (70.0, 4.0, 2.5))
    assert movement_words(old, None) == ["largest movement 10.0 mm at (70.000, 4.000, 2.500) m"]


def test_labels_show_dots_only_where_some_are_left_out() -> None:
    """Four names fit; of five the last is a number of dots."""
    hull = ah.examples.wigley(stations=5, waterlines=5)
    assert repr(hull.labels) == "<no checkpoint or branch>"
    for name in ("a", "b", "c", "d"):
        hull.checkpoint(name)
    assert repr(hull.labels) == "<4 by name: a, b, c, d>"
    hull.checkpoint("e")
    assert repr(hull.labels) == "<5 by name: a, b, c, d, ...>"
