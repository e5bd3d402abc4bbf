"""The public face: each method leads where it says."""

from pathlib import Path

import networkx
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit
from assoc_hull.errors import BadInputError, ForeignPointError, UnknownNameError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.wigley import wigley_half_breadth

POINT = "WL 2.5 x ST 7"


@pytest.fixture
def hull() -> ah.Hull:
    """A hull of its own."""
    return ah.examples.wigley()


def shift(edit: Edit, point: ah.Point, dy: float) -> None:
    """Move a point along y."""
    edit.move(point, y=point.y + dy)


def test_the_public_names_are_there() -> None:
    """Each name of the package is an object; examples stays the namespace after imports."""
    assert all(getattr(ah, name) is not None for name in ah.__all__)
    ah.examples.wigley()
    assert callable(ah.examples.series60)


def test_objects_are_read_by_name(hull: ah.Hull) -> None:
    """Mappings by name, read-only; the chain of the documentation works."""
    assert list(hull.groups) == ["boundary", "sections", "waterlines", "buttocks"]
    points = hull.groups["waterlines"].lines["WL 2.5"].curves[0].points
    assert hull.points[POINT] in points
    assert hull.find(POINT) == hull.points["WL 2.5 x ST 7"]
    assert hull.crossings[POINT].points[1] == hull.points[POINT]
    assert hull.lines["ST 7"] == hull.groups["sections"].lines["ST 7"]
    assert len(hull.points) == len(list(hull.points))
    assert hull.particulars.length == 100.0
    with pytest.raises(UnknownNameError):
        hull.points["WL 2.5 x ST 99"]
    with pytest.raises(BadInputError):
        hull.points["WL 2.5"]


def test_points_are_listed_from_one_book(hull: ah.Hull, monkeypatch: pytest.MonkeyPatch) -> None:
    """Values and items cost one look at the names, not one a point, and agree with look-ups."""
    made: list[AddressBook] = []
    real = AddressBook.__init__

    def counted(book: AddressBook, state: HullState) -> None:
        made.append(book)
        real(book, state)

    monkeypatch.setattr(AddressBook, "__init__", counted)
    items = dict(hull.points.items())
    assert list(items.values()) == list(hull.points.values())
    assert len(made) == 2
    assert list(items) == list(hull.points)
    assert all(hull.points[address] == point for address, point in list(items.items())[::37])
    assert POINT in hull.points
    assert "WL 2.5" not in hull.points
    number: object = 3
    assert number not in hull.points
    assert "" not in hull
    assert " " not in hull


def test_a_hull_is_built_of_lines() -> None:
    """By code, from arrays of points."""
    deck = [[0, 0, 4], [10, 2, 4], [20, 3, 4], [30, 2, 4], [40, 0, 4]]
    profile = [[0, 0, 4], [0, 0, 0], [40, 0, 0], [40, 0, 4]]
    lines = [
        ah.LineSource.make(
            "boundary", "deck edge", deck, plane=((0, 0, 1), 4.0), boundary=ah.BoundaryKind.END
        ),
        ah.LineSource.make(
            "boundary", "profile", profile, plane=((0, 1, 0), 0.0),
            boundary=ah.BoundaryKind.END, kind=[0, ah.PointKind.KNUCKLE, ah.PointKind.KNUCKLE, 0],
        ),
    ]  # fmt: skip
    lines += [
        ah.LineSource.make("sections", f"ST {x:g}", [[x, 0.0, 0], [x, 0.7 * y, 2.0], [x, y, 4]])
        for x, y in ((10.0, 2.0), (20.0, 3.0), (30.0, 2.0))
    ]
    ship = ah.Particulars("barge", 40.0, 6.0, 4.0, 3.0)
    links = [ah.Association("boundary", "sections")]
    hull = ah.Hull.from_lines(lines, particulars=ship, associations=links)
    assert hull.adoption is not None
    assert len(hull.adoption.lines) == 5
    assert hull.check() == ()
    assert repr(hull) == "<Hull barge, 5 lines, 0 edits>"


def test_an_edit_is_one_step_back_and_forth(hull: ah.Hull) -> None:
    """Undo and redo bring the fingerprints back."""
    before = hull.fingerprint
    with hull.edit("bulge") as edit:
        shift(edit, hull.points[POINT], 0.01)
    after = hull.fingerprint
    assert after != before
    assert [report.name for report in hull.history] == ["bulge"]
    hull.undo()
    assert (hull.fingerprint, len(hull.history), len(hull.undone)) == (before, 0, 1)
    hull.redo()
    assert (hull.fingerprint, len(hull.undone)) == (after, 0)
    assert hull.check() == ()
    assert hull.verify() == ()


def test_nested_edits_join(hull: ah.Hull) -> None:
    """One step, with the name of the outer one."""
    with hull.edit("outer") as outer:
        shift(outer, hull.points[POINT], 0.01)
        with hull.edit("inner") as inner:
            assert inner is outer
            shift(inner, hull.points["WL 2.5 x ST 15"], 0.01)
        assert hull.document.history == []
    assert [report.name for report in hull.history] == ["outer"]
    with hull.edit("next") as later:
        assert later is not outer


def test_a_preview_publishes_nothing(hull: ah.Hull) -> None:
    """The report is that of the edit, the hull as before."""
    before = hull.fingerprint
    report = hull.preview(lambda edit: shift(edit, hull.points[POINT], 0.01)).report
    assert report is not None
    assert len(report.relofted) == 2
    assert (hull.fingerprint, len(hull.history)) == (before, 0)
    report = hull.preview([{"op": "move", "point": POINT, "y": 2.95}]).report
    assert report is not None
    assert report.largest is not None
    assert (len(report.relofted), len(hull.history)) == (2, 0)
    with pytest.raises(BadInputError, match="modification 1"):
        hull.preview([{"op": "move", "punkt": POINT}])
    with pytest.raises(UnknownNameError):
        hull.preview([{"op": "explode", "point": POINT}])


def test_settings_are_checked(hull: ah.Hull) -> None:
    """Unknown words are answered with the known ones."""
    with pytest.raises(BadInputError, match="keep_going"):
        hull.edit("x", policy="hope")  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="report"):
        hull.edit("x", gaps="ignore")  # type: ignore[arg-type]


def test_why_takes_handles_and_addresses(hull: ah.Hull) -> None:
    """Of points, curves and lines of this hull."""
    with hull.edit("bulge") as edit:
        shift(edit, hull.points[POINT], 0.01)
    assert hull.why("ST 7").chain()[-1] == hull.points[POINT].id
    assert hull.why(hull.lines["ST 7"]).edit == "bulge"
    assert hull.why(hull.crossings[POINT]).what == "set by the edit"
    with pytest.raises(ForeignPointError):
        hull.why(ah.examples.wigley().points[POINT])


def test_graphs_are_given_with_filters(hull: ah.Hull) -> None:
    """As networkx graphs."""
    assert isinstance(hull.graph(), networkx.MultiDiGraph)
    assert len(hull.graph(around=hull.points[POINT], up=0, down=1)) == 4
    assert len(hull.dependencies()) == len(hull.lines)
    assert len(hull.dependencies(points=True)) > len(hull.lines)


@pytest.mark.parametrize(
    ("x", "z", "tolerance"),
    [
        pytest.param(35.0, 2.5, 1e-9, id="where a section and a waterline cross"),
        pytest.param(35.0, 2.0, 2e-3, id="on a section"),
        pytest.param(37.0, 2.5, 2e-3, id="on a waterline"),
        pytest.param(37.0, 2.0, 5e-3, id="between all lines"),
        pytest.param(37.0, 8.0, 5e-3, id="on the wall side"),
        pytest.param(0.0, 2.0, 1e-9, id="at the stern post"),
    ],
)
def test_half_breadths_anywhere(hull: ah.Hull, x: float, z: float, tolerance: float) -> None:
    """Those of the polynomial."""
    exact = float(wigley_half_breadth(np.array(x), np.array(z), 100.0, 10.0, 6.25))
    assert hull.half_breadth(x, z) == pytest.approx(exact, abs=tolerance)


@pytest.mark.parametrize(("x", "z"), [(101.0, 2.0), (50.0, 12.0), (-0.1, 2.0)])
def test_no_half_breadth_outside(hull: ah.Hull, x: float, z: float) -> None:
    """It is an error that says where to ask."""
    with pytest.raises(ah.errors.NoMeetingError, match="below the deck"):
        hull.half_breadth(x, z)


def test_a_saved_hull_opens_as_it_was(hull: ah.Hull, tmp_path: Path) -> None:
    """By name, and by content whatever the name."""
    path = tmp_path / "ship.hull.json"
    hull.save(path)
    assert ah.open(path).fingerprint == hull.fingerprint
    other = path.rename(tmp_path / "ship.txt")
    assert ah.read(other).fingerprint == hull.fingerprint
    with pytest.raises(BadInputError, match=r"\.hull\.json"):
        hull.save(tmp_path / "ship.csv")


def test_a_table_of_offsets_is_read(data_folder: Path) -> None:
    """The Series 60 table becomes a sound net."""
    table = data_folder / "series60" / "s60_cb070_offsets.csv"
    hull = ah.read(table, length=121.92, breadth=17.42, draught=6.97)
    assert hull.adoption is not None
    assert len(hull.groups["sections"].lines) > 10
    assert [each for each in hull.check() if each.kind != "gap"] == []
