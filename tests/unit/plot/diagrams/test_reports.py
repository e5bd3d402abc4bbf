"""Pictures of an edit, of curvature, and of who drives whom."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.plot import before_after, snapshot
from assoc_hull.plot.diagrams.driver_graph import drive_links, neighbourhood
from assoc_hull.plot.lines_plan.before_after import movements
from assoc_hull.plot.lines_plan.curvature_combs import curvature_combs
from assoc_hull.plot.lines_plan.drawing import Drawing, drawing
from assoc_hull.plot.sheet.labels import overlaps
from assoc_hull.plot.sheet.paper import MARGIN, PAPERS, PaperName

Boxes = Callable[[Figure], dict[str, FloatArray]]
Lines = Callable[[Figure, str], list[FloatArray]]


@pytest.fixture(scope="module")
def pulled() -> tuple[Hull, Drawing]:
    """The Wigley hull with one waterline pulled by 20 mm, and its snapshot from before."""
    hull = examples.wigley()
    before = snapshot(hull)
    with hull.edit("pull") as edit:
        edit.pull(hull.points["WL 2.5 x ST 7"], d=0.02, radius=(15.0, 3.0))
    return hull, before


def ids(figure: Figure, begin: str) -> list[str]:
    """Ids of lines and patches that begin like this."""
    every = (*figure.axes[0].lines, *figure.axes[0].patches)
    return [gid for each in every if (gid := each.get_gid() or "").startswith(begin)]


def words(figure: Figure) -> str:
    """Everything that is written."""
    return "\n".join(text.get_text() for text in figure.axes[0].texts)


def test_movement_is_taken_along_the_normal(pulled: tuple[Hull, Drawing]) -> None:
    """The largest is the pull, at the point that was pulled; far lines have not moved."""
    hull, before = pulled
    found = movements(drawing(before), drawing(hull))
    assert found[0].line in ("ST 7", "WL 2.5")
    assert found[0].distance == pytest.approx(0.02, rel=0.01)
    point = hull.points["WL 2.5 x ST 7"]
    assert found[0].place == pytest.approx((point.x, point.y, point.z), abs=1e-6)
    assert "ST 15" not in {each.line for each in found}
    assert movements(drawing(hull), drawing(hull)) == ()


def test_before_and_after_shows_what_moved(pulled: tuple[Hull, Drawing]) -> None:
    """Moved sections are drawn grey and red, others once; the largest movement is named."""
    hull, before = pulled
    figure = before_after(before, hull, half_breadth=True)
    assert "body/before/ST 7" in ids(figure, "body/before/")
    assert "body/moved/ST 7" in ids(figure, "body/moved/")
    assert "body/before/ST 15" not in ids(figure, "body/before/")
    assert ids(figure, "arrow/") == ["arrow/largest"]
    assert "half-breadth/moved/WL 2.5" in ids(figure, "half-breadth/moved/")
    assert "20.0 mm\nST 7\nx 35.000 m\ny " in words(figure)


@pytest.mark.parametrize("paper", list(PAPERS))
@pytest.mark.parametrize("station", ["ST 3", "ST 16"])
def test_the_words_at_the_largest_movement_keep_within_the_frame(
    station: str, paper: PaperName, boxes_of: Boxes, fresh_series60_70: Hull
) -> None:
    """In the fore body and in the aft body, clear of the frame and of all other words."""
    hull = fresh_series60_70
    before = snapshot(hull)
    with hull.edit("pull") as edit:
        edit.pull(f"WL 0.5 x {station}", 0.05, (20.0, 4.0))
    sheet, boxes = PAPERS[paper], boxes_of(before_after(before, hull, paper=paper))
    (mine,) = (box for name, box in boxes.items() if name.startswith("label/largest"))
    edge = (MARGIN + 1.5) * sheet.factor
    assert (mine[:2] > edge).all()
    assert mine[2] < sheet.width - edge
    assert mine[3] < sheet.height - edge
    others = [box for name, box in boxes.items() if not name.startswith("label/largest")]
    assert not overlaps(mine, others)


def test_nothing_moved_is_drawn_without_an_arrow(wigley: Hull) -> None:
    """A hull beside itself: no grey, no red, and the block says so."""
    figure = before_after(snapshot(wigley), wigley)
    assert ids(figure, "body/before/") == ids(figure, "body/moved/") == ids(figure, "arrow/") == []
    assert words(figure).count("0 of 31 lines moved") == 1


def test_combs_have_a_tooth_per_place_and_state_their_scale(
    series60: Hull, lines_of: Lines
) -> None:
    """Each named line has teeth, tips and dots; teeth stand on the curve."""
    names = ["WL 0.5", "BTK 0.44", "ST 17"]
    figure = curvature_combs(series60, names, scale=0.05)
    for name in names:
        (teeth,), (course,) = lines_of(figure, f"teeth/{name}"), lines_of(figure, f"line/{name}")
        knots = teeth[0::24]  # the first of the eight teeth of each segment
        assert np.abs(knots[:, None] - course[None]).sum(axis=2).min(axis=1).max() < 1e-6
        assert len(lines_of(figure, f"inflections/{name}")) == 1
    assert words(figure).count("curvature 0.05 1/m, radius 20 m") == 3


def test_combs_of_what_has_none_are_refused(wigley: Hull) -> None:
    """No line, an unknown line, a scale of nil."""
    with pytest.raises(BadInputError, match="name a line"):
        curvature_combs(wigley, [])
    with pytest.raises(UnknownNameError):
        curvature_combs(wigley, ["WL 99"])
    with pytest.raises(BadInputError, match="scale"):
        curvature_combs(wigley, ["WL 2.5"], scale=0.0)


def test_the_neighbourhood_is_that_of_the_links(series60: Hull) -> None:
    """One node per neighbour, one edge per pair, and the numbers are those of the crossings."""
    pairs = {
        frozenset((link.tail.name, link.head.name)): link
        for link in drive_links(series60)
        if "WL 0.5" in (link.tail.name, link.head.name)
    }
    figure = neighbourhood(series60, "WL 0.5")
    assert len(ids(figure, "edge/")) == len(pairs)
    assert len(ids(figure, "node/")) == len(pairs) + 1
    crossings = [
        int(text.get_text())
        for text in figure.axes[0].texts
        if (text.get_gid() or "").startswith("count/")
    ]
    assert len(crossings) == len(pairs)
    assert min(crossings) >= 1


def test_nodes_do_not_cover_one_another(series60: Hull, lines_of: Lines) -> None:
    """The boxes of two hops are apart and on the sheet."""
    boxes = np.array(
        [
            np.concatenate([corners.min(axis=0), corners.max(axis=0)])
            for corners in lines_of(neighbourhood(series60, "BTK 0.44", hops=2), "node/")
        ]
    )
    for i, box in enumerate(boxes):
        apart = (boxes[:, :2] > box[2:]).any(axis=1) | (boxes[:, 2:] < box[:2]).any(axis=1)
        assert apart.sum() == len(boxes) - 1, i
    assert boxes.min() > 0.0
    assert (boxes[:, 2:] < [420.0, 297.0]).all()


def test_an_unknown_curve_has_no_neighbourhood(wigley: Hull) -> None:
    """The error names near ones."""
    with pytest.raises(UnknownNameError, match=r"WL 2\.5"):
        neighbourhood(wigley, "WL 2.55")
    with pytest.raises(BadInputError, match="hops"):
        neighbourhood(wigley, "WL 2.5", hops=0)


@pytest.mark.parametrize("suffix", ["pdf", "svg", "png"])
def test_other_pictures_have_the_same_bytes_twice(
    pulled: tuple[Hull, Drawing], tmp_path: Path, suffix: str
) -> None:
    """No picture holds dates or chance."""
    hull, before = pulled
    for run in ("first", "second"):
        before_after(before, hull, tmp_path / f"{run}-compare.{suffix}")
        curvature_combs(hull, ["WL 2.5"], tmp_path / f"{run}-combs.{suffix}")
        neighbourhood(hull, "WL 2.5", tmp_path / f"{run}-around.{suffix}")
    for name in ("compare", "combs", "around"):
        first, second = (tmp_path / f"{run}-{name}.{suffix}" for run in ("first", "second"))
        assert first.read_bytes() == second.read_bytes(), name
