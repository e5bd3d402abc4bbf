"""The lines plan holds what a naval architect expects, where it is expected."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from assoc_hull.errors import BadInputError, MissingExtraError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.plot.lines_plan.drawing import Drawing, drawing
from assoc_hull.plot.lines_plan.plan import lines_plan
from assoc_hull.plot.lines_plan.three_views import lay_out_views
from assoc_hull.plot.sheet import sheet_figure as sheet
from assoc_hull.plot.sheet.paper import PAPERS

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]
Plan = Callable[..., Figure]

HULLS = pytest.mark.parametrize("name", ["wigley", "series60"])
EVERY = pytest.mark.parametrize("name", ["wigley", "series60", "bulk_carrier", "dtc"])


@pytest.fixture
def hull(name: str, request: pytest.FixtureRequest) -> Hull:
    """The hull of this name."""
    found: Hull = request.getfixturevalue(name)
    return found


@pytest.fixture(scope="module")
def drawn() -> dict[tuple[str, str], Figure]:
    """Plans that were drawn, by hull and paper."""
    return {}


@pytest.fixture
def plan(name: str, hull: Hull, drawn: dict[tuple[str, str], Figure]) -> Plan:
    """Give the plan of the hull on a paper; it is drawn once, and looked at by many tests."""

    def give(paper: str = "A3") -> Figure:
        if (name, paper) not in drawn:
            drawn[name, paper] = lines_plan(hull, paper=paper)  # type: ignore[arg-type]
        return drawn[name, paper]

    return give


def pieces(shown: Drawing, family: str) -> int:
    """How many curves the lines of a family have."""
    return sum(len(line.polylines) for line in shown.of(family))


@HULLS
def test_each_view_shows_each_of_its_lines_once(hull: Hull, plan: Plan, lines_of: Lines) -> None:
    """Buttocks in the profile, waterlines in plan, and midship on both halves of the body plan."""
    figure, shown = plan(), drawing(hull)
    middle = 0.5 * hull.particulars.length
    both = sum(abs(line.offset - middle) < 1e-6 for line in shown.of("sections"))
    assert len(lines_of(figure, "profile/buttocks/")) == pieces(shown, "buttocks")
    assert len(lines_of(figure, "profile/boundary/")) == pieces(shown, "boundary")
    assert len(lines_of(figure, "half-breadth/waterlines/")) == pieces(shown, "waterlines")
    assert len(lines_of(figure, "half-breadth/boundary/")) == pieces(shown, "boundary") - 1
    assert len(lines_of(figure, "body/sections/")) == pieces(shown, "sections") + both


@HULLS
def test_the_grid_shows_the_planes_of_the_other_families(
    hull: Hull, plan: Plan, lines_of: Lines
) -> None:
    """Stations and waterlines are straight in the profile, buttocks straight in plan."""
    figure, shown = plan(), drawing(hull)
    for view, family, axis in (
        ("profile", "sections", 0), ("profile", "waterlines", 1),
        ("half-breadth", "sections", 0), ("half-breadth", "buttocks", 1),
        ("body", "waterlines", 1), ("body", "buttocks", 0),
    ):  # fmt: skip
        for line in shown.of(family):
            found = lines_of(figure, f"{view}/grid/{line.name}")
            assert found, (view, line.name)
            assert all(np.ptp(points[:, axis]) == 0.0 for points in found)


@pytest.mark.parametrize("paper", ["A3", "A1", "A4"])
@EVERY
def test_no_label_covers_another_and_all_lie_within_the_frame(
    plan: Plan, paper: str, boxes_of: Boxes
) -> None:
    """The boxes around all words are apart, and inside the sheet."""
    found = boxes_of(plan(paper))
    boxes, names = np.array(list(found.values())), list(found)
    slack = 1e-6
    for i in range(len(boxes)):
        apart = (
            (boxes[:, 0] >= boxes[i, 2] - slack) | (boxes[:, 2] <= boxes[i, 0] + slack)
            | (boxes[:, 1] >= boxes[i, 3] - slack) | (boxes[:, 3] <= boxes[i, 1] + slack)
        )  # fmt: skip
        covered = [names[k] for k in np.flatnonzero(~apart).tolist() if k != i]
        assert covered == [], names[i]
    size = PAPERS[paper]
    inside = 8.0 * size.factor
    assert (boxes[:, :2] > inside).all()
    assert (boxes[:, 2:] < [size.width - inside, size.height - inside]).all()


@EVERY
def test_every_line_is_named_in_its_view(hull: Hull, plan: Plan, boxes_of: Boxes) -> None:
    """No waterline of the half-breadth plan, no section and no buttock is without a label."""
    names, shown = list(boxes_of(plan())), drawing(hull)

    def labelled(view: str, label: str) -> bool:
        return any(
            name.startswith(f"label/{view}/") and name.split("/", 3)[-1].split(" ")[-2] == label
            for name in names
        )

    for view, family in (
        ("half-breadth", "waterlines"), ("body", "sections"), ("profile", "buttocks"),
        ("body", "buttocks"), ("body", "waterlines"), ("profile", "sections"),
    ):  # fmt: skip
        missing = [line.name for line in shown.of(family) if not labelled(view, line.label)]
        assert missing == [], view


@HULLS
def test_waterlines_end_on_the_profile(hull: Hull) -> None:
    """As drawn, both ends lie within 1 mm (full scale) of the drawn profile."""
    shown = drawing(hull)
    profile = shown.profile
    assert profile is not None
    (course,) = profile.polylines
    start, along = course[:-1], np.diff(course, axis=0)
    for line in shown.of("waterlines"):
        for end in (line.polylines[0][0], line.polylines[-1][-1]):
            part = ((end - start) * along).sum(axis=1) / (along * along).sum(axis=1)
            foot = start + np.clip(part, 0.0, 1.0)[:, None] * along
            gap = np.sqrt(((end - foot) ** 2).sum(axis=1).min())
            assert gap < 1e-3, line.name


@HULLS
def test_the_bow_is_on_the_right_and_the_views_are_aligned(
    hull: Hull, plan: Plan, lines_of: Lines
) -> None:
    """x grows to the right, on one scale and at one place in profile and half-breadth plan."""
    shown = drawing(hull)
    layout, figure = lay_out_views(shown, PAPERS["A3"]), plan()
    assert layout.profile.denominator == layout.half.denominator
    for line in shown.of("sections"):
        (upper,) = lines_of(figure, f"profile/grid/{line.name}")[:1]
        (lower,) = lines_of(figure, f"half-breadth/grid/{line.name}")[:1]
        assert upper[0, 0] == lower[0, 0] == layout.profile.across(line.offset)
        assert upper[:, 1].min() > lower[:, 1].max()
    assert layout.profile.across(1.0) > layout.profile.across(0.0)


@HULLS
def test_the_aft_body_is_on_the_left(hull: Hull, plan: Plan, lines_of: Lines) -> None:
    """Sections abaft the middle lie left of the centre line, those before it right."""
    shown = drawing(hull)
    layout = lay_out_views(shown, PAPERS["A3"])
    figure, centre = plan(), layout.body.across(0.0)
    middle = 0.5 * hull.particulars.length
    for line in shown.of("sections"):
        found = lines_of(figure, f"body/sections/{line.name}$")
        sides = sorted(float(np.sign(points[:, 0].mean() - centre)) for points in found)
        if abs(line.offset - middle) < 1e-6:
            assert sides == [-1.0, 1.0]
        else:
            assert set(sides) == {1.0 if line.offset > middle else -1.0}


@pytest.mark.parametrize("suffix", ["pdf", "svg", "png"])
def test_a_file_has_the_same_bytes_twice(wigley: Hull, tmp_path: Path, suffix: str) -> None:
    """All three formats are written, and hold neither dates nor chance."""
    first, second = (tmp_path / f"{name}.{suffix}" for name in ("first", "second"))
    for path in (first, second):
        lines_plan(wigley, path)
    assert first.read_bytes() == second.read_bytes()
    assert first.stat().st_size > 10_000


def test_highlighted_lines_are_tinted(wigley: Hull) -> None:
    """Only the named lines have another colour."""
    figure = lines_plan(wigley, highlight=["WL 2.5"])
    colours = {
        line.get_gid(): line.get_color()
        for line in figure.axes[0].lines
        if (line.get_gid() or "").startswith("half-breadth/waterlines/")
    }
    assert colours.pop("half-breadth/waterlines/WL 2.5") != "black"
    assert set(colours.values()) == {"black"}


def test_wrong_names_are_refused(wigley: Hull, tmp_path: Path) -> None:
    """An unknown line, paper or ending is an error of the family, and nothing is written."""
    with pytest.raises(UnknownNameError, match=r"WL 2\.5"):
        lines_plan(wigley, highlight=["WL 2.55"])
    with pytest.raises(BadInputError, match="A3"):
        lines_plan(wigley, paper="A0")  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match=r"\.svg"):
        lines_plan(wigley, tmp_path / "plan.gif")
    with pytest.raises(BadInputError, match="another place"):
        lines_plan(wigley, tmp_path / "nowhere" / "plan.svg")
    assert list(tmp_path.iterdir()) == []


def test_without_matplotlib_the_extra_is_named(
    wigley: Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The error says what to install."""
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[plot\]"):
        sheet.Sheet("A3")


@pytest.mark.parametrize("paper", ["A3", "A4"])
def test_diagonals_are_named_counted_and_within_the_frame(
    paper: str, lines_of: Lines, boxes_of: Boxes
) -> None:
    """Each has its name at its outer end in the body plan, and on or below its true breadth."""
    hull = examples.wigley(stations=9, waterlines=5)
    places = [(6.0, 35.0), (4.0, 35.0), *((8.0, 35.0 + 2.0 * k) for k in range(5))]
    with hull.edit("diagonals") as edit:
        names = [edit.add_line("diagonals", place).name for place in places]
    figure = lines_plan(hull, paper=paper)  # type: ignore[arg-type]
    boxes, size = boxes_of(figure), PAPERS[paper]
    for line in names:
        for row in ("body/right", "half-breadth/diagonals"):
            assert any(name.startswith(f"label/{row}/{line} ") for name in boxes)
    assert any("7 diagonals" in name for name in boxes)
    corners = np.concatenate([box.reshape(2, 2) for box in boxes.values()])
    drawn = np.concatenate([corners, *lines_of(figure, "(half-breadth|body)/diagonals/")])
    inside = 8.0 * size.factor
    assert (drawn > inside).all()
    assert (drawn < [size.width - inside, size.height - inside]).all()
