"""Drawings of the lines of a hull: what stands in them, and what comes back."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BSpline
from scipy.spatial import cKDTree

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, PointKind
from assoc_hull.geometry.splines.control_polygon import control_polygon
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import positions
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.dxf.entities import RawSpline
from assoc_hull.io.dxf.lines import NAMES, lines_drawing
from assoc_hull.io.dxf.lines_plan import plan_drawing
from assoc_hull.io.lines.line_points import splines_of
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.reports import ExportBook
from assoc_hull.model.address import AddressBook
from tests.conftest import Shipped

ezdxf: Any = pytest.importorskip("ezdxf")

ROUNDED = 5e-10
"""Places of lines are rounded to a nanometre when lines are read."""


@pytest.fixture(scope="module")
def plan(series60_70: Hull) -> str:
    """The lines plan of a hull with curves in space, in metres."""
    return plan_drawing(series60_70.state, ExportBook(17))


def largest_miss(hull: Hull, found: HullSlices) -> tuple[float, set[str]]:
    """How far defining points of lines are from points that were read; lines that were not."""
    book, worst, missing = AddressBook(hull.state), 0.0, set()
    read = {line.name: line for line in (*found.lines, *found.boundaries)}
    for line in hull.state.live("lines").tolist():
        name = book.line_name(line)
        if name not in read:
            missing.add(name)
            continue
        tree = cKDTree(np.concatenate([piece.points for piece in read[name].pieces]))
        for spline in splines_of(hull.state, line):
            worst = max(worst, float(np.max(tree.query(spline.xyz)[0])))
    return worst, missing


def test_a_curve_of_the_net_is_a_b_spline() -> None:
    """The same curve, between its knots too; threefold knots at a knuckle, double at a tangent."""
    points = np.array([[0.0, 0, 0], [2, 1, 0], [9, 2, 1], [10, 2, 3], [10, 2.5, 6], [11, 3, 9]])
    kind = [0, 0, PointKind.KNUCKLE, 0, PointKind.TANGENT, 0]
    given = np.zeros((6, 3))
    given[4] = (0.0, 0.6, 0.8)
    spline = loft(CurveData.single(points, kind, given))
    polygon = control_polygon(spline)
    segment, part = np.repeat(np.arange(5), 7), np.tile(np.linspace(0.0, 1.0, 7), 5)
    at = spline.knot[segment] + part * np.diff(spline.knot)[segment]
    found = BSpline(polygon.knots, polygon.points, 3)(at)
    np.testing.assert_allclose(found, positions(spline, segment, part).T, atol=1e-14)
    many = [int((polygon.knots == knot).sum()) for knot in spline.knot]
    assert many == [4, 1, 3, 1, 2, 4]


@pytest.mark.parametrize("form", ["dxf", "dxf-plan"])
def test_what_was_drawn_is_read(bulk_carrier: Hull, tmp_path: Path, form: str) -> None:
    """All defining points of all lines come back, in mm too; borders of flats are told."""
    path = tmp_path / "lines.dxf"
    report = bulk_carrier.export(path, form, "mm")
    assert (report.lines, report.rounding, report.left_out) == (79, 0.0, ())
    found = read_lines(path)
    worst, missing = largest_miss(bulk_carrier, found)
    assert worst < ROUNDED
    assert missing == {"flat of bottom", "flat of side"}
    (note,) = found.report.suspicions
    assert (note.kind, note.amount) == ("lines", 2)
    assert "mm, as the form has it" in str(found.report)


def test_polylines_keep_half_a_millimetre(tmp_path: Path) -> None:
    """Straight lines between points of a drawing leave the curves by no more; points are read."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    report = hull.export(tmp_path / "lines.dxf", "dxf-polylines")
    assert 0.0 < report.chord <= 5e-4
    worst, missing = largest_miss(hull, read_lines(tmp_path / "lines.dxf"))
    assert (worst < ROUNDED, missing) == (True, set())


def test_a_drawing_becomes_a_net_again(tmp_path: Path) -> None:
    """The ship that a lines plan shows has the volume of the ship that was drawn."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    hull.export(tmp_path / "plan.dxf", "dxf-plan", "mm")
    again = ah.read(tmp_path / "plan.dxf", draught=6.25)
    assert again.check() == ()
    volumes = [each.hydrostatics(draught=6.25).volume for each in (hull, again)]
    assert volumes[1] == pytest.approx(volumes[0], rel=2e-4)


@pytest.mark.parametrize(("unit", "code", "scale"), [("m", 6, 1.0), ("mm", 4, 1e3)])
def test_splines_lie_in_their_places(unit: str, code: int, scale: float) -> None:
    """ezdxf finds the curves of the net, a layer per group, and the unit in the header."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    text = lines_drawing(hull.state, ExportBook(17, scale, unit))
    drawing = ezdxf.read(io.StringIO(text))
    assert drawing.header["$INSUNITS"] == code
    assert not drawing.audit().errors
    book, state = AddressBook(hull.state), hull.state
    expected = {
        book.line_name(line): splines_of(state, line)[0] for line in state.live("lines").tolist()
    }
    groups = {name: line.group.name for name, line in hull.lines.items()}
    for entity in drawing.modelspace():
        name = str(entity.get_xdata(NAMES)[0].value)
        assert entity.dxf.layer == groups[name]
        spline = expected.pop(name)
        curve = entity.construction_tool()
        places = np.array([list(each) for each in curve.points(spline.knot.tolist())])
        np.testing.assert_allclose(places, spline.xyz * scale, atol=1e-12 * scale)
    assert not expected


def test_the_views_lie_as_a_naval_architect_lays_them(plan: str, series60_70: Hull) -> None:
    """Profile above half-breadth plan on one scale, bow right; body plan: aft left, fore right."""
    drawing = ezdxf.read(io.StringIO(plan))
    extents: dict[str, list[np.ndarray[Any, Any]]] = {}
    for spline in drawing.modelspace().query("SPLINE"):
        view = spline.dxf.layer.rpartition(" ")[0]
        extents.setdefault(view, []).append(np.array(spline.control_points)[:, :2])
    reach = {view: np.concatenate(each) for view, each in extents.items()}
    profile, half = reach["profile"], reach["half-breadth"]
    aft, fore = reach["aft body"], reach["fore body"]
    ship = series60_70.particulars
    high = [each.max(axis=0) for each in (profile, half)]
    assert high[0][0] == pytest.approx(high[1][0])  # the stem: bow to the right
    assert high[0][0] > ship.length
    assert half[:, 1].max() < profile[:, 1].min() < profile[:, 1].max() < aft[:, 1].min()
    assert np.ptp(half[:, 1]) == pytest.approx(0.5 * ship.breadth, rel=1e-3)
    assert aft[:, 0].max() <= 0.5 * ship.length + 1e-9 <= fore[:, 0].min() + 2e-9


def test_a_lines_plan_is_read_moved_and_scaled(plan: str, series60_70: Hull) -> None:
    """What moves with the entities in a drawing program tells where the views lie."""
    drawing = ezdxf.read(io.StringIO(plan))
    for spline in drawing.modelspace().query("SPLINE"):
        spline.translate(500.0, -70.0, 0.0)
        spline.scale_uniform(0.5)
    out = io.StringIO()
    drawing.write(out)
    worst, missing = largest_miss(series60_70, read_lines(out.getvalue(), scale=2.0))
    assert worst < ROUNDED
    assert missing == {"flat of bottom", "flat of side"}


def test_a_curve_in_space_is_read_from_two_views(shipped: Shipped) -> None:
    """A deck edge with sheer comes back; without its half-breadth plan it is left out, and told."""
    ship = shipped("prelikon_ship")
    text = plan_drawing(ship.state, ExportBook(17))
    worst, missing = largest_miss(ship, read_lines(text))
    assert worst < ROUNDED
    assert "deck edge" not in missing
    drawing = ezdxf.read(io.StringIO(text))
    space = drawing.modelspace()
    for spline in space.query('SPLINE[layer=="half-breadth boundary"]'):
        space.delete_entity(spline)
    out = io.StringIO()
    drawing.write(out)
    found = read_lines(out.getvalue())
    assert "deck edge" not in [line.name for line in found.boundaries]
    told = {note.where for note in found.report.suspicions if note.kind == "views"}
    assert told == {"deck edge", "upper knuckle"}


def test_diagonals_are_drawn_and_told() -> None:
    """In true breadth below the centre line; a line of ours that is not read is named."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    with hull.edit("diagonal") as edit:
        edit.add_line("diagonals", (5.0, 30.0))
    text = plan_drawing(hull.state, ExportBook(17))
    space = ezdxf.read(io.StringIO(text)).modelspace()
    (spline,) = space.query('SPLINE[layer=="half-breadth diagonals"]')
    centre = next(
        each.dxf.start.y for each in space.query('LINE[layer=="axes"]') if each.dxf.linetype != ""
        and each.dxf.start.y == each.dxf.end.y and each.dxf.start.y < 0.0
    )  # fmt: skip
    (name,) = hull.groups["diagonals"].lines
    places = hull.lines[name].curves[0].polyline(50)
    reach = np.hypot(places[:, 1], places[:, 2] - 5.0).max()
    flat = np.array([list(each) for each in spline.construction_tool().approximate(400)])
    assert centre - flat[:, 1].min() == pytest.approx(reach, rel=1e-4)
    for drawn in (text, lines_drawing(hull.state, ExportBook(17))):
        (note,) = read_lines(drawn).report.suspicions
        assert (note.where, note.amount) == ("diagonals", 1)


def test_a_scale_changes_letters_and_no_line() -> None:
    """At 1:100 letters of 2.5 mm are 250 mm high in a drawing of full size."""
    hull, heights, profiles = ah.examples.wigley(stations=5, waterlines=4), [], []
    for scale in (100.0, 200.0):
        text = plan_drawing(hull.state, ExportBook(17), scale)
        space = ezdxf.read(io.StringIO(text)).modelspace()
        (title,) = (each for each in space.query("TEXT") if each.dxf.text == "PROFILE")
        heights.append(title.dxf.height)
        (spline,) = space.query('SPLINE[layer=="profile boundary"]')[:1]
        profiles.append(np.array(spline.control_points))
    assert heights == pytest.approx([1.4 * 0.25, 1.4 * 0.5])
    assert np.array_equal(profiles[0], profiles[1])


def test_one_hull_is_one_drawing(tmp_path: Path) -> None:
    """No times and no random numbers; letters beyond ASCII are written by their numbers."""
    hull = ah.examples.wigley(stations=5, waterlines=4)
    with hull.edit("name") as edit:
        edit.rename("WL 2.08333", "Ωmega\u00e9")
    texts = [lines_drawing(hull.state, ExportBook(17)) for _ in range(2)]
    assert texts[0] == texts[1]
    assert texts[0].isascii()
    assert read_lines(texts[0])["Ωmega\u00e9"].group == "waterlines"


def drawn_spline(**changes: str) -> str:
    """A drawing of one waterline, a parabola; each group of codes may be another."""
    parts = {
        "head": "70 8 71 2 72 6 73 3", "knots": "40 0 40 0 40 0 40 1 40 1 40 1",
        "points": "10 0 20 0 30 1 10 5 20 8 30 1 10 10 20 0 30 1", "weights": "",
    } | changes  # fmt: skip
    words = f"0 SECTION 2 ENTITIES 0 SPLINE 8 WL_1 {' '.join(parts.values())} 0 ENDSEC 0 EOF"
    return "\n".join(word.replace("_", " ") for word in words.split()) + "\n"


def test_a_foreign_spline_is_read_with_its_weights() -> None:
    """With weights 1, sqrt(1/2), 1 a quadratic is a quarter of a circle; else a parabola."""
    (piece,) = read_lines(drawn_spline())["WL 1"].pieces
    x, y = piece.points[:, 0], piece.points[:, 1]
    np.testing.assert_allclose(y, 16.0 * x / 10.0 * (1.0 - x / 10.0), atol=1e-12)
    half = float(np.sqrt(0.5))
    round_ = drawn_spline(
        points="10 0 20 4 30 1 10 4 20 4 30 1 10 4 20 0 30 1", weights=f"41 1 41 {half!r} 41 1"
    )
    (piece,) = read_lines(round_)["WL 1"].pieces
    np.testing.assert_allclose(np.hypot(*piece.points[:, :2].T), 4.0, rtol=1e-14)
    middle = 0.5 * (piece.points[1:] + piece.points[:-1])
    assert 4.0 - np.hypot(*middle[:, :2].T).min() < 2e-5


def test_a_threefold_knot_is_a_knuckle_where_the_direction_jumps() -> None:
    """A straight polygon with full knots has none, a bent one has."""
    knots = np.array([0.0, 0, 1, 2, 2])
    bent = RawSpline(1, knots, np.array([[0.0, 0, 0], [1, 1, 0], [2, 0, 0]]), "here")
    assert bent.knuckles().tolist() == [[1.0, 1.0, 0.0]]
    straight = RawSpline(1, knots, np.array([[0.0, 0, 0], [1, 1, 0], [2, 2, 0]]), "here")
    assert straight.knuckles().tolist() == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        pytest.param({"head": "71 0 73 3"}, "of degree 0", id="no degree"),
        pytest.param({"head": "71 3 73 3"}, "has 3 control points", id="too few points"),
        pytest.param({"knots": "40 0 40 0 40 1 40 1"}, "4 knots for 3 control", id="knots"),
        pytest.param({"knots": "40 0 40 0 40 0 40 0 40 0 40 0"}, "holds 0 6 times", id="no length"),
        pytest.param({"knots": "40 0 40 0 40 1 40 0 40 1 40 1"}, "falls from 1 to 0", id="falling"),
        pytest.param({"points": "10 0 20 0 10 5 20 8 10 9 20 0 30 1"}, "3, 3, 1", id="no height"),
        pytest.param({"weights": "41 1 41 0 41 1"}, "weight is not positive", id="weight"),
    ],
)
def test_a_broken_spline_is_refused(changes: dict[str, str], words: str) -> None:
    """One line says what is wrong, and where it stands."""
    with pytest.raises(BadInputError, match=words) as raised:
        read_lines(drawn_spline(**changes))
    assert "line 5 of text" in str(raised.value)


@pytest.mark.parametrize(
    ("code", "kind", "words"),
    [
        (1, "suspicions", "the header says in, as it does by default"),
        (5, "assumptions", "cm, as the form has it"),
    ],
)
def test_the_unit_of_a_header_is_believed_if_it_is_metric(code: int, kind: str, words: str) -> None:
    """Inches are what many programs begin with: these are told, and the size decides."""
    head = f"0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{code}\n0\nENDSEC\n"
    points = drawn_spline(points="10 0 20 0 30 1 10 500 20 80 30 1 10 550 20 0 30 1")
    report = read_lines(head + points).report
    assert words in str(getattr(report, kind))
    if kind == "suspicions":
        given = read_lines(head + points, unit="m")
        assert "m, as given; the header says in" in str(given.report.suspicions[0])
    else:
        with pytest.raises(BadInputError, match=r"says that its unit is 'cm'.*scale=100"):
            read_lines(head + points, unit="m")


def test_a_form_of_one_unit_takes_no_other(tmp_path: Path) -> None:
    """A table of offsets in mm is none that programs expect; no file is begun."""
    hull = ah.examples.wigley(stations=5, waterlines=4)
    with pytest.raises(BadInputError, match="csv has a unit of its own"):
        hull.export(tmp_path / "a.csv", unit="mm")
    with pytest.raises(BadInputError, match="'cm', in export; use m or mm"):
        hull.export(tmp_path / "a.dxf", unit="cm")
    assert list(tmp_path.iterdir()) == []
