"""Lines of a hull as curves of IGES: the very curves, out and in, and curves of other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, PointKind
from assoc_hull.geometry.splines.control_polygon import control_polygon
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.hull import Hull
from assoc_hull.io.cad.check_file import shape_in
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.iges.curves import curves_of_iges, holds_surfaces
from assoc_hull.io.iges.write import (
    IgesLayout,
    curve_values,
    iges_of_lines,
    iges_text,
    write_iges_lines,
)
from assoc_hull.io.lines.line_points import splines_of
from tests.conftest import Shipped
from tests.cut_hulls import three_blocks
from tests.iges_files import Entity, iges, matrix

ARCH = [[0.0, 0.0, 1.0], [2.0, 3.0, 1.0], [6.0, 3.0, 1.0], [9.0, 0.0, 1.0]]


def spline(points: list[list[float]] = ARCH, **more: object) -> Entity:
    """A Bezier curve, 126."""
    count = len(points)
    knots = [0.0] * count + [1.0] * count
    values = [count - 1, count - 1, 0, 0, 1, 0, *knots, *[1.0] * count]
    values += [*np.ravel(points).tolist(), 0.0, 1.0, 0.0, 0.0, 0.0]
    return Entity(126, values, **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def ship(shipped: Shipped) -> Hull:
    """A hull of 31 lines; its knuckles are below."""
    return shipped("wigley")


@pytest.mark.parametrize("unit", ["m", "mm"])
def test_curves_come_back_as_they_are(ship: Hull, unit: str) -> None:
    """All lines, each curve by the name of its line: ends and places between to 1e-12."""
    state = ship.state
    text, report = iges_of_lines(state, unit=unit)
    found, told, notes = curves_of_iges(text, "lines.igs")
    assert (told, notes, len(found)) == (unit, (), report.curves)
    size = max(float(np.abs(each.points).max()) for each in found)
    for line in state.live("lines").tolist():
        mine = [each for each in found if each.name == state.lines.name[line]]
        for curve, given in zip(mine, splines_of(state, line), strict=True):
            t = np.sort(np.append(np.linspace(0.0, given.knot[-1], 40), given.knot))
            assert curve.domain == (0.0, given.knot[-1])
            wanted = evaluate(given, np.zeros(len(t), np.int64), t)
            assert np.abs(curve.at(t) - wanted).max() <= 1e-12 * size


def test_a_knuckle_and_a_tangent_point_come_back() -> None:
    """At a knuckle the curve turns, at the end of a straight run its curvature jumps."""
    kind = np.array([0, PointKind.TANGENT, 0, PointKind.KNUCKLE, 0, 0], np.int8)
    places = [[0.0, 0, 0], [2, 0, 0], [4, 1, 0], [5, 3, 0], [5, 4, 1], [5, 5, 4]]
    along = np.tile([1.0, 0.0, 0.0], (6, 1))
    given = loft(CurveData.single(np.array(places), kind, along))
    curve, layout = control_polygon(given), IgesLayout()
    layout.add_named(126, curve_values(curve.knots, curve.points), "ST 1")
    (found,), _, _ = curves_of_iges(layout.text("A line", "m", 5.0), "line.igs")
    assert found.points.tobytes() == curve.points.tobytes()
    assert found.knots.tobytes() == curve.knots.tobytes()
    assert found.knuckles() == pytest.approx(np.array([[5.0, 3.0, 0.0]]))
    t = np.linspace(0.0, given.knot[-1], 200)
    assert found.at(t) == pytest.approx(evaluate(given, np.zeros(200, np.int64), t), abs=1e-14)


def test_a_file_is_the_same_again(ship: Hull, tmp_path: Path) -> None:
    """Written twice it has the same bytes, and what the report tells."""
    report = write_iges_lines(ship.state, tmp_path / "lines.igs")
    data = (tmp_path / "lines.igs").read_bytes()
    assert data == iges_of_lines(ship.state)[0].encode()
    found = curves_of_iges(data.decode(), "lines.igs")[0]
    assert report.size == len(data)
    assert (report.lines, report.curves) == (len({each.name for each in found}), len(found))
    assert report.points == sum(len(each.points) for each in found)


def test_opencascade_reads_the_same_curves(ship: Hull) -> None:
    """Of both sides: as many, with the same control points, from millimetres."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    text, report = iges_of_lines(ship.state, unit="mm", half=False, families=["sections"])
    found = curves_of_iges(text, "lines.igs")[0]
    assert report.curves == len(found) == 2 * len({each.name for each in found})
    for port, starboard in zip(found[::2], found[1::2], strict=True):
        assert np.array_equal(port.points * [1.0, -1.0, 1.0], starboard.points)
    walk = TopExp_Explorer(shape_in(text.encode(), "iges"), TopAbs_ShapeEnum.TopAbs_EDGE)
    for each in found:
        curve = BRep_Tool.Curve_s(TopoDS.Edge(walk.Current()), 0.0, 0.0)
        poles = [curve.Pole(i) for i in range(1, curve.NbPoles() + 1)]
        places = np.array([(pole.X(), pole.Y(), pole.Z()) for pole in poles])
        assert np.abs(1e-3 * places - each.points).max() < 1e-11
        walk.Next()
    assert not walk.More()


def test_lines_polylines_and_chains_are_read() -> None:
    """A chain gives its name to its curves; what is moved, moves; what bounds a surface is none."""
    shift = matrix(np.eye(3), [0.0, 0.0, 2.0])
    entities = [
        shift,
        Entity(102, [2, 5, 7], moved=1, label="WL 3"),
        spline(status="00010000"),
        Entity(110, [9.0, 0.0, 1.0, 9.0, 0.0, 4.0], status="00010000"),
        Entity(106, [2, 3, 0.0, 1.0, 2.0, 1.0, 1.0, 2.0, 4.0, 1.0, 3.0], form=12, label="ST 4"),
        Entity(106, [1, 2, 7.0, 0.0, 1.0, 5.0, 2.0], form=11),
        spline(status="00010500"),
        spline(status="01000000"),
        Entity(100, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]),
        Entity(102, [1, 21], status="01000000"),
        spline(status="00010000"),
    ]
    found, _, notes = curves_of_iges(iges(entities), "lines.igs")
    assert [each.name for each in found] == ["WL 3", "WL 3", "ST 4", "curve D11"]
    assert found[0].points.tolist() == [[x, y, z + 2.0] for x, y, z in ARCH]
    assert found[1].at(np.array([0.5])).tolist() == [[9.0, 0.0, 4.5]]
    assert found[2].polyline(1e-3).tolist() == [[0, 1, 2], [1, 1, 2], [4, 1, 3]]
    assert found[2].knuckles().tolist() == [[1, 1, 2]]
    assert found[3].points.tolist() == [[0, 1, 7], [5, 2, 7]]
    assert notes == (
        "Of lines.igs only curves are read; left out are 1 of type 100 (circular arc).",
        "2 curves are blanked in the file and left out.",
    )


def test_a_part_of_a_rational_spline_is_read() -> None:
    """Its bounds are within its knots, and its weights differ: a quarter of a circle, halved."""
    root = float(np.sqrt(0.5))
    values = [2, 2, 0, 0, 0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, root, 1.0]
    values += [1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0]
    (found,), _, _ = curves_of_iges(iges([Entity(126, values)]), "arc.igs")
    places = found.polyline(1e-4)
    assert np.linalg.norm(places, axis=1) == pytest.approx(np.ones(len(places)), abs=1e-15)
    assert places[-1] == pytest.approx([root, root, 0.0], abs=1e-15)
    middle = 0.5 * (places[1:] + places[:-1])
    assert 1.0 - np.linalg.norm(middle, axis=1).min() == pytest.approx(1e-4, rel=0.5)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        pytest.param(
            iges_text(three_blocks()), "no curve that can be read.*3 of type 128", id="128"
        ),
        pytest.param(iges([spline()], unit="3,"), "tells no unit of length", id="unit"),
        pytest.param(iges([Entity(106, [2, 1, 0, 0, 0], form=12)]), "has 1 points", id="a point"),
        pytest.param(iges([spline(ARCH[:1])]), "degree is 0", id="degree 0"),
        pytest.param(iges([spline([*ARCH, [1e300, 0, 0]])]), "lies 1e.300 m away", id="far away"),
    ],
)
def test_files_without_curves_are_refused(text: str, what: str) -> None:
    """In one line."""
    with pytest.raises(BadInputError, match=what):
        curves_of_iges(text, "lines.igs")


def test_surfaces_are_told_from_curves() -> None:
    """By the directory, without reading what they are made of."""
    assert holds_surfaces(iges_text(three_blocks()))
    assert not holds_surfaces(iges([spline()]))


@pytest.mark.parametrize(
    ("options", "what"),
    [
        pytest.param({"unit": "ft"}, "unit is 'ft'", id="unit"),
        pytest.param({"families": ["frames"]}, "family is 'frames'", id="family"),
        pytest.param({"families": ["diagonals"]}, "no lines of these families", id="none of it"),
        pytest.param({"half": 1}, "half is 1", id="half"),
    ],
)
def test_options_of_no_use_are_refused(ship: Hull, options: dict[str, Any], what: str) -> None:
    """Before anything is written."""
    with pytest.raises(BadInputError, match=what):
        iges_of_lines(ship.state, **options)


@pytest.mark.parametrize("unit", ["m", "mm"])
def test_lines_come_back_as_a_net(ship: Hull, tmp_path: Path, unit: str) -> None:
    """Read as digitised lines: the same ones, of the same size, once, whichever the unit."""
    path = tmp_path / "lines.igs"
    write_iges_lines(ship.state, path, unit=unit, half=unit == "m")
    found = read_lines(path)
    assert {line.name for line in found.lines} == {
        str(ship.state.lines.name[line])
        for line in ship.state.live("lines").tolist()
        if ship.state.family(line).name != "boundary"
    }
    assert found.high == pytest.approx([100.0, 5.0, 9.375], abs=1e-9)


def test_curves_beside_the_lines_are_told(tmp_path: Path) -> None:
    """Flats and diagonals are no lines, though they lie in planes, nor is a curve in space."""
    arch = np.array(ARCH)
    bent = arch + np.outer([0.0, 2.0, 1.0, 3.0], [0.0, 0.0, 1.0])
    knots, layout = np.array([0.0] * 4 + [1.0] * 4), IgesLayout()
    for name, points in (
        ("WL 1", arch), ("boundary: flat of side", arch), ("rail", bent), ("profile", bent),
    ):  # fmt: skip
        layout.add_named(126, curve_values(knots, points), name)
    (tmp_path / "lines.igs").write_text(layout.text("Lines", "m", 9.0))
    found = read_lines(tmp_path / "lines.igs")
    assert [line.name for line in (*found.lines, *found.boundaries)] == ["WL 1", "profile"]
    [told] = found.report.suspicions
    assert "rail: no section" in str(told)
    assert any("boundary: flat of side: left out" in str(e) for e in found.report.assumptions)


def test_flats_go_by_their_family(tmp_path: Path, bulk_carrier: Hull) -> None:
    """So that nobody takes the flat of side for a buttock."""
    names = {each.name for each in curves_of_iges(iges_of_lines(bulk_carrier.state)[0], "")[0]}
    assert {"profile", "boundary: flat of side", "boundary: flat of bottom"} < names
