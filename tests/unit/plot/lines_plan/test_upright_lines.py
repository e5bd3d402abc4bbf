"""The leader of a line that stands upright in a view runs on from its end."""

from pathlib import Path

from tests.drawn_hulls import transom_boat


def test_no_dot_stands_on_a_plumb_transom(tmp_path: Path) -> None:
    """Amidst the transom of the half-breadth plan it would look like a point of the hull."""
    transom_boat(tmp_path).plot.lines_plan(tmp_path / "plan.svg")
    text = (tmp_path / "plan.svg").read_text()
    assert "transom" in text
    assert "leader/dots" not in text
