"""Pictures that fairing is judged by: heat of battens, a stretch drawn larger, large movements."""

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.plot import combs_plan
from assoc_hull.plot.lines_plan.comparison import comparison_plan
from assoc_hull.plot.lines_plan.drawing import drawing, zoomed
from assoc_hull.plot.lines_plan.three_views import lay_out_views
from assoc_hull.plot.sheet.labels import overlaps
from assoc_hull.plot.sheet.paper import MARGIN, PAPERS
from tests import meshes

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]

STERN = (-6.0, 50.0)


@pytest.fixture
def dented() -> Hull:
    """A Wigley hull with a point that is 5 mm out."""
    hull = examples.wigley()
    with hull.edit("push a point") as edit:
        edit.move("WL 2.5 x ST 7", y=hull.points["WL 2.5 x ST 7"].y + 0.005)
    return hull


def across_normal(place: FloatArray) -> float:
    """How much the normal of a Wigley hull rises, over its length in a waterline's plane."""
    x, z = place[[0]], place[[2]]
    along, up = (
        (meshes.wigley_y(x + dx, z + dz) - meshes.wigley_y(x - dx, z - dz)) / 2e-4
        for dx, dz in ((1e-4, 0.0), (0.0, 1e-4))
    )
    return float((up / np.hypot(1.0, along))[0])


def nearest(lines: list[FloatArray], place: FloatArray) -> float:
    """How near polylines of a picture come to a place, mm."""
    every = np.concatenate([np.full((1, 2), np.inf), *lines])
    every = every[np.isfinite(every).all(axis=1)]
    return float(np.min(np.hypot(*(every - place).T), initial=np.inf))


def test_a_dent_is_the_hottest_place_and_a_fair_hull_is_cold(
    wigley: Hull, dented: Hull, lines_of: Lines
) -> None:
    """13 times the usual is the last class; on the hull as it is nothing comes near to 3."""
    figure = dented.plot.lines_plan(heat="ratio")
    view = lay_out_views(drawing(dented), PAPERS["A3"]).half
    place = view.on_paper(dented.points["WL 2.5 x ST 7"].position[None])[0]
    assert nearest(lines_of(figure, "heat 5/half-breadth/WL 2.5$"), place) < 0.01
    cold = wigley.plot.lines_plan(heat="ratio")
    assert lines_of(cold, "heat 0/")
    assert not any(lines_of(cold, f"heat {k}/") for k in (2, 3, 4, 5))


def test_residuals_are_coloured_by_their_size_in_millimetres(dented: Hull, lines_of: Lines) -> None:
    """3.8 mm lies between 3 and 10, the fourth class; the legend tells the limits."""
    figure = dented.plot.combs(heat="residual")
    view = lay_out_views(drawing(dented), PAPERS["A3"]).half
    place = view.on_paper(dented.points["WL 2.5 x ST 7"].position[None])[0]
    assert nearest(lines_of(figure, "heat 3/half-breadth/WL 2.5$"), place) < 0.01
    words = [text.get_text() for text in figure.axes[0].texts]
    assert "Batten residual (how far it springs off), mm" in words
    assert {"0.3", "1", "3", "10", "30"} <= set(words)


def test_classes_are_smaller_on_a_boat(lines_of: Lines) -> None:
    """What is 1 mm on a ship of 100 m is .1 mm on one of 10 m."""
    boat = examples.wigley(length=10.0, breadth=1.0, draught=0.625)
    words = [text.get_text() for text in boat.plot.lines_plan(heat="residual").axes[0].texts]
    assert {"0.03", "0.1", "0.3", "1", "3"} <= set(words)


def test_only_the_stretch_is_drawn_and_larger(bulk_carrier: Hull, lines_of: Lines) -> None:
    """No line leaves the stretch, no section outside it is there; boundaries are cut off too."""
    figure, whole = bulk_carrier.plot.lines_plan(x=STERN), drawing(bulk_carrier)
    part = lay_out_views(zoomed(whole, STERN), PAPERS["A3"])
    assert part.profile.denominator < 0.6 * lay_out_views(whole, PAPERS["A3"]).profile.denominator
    for view in (part.profile, part.half):
        edges = [view.across(each) for each in STERN]
        for family in ("boundary", "buttocks", "waterlines"):
            for points in lines_of(figure, f"{view.name}/{family}/"):
                assert edges[0] - 1e-9 <= points[:, 0].min()
                assert points[:, 0].max() <= edges[1] + 1e-9
    assert lines_of(figure, "body/sections/ST 2$")
    assert not lines_of(figure, "body/sections/ST 10$")


def test_a_buttock_that_a_stretch_cuts_off_is_named_once(
    bulk_carrier: Hull, boxes_of: Boxes
) -> None:
    """At its end on the deck; where the stretch has no other end of it, at the cut."""
    names = list(boxes_of(bulk_carrier.plot.lines_plan(x=(-5.5, 20.0))))
    found = [key.split("label/profile/buttocks/")[1] for key in names if "profile/butt" in key]
    assert len([each for each in found if each.split(" ")[0] == "18.5"]) == 1
    assert len([each for each in found if each.split(" ")[0] == "21"]) == 1


@pytest.mark.parametrize("picture", ["lines_plan", "combs"])
@pytest.mark.parametrize("name", ["bulk_carrier", "series60"])
def test_labels_of_a_stretch_lie_apart_and_within_the_frame(
    picture: str, name: str, request: pytest.FixtureRequest, boxes_of: Boxes
) -> None:
    """Names of lines and stations, words of the block, the legend of the colours."""
    hull = request.getfixturevalue(name)
    boxes = boxes_of(getattr(hull.plot, picture)(x=STERN, heat="residual"))
    found = list(boxes.values())
    edge = MARGIN
    for i, box in enumerate(found):
        assert (box[:2] >= edge).all()
        assert (box[2:] <= np.array([420.0, 297.0]) - edge).all()
        level = [other for k, other in enumerate(found) if k > i]
        clear = [each for each in level if overlaps(box, [each], -0.25)]
        # labels on slanting lines have boxes that are larger than their letters
        names = [key for key in boxes if any(boxes[key] is each for each in clear)]
        assert all("half-breadth/" in key or "body/on" in key for key in names), names


def test_combs_name_stations_along_a_line(bulk_carrier: Hull, boxes_of: Boxes) -> None:
    """Those between its ends; a section has none."""
    figure = bulk_carrier.plot.curvature_combs(["WL 9", "ST 2"], x=STERN)
    names = {key.rsplit(" ", 1)[0] for key in boxes_of(figure)}
    assert {f"label/WL 9/stations/{each}" for each in ("1", "2", "3")} <= names
    assert not any(name.startswith("label/ST 2/stations") for name in names)
    assert "label/WL 9/stations/4" not in names


@pytest.mark.parametrize(("amount", "way"), [(0.02, "out"), (-0.02, "in")])
def test_movements_are_drawn_so_many_times_as_large(
    amount: float, way: str, lines_of: Lines
) -> None:
    """A pull by 20 mm, 50 times: its tooth is that long along the hull's normal, as it is seen."""
    hull = examples.wigley()
    before = hull.plot.snapshot()
    with hull.edit("pull") as edit:
        edit.pull("WL 2.5 x ST 7", amount)
    figure = comparison_plan(before, hull, exaggerate=50)
    scale = lay_out_views(drawing(hull), PAPERS["A3"]).half.denominator
    (teeth,) = lines_of(figure, f"half-breadth/{way}/teeth/WL 2.5$")
    size = np.hypot(*(teeth[1::3] - teeth[0::3]).T).max()
    seen = 1.0 / np.hypot(1.0, across_normal(hull.points["WL 2.5 x ST 7"].position))
    assert size == pytest.approx(20.0 * 50.0 * seen / scale, rel=0.01)
    words = [text.get_text() for text in figure.axes[0].texts]
    assert any(f"50 times: 1 mm on paper for {scale / 50.0:.3g} mm" in each for each in words)
    assert not lines_of(figure, "half-breadth/moved/"), "in place of the two lines"
    body = hull.plot.before_after(before, exaggerate=50, x=(20.0, 60.0), half_breadth=True)
    assert lines_of(body, f"body/{way}/ST 7$")
    assert not lines_of(body, "body/sections/ST 1$")


def test_what_cannot_be_drawn_is_refused(wigley: Hull) -> None:
    """A snapshot has no heat; a stretch is two stations on the hull; a factor is above 0."""
    kept = wigley.plot.snapshot()
    with pytest.raises(BadInputError, match=r"x is \(50.0, 10.0\), in a picture; give"):
        wigley.plot.lines_plan(x=(50.0, 10.0))
    with pytest.raises(BadInputError, match=r"between x = 200 and 300 m.*0\.00 and 100\.00 m"):
        wigley.plot.combs(x=(200.0, 300.0))
    with pytest.raises(BadInputError, match=r"ST 7 lies between x = 35\.00"):
        wigley.plot.curvature_combs(["ST 7"], x=(0.0, 20.0))
    with pytest.raises(BadInputError, match="exaggerate"):
        wigley.plot.before_after(kept, exaggerate=0.0)
    with pytest.raises(BadInputError, match="heat"):
        wigley.plot.lines_plan(heat="colour")  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="give the hull"):
        combs_plan(kept, heat="ratio")
