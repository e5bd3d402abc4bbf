"""A new line where the lines it is cut from leave its shape open: it follows the others too."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import assoc_hull as ah
from tests.independent import lost_meetings, trouble

GONE = ("ST 0.5", "ST 1", "ST 1.5")
"""Sections at the stern; waterlines and buttocks keep the shape they had there."""

HEIGHT = 1.1


@pytest.fixture
def sparse(series60_60: ah.Hull) -> Iterator[ah.Hull]:
    """Series 60 without some sections at the stern, and with a waterline cut there."""
    with series60_60.edit("fewer sections") as edit:
        for name in GONE:
            edit.remove_line(name)
    with series60_60.edit("cut") as edit:
        edit.add_line("waterlines", HEIGHT, "new")
    yield series60_60
    series60_60.undo(2)


def test_a_new_line_crosses_every_buttock_that_meets_its_plane(sparse: ah.Hull) -> None:
    """From sections alone it missed the innermost buttock aft, so it had no crossing there."""
    buttocks = [line for line in sparse.lines.values() if line.group.name == "buttocks"]
    crossed = [point.parent_curve.line.name for point in sparse.lines["new"].points
               if point.parent_curve is not None]  # fmt: skip
    assert [len(line.meet(((0, 0, 1), HEIGHT))) for line in buttocks] == [
        crossed.count(line.name) for line in buttocks
    ]
    assert list(trouble(sparse)) == []
    new = sparse.lines["new"].id
    assert [each for each in lost_meetings(sparse) if new in each] == []


def test_it_passes_those_meetings_within_the_tolerance(sparse: ah.Hull) -> None:
    """Every watched gap is that of the hull's normal, and is small."""
    gaps = [
        point.crossing.gap
        for point in sparse.lines["new"].points
        if point.crossing is not None and point.crossing.gap is not None
    ]
    assert gaps
    assert np.max(gaps) <= sparse.state.tolerances.adoption
    assert sparse.check() == ()
