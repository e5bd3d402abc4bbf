"""What the parts of `plot.lines_plan` give, one small example of each."""

from __future__ import annotations

from assoc_hull.plot.lines_plan.before_after import movements
from assoc_hull.plot.lines_plan.drawing import drawing
from assoc_hull.shipped.wigley import wigley


def test_how_far_lines_lie_from_where_they_were() -> None:
    """How far lines lie from where they were."""
    assert movements(drawing(wigley()), drawing(wigley())) == ()


def test_what_is_drawn_of_a_hull_its_lines() -> None:
    """What is drawn of a hull: its lines as polylines, and where they cross."""
    line = drawing(wigley()).line("WL 2.5")
    assert (line.family, line.label, line.offset) == ("waterlines", "2.5", 2.5)
