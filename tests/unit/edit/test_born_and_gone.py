"""What an edit of lines says came and went is what came and went."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit


def ids(hull: ah.Hull) -> set[str]:
    """Ids of all crossings."""
    return {crossing.id for crossing in hull.crossings.values()}


@pytest.mark.parametrize(
    ("group", "position"),
    [("waterlines", 3.19), ("sections", 33.3), ("buttocks", 1.7), ("diagonals", (5.0, 35.0))],
    ids=["waterline", "section", "buttock", "diagonal"],
)
def test_crossings_of_a_new_line_are_reported_as_born(
    fresh_series60_70: ah.Hull, group: str, position: float | tuple[float, float]
) -> None:
    """All of them, and no other; those of a removed line as gone."""
    hull = fresh_series60_70
    before = ids(hull)
    with hull.edit("add") as edit:
        line = edit.add_line(group, position, "new")
    after = ids(hull)
    assert edit.report is not None
    assert {key for key in edit.report.born if " x " in key} == after - before
    assert before <= after
    with hull.edit("remove") as edit:
        edit.remove_line(line)
    assert edit.report is not None
    assert {key for key in edit.report.gone if " x " in key} == after - before
    assert ids(hull) == before


def test_a_line_shifted_to_where_it_is_is_no_change() -> None:
    """Nothing is lofted and no step is added."""
    hull = ah.examples.wigley()
    with hull.edit("stay") as edit:
        edit.shift_line("WL 2.5", 2.5)
    assert edit.report is not None
    assert not edit.report.changed
    assert hull.history == ()


def _bent(edit: Edit) -> None:
    bend = [0.02, 0.0, 0.0]
    edit.transform(lambda p: p + np.outer(p[:, 1] ** 2, bend), ["sections", "profile"])


def test_what_a_curve_in_space_cannot_do_is_said(fresh_series60_70: ah.Hull) -> None:
    """It has no plane to be shifted; its watched crossings are told as gone, with the reason."""
    hull = fresh_series60_70
    before = ids(hull)
    with hull.edit("bend") as edit:
        _bent(edit)
    assert edit.report is not None
    assert before - ids(hull) <= set(edit.report.gone)
    assert any("are watched no more: a curve in space" in note for note in edit.report.notes)
    with pytest.raises(ah.errors.BadInputError, match="is a curve in space and has no plane"):
        hull.apply("shift", [{"op": "shift_line", "line": "ST 9", "position": 55.5}])


@pytest.mark.parametrize("tolerance", [0.0, -1.0, 1e-6, True])
def test_a_transformation_is_not_held_closer_than_points_can(tolerance: float) -> None:
    """Not by a tolerance of nil or less, nor by one finer than a tenth of a millimetre."""
    hull = ah.examples.wigley()
    before = hull.fingerprint
    with pytest.raises(ah.errors.BadInputError, match="tolerance"), hull.edit("wide") as edit:
        edit.transform(scale=[1.0, 1.1, 1.0], drivers=["sections"], tolerance=tolerance)
    assert hull.fingerprint == before


def test_a_mapping_that_gives_complex_numbers_is_refused() -> None:
    """Its imaginary part is not thrown away."""
    hull = ah.examples.wigley()
    with pytest.raises(ah.errors.BadInputError, match="complex"), hull.edit("wide") as edit:
        edit.transform(lambda p: p * (1.0 + 0.3j), ["sections"])


def test_the_angle_of_a_diagonal_may_fall_or_rise() -> None:
    """An array will do; level and upright planes are no diagonals, and the error says what is."""
    hull = ah.examples.wigley()
    with hull.edit("rising") as edit:
        edit.add_line("diagonals", np.array([3.0, -20.0]), "up")  # type: ignore[arg-type]
    for angle in (0.0, 90.0, 135.0):
        with (
            pytest.raises(ah.errors.BadInputError, match="below 0 it rises"),
            hull.edit("bad") as edit,
        ):
            edit.add_line("diagonals", (4.0, angle))
