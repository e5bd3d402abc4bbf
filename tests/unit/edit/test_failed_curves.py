"""A curve that could not be made: nothing is computed from the shape that it kept."""

from pathlib import Path

import assoc_hull as ah
from assoc_hull.edit.published_program import published_program
from tests.properties.test_changes import picture
from tests.properties.test_i08_atomicity import failing_at

POINT = "WL 2.5 x ST 7"


def with_a_failed_curve() -> ah.Hull:
    """Give a hull of which an edit that went on left a curve that could not be made."""
    hull = ah.examples.wigley()
    curve = hull.lines["ST 7"].curves[0].number
    with failing_at("loft", 2 * curve + 1), hull.edit("fails", "keep_going") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01, lead=False)
    return hull


def test_a_hull_with_a_curve_that_could_not_be_made_has_no_program() -> None:
    """Only the full way makes it again."""
    hull = with_a_failed_curve()
    assert hull.state.failed
    assert published_program(hull.document) is None
    hull.undo()
    assert published_program(hull.document) is not None


def test_undo_of_a_mend_in_a_file_gives_a_failed_curve_its_last_good_shape(tmp_path: Path) -> None:
    """That is no loft of its points."""
    hull, path = with_a_failed_curve(), tmp_path / "ship.hull"
    hull.save(path)
    hull.close()
    hull = ah.open(path)
    before = picture(hull.state)
    with hull.edit("mends") as edit:
        edit.move(POINT, y=hull.points[POINT].y + 0.01, lead=False)
    assert not hull.state.failed
    after = picture(hull.state)
    hull.close()
    hull = ah.open(path)
    hull.undo()
    assert picture(hull.state) == before
    hull.redo()
    assert picture(hull.state) == after
    hull.close()
