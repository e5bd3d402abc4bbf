"""Files of arcs, read back: the drawing by ezdxf, the table as text."""

import csv
import io
import itertools
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.production_arcs import drawing_axes
from assoc_hull.errors import BadInputError, GeometryError, MissingExtraError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.hull import Hull
from assoc_hull.hull.results import ProductionArcs
from assoc_hull.io.dxf.lines import NAMES
from assoc_hull.io.export.arcs import arc_table

WITHIN = 0.0005


@pytest.fixture(scope="module")
def arcs(series60_70: Hull) -> ProductionArcs:
    """Some lines of all families, with knuckles, a flat and one with two curves."""
    names = ["ST 2", "ST 10", "ST 17", "WL 0.25", "WL 1", "boundary", "buttocks"]
    return series60_70.production_arcs(names, WITHIN)


@pytest.fixture(scope="module")
def drawing(arcs: ProductionArcs, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The drawing as ezdxf reads it."""
    ezdxf = pytest.importorskip("ezdxf")
    path = tmp_path_factory.mktemp("arcs") / "lines.dxf"
    arcs.save(path)
    return ezdxf.readfile(path)


def segments(polyline: Any) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Chords (n, 2), their beginnings, and turns (n,) from the file's own numbers."""
    rows = np.array([point[:2] for point in polyline.get_points("xyb")])
    bulge = np.array([point[2] for point in polyline.get_points("xyb")])[:-1]
    return rows[:-1], np.diff(rows, axis=0), 4.0 * np.arctan(bulge)


def places_of(polyline: Any, per: int = 40) -> FloatArray:
    """Places in space along a polyline, (n, 3), m, by its bulges."""
    begin, chord, turn = segments(polyline)
    part = np.linspace(0.0, 1.0, per)
    bend = 0.5 * turn[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        size = np.where(bend == 0.0, part, np.sin(bend * part) / np.sin(bend))
    angle = bend * (part - 1.0)
    x = begin[:, :1] + size * (np.cos(angle) * chord[:, :1] - np.sin(angle) * chord[:, 1:])
    y = begin[:, 1:] + size * (np.cos(angle) * chord[:, 1:] + np.sin(angle) * chord[:, :1])
    height = np.full(x.size, polyline.dxf.elevation)
    flat = np.column_stack([x.ravel(), y.ravel(), height])
    return np.array([tuple(each) for each in polyline.ocs().points_to_wcs(flat.tolist())])


def name_of(polyline: Any) -> str:
    """The name of the line, from the extended data."""
    return str(polyline.get_xdata(NAMES)[0].value)


def test_the_drawing_lies_on_the_lines_in_space(
    series60_70: Hull, arcs: ProductionArcs, drawing: Any
) -> None:
    """Every polyline within the tolerance of its curve, every point of the curve of it."""
    polylines = {name_of(each): each for each in drawing.modelspace()}
    assert list(polylines) == [line.name for line in arcs.lines]
    for name, polyline in polylines.items():
        found = series60_70.find(name)
        curve = found.curves[0] if isinstance(found, ah.Line) else found
        assert isinstance(curve, ah.Curve)
        places = places_of(polyline)
        assert closest_points(curve.spline, 0, places)[2].max() <= WITHIN
        own = curve.polyline(20)
        gap = np.sqrt(((own[:, None] - places) ** 2).sum(axis=2)).min(axis=1)
        step = np.sqrt((np.diff(places, axis=0) ** 2).sum(axis=1)).max()
        assert gap.max() <= math.hypot(WITHIN, 0.51 * step)


def test_segments_of_the_drawing_are_tangent(arcs: ProductionArcs, drawing: Any) -> None:
    """To 1e-9 rad by the numbers in the file, but for knuckles; joints are one vertex."""
    for polyline, line in zip(drawing.modelspace(), arcs.lines, strict=True):
        _, chord, turn = segments(polyline)
        assert len(chord) == len(line.arcs)
        course = np.arctan2(chord[:, 1], chord[:, 0])
        away = course[1:] - 0.5 * turn[1:] - course[:-1] - 0.5 * turn[:-1]
        away = np.abs(np.angle(np.exp(1j * away)))
        assert away[line.smooth[1:]].max(initial=0.0) < 1e-9
        assert away[~line.smooth[1:]].min(initial=1.0) > 1e-9
    assert sum(int((~line.smooth[1:]).sum()) for line in arcs.lines) > 0


def test_the_drawing_says_what_it_is(arcs: ProductionArcs, drawing: Any) -> None:
    """Metres, a layer per group, a polyline per curve."""
    assert drawing.header["$INSUNITS"] == 6
    layers = [each.dxf.layer for each in drawing.modelspace()]
    assert layers == [line.group for line in arcs.lines]
    assert {"sections", "waterlines", "boundary"} <= {each.dxf.name for each in drawing.layers}


def test_arcs_one_by_one_are_the_same_curves(arcs: ProductionArcs, tmp_path: Path) -> None:
    """An ARC or a LINE each, that meet in space to 1e-9 m and turn as the arcs do."""
    ezdxf = pytest.importorskip("ezdxf")
    arcs.save(tmp_path / "arcs.dxf", entities="arcs")
    drawn = list(ezdxf.readfile(tmp_path / "arcs.dxf").modelspace())
    assert len(drawn) == arcs.count
    for line in arcs.lines:
        begin = line.starts()
        end = line.in_space(line.arcs.ends())
        middle = line.in_space(line.arcs.at(np.arange(len(line.arcs)), 0.5 * line.arcs.length))
        for k in range(len(line.arcs)):
            each = drawn.pop(0)
            assert name_of(each) == line.name
            assert each.dxf.layer == line.group
            if each.dxftype() == "LINE":
                found = [tuple(each.dxf.start), tuple(each.dxf.end)]
                assert abs(line.arcs.curvature[k]) * line.arcs.length[k] < 1e-9
            else:
                found = [tuple(each.start_point), tuple(each.end_point)]
                half = each.dxf.start_angle + 0.5 * (
                    (each.dxf.end_angle - each.dxf.start_angle) % 360.0
                )
                top = next(iter(each.vertices([half])))
                assert np.abs(np.array(tuple(top)) - middle[k]).max() < 1e-9
                if line.arcs.curvature[k] < 0.0:
                    found.reverse()
            assert np.abs(np.array(found) - [begin[k], end[k]]).max() < 1e-9
    assert not drawn


def test_other_entities_are_refused(arcs: ProductionArcs, tmp_path: Path) -> None:
    """By name, and nothing is written."""
    with pytest.raises(BadInputError, match="entities"):
        arcs.save(tmp_path / "arcs.dxf", entities="splines")
    assert not (tmp_path / "arcs.dxf").exists()


def test_the_same_arcs_give_the_same_bytes(arcs: ProductionArcs, tmp_path: Path) -> None:
    """No times and no random numbers in either form."""
    pytest.importorskip("ezdxf")
    for ending in (".dxf", ".csv"):
        for name in ("a", "b"):
            arcs.save(tmp_path / (name + ending))
        assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes()


def test_the_table_gives_the_arcs_back(arcs: ProductionArcs) -> None:
    """From its rows every arc ends where the next begins, about its own centre, in its plane."""
    rows = list(csv.DictReader(io.StringIO(arc_table(arcs))))
    assert len(rows) == arcs.count
    place, along, normal, centre = (
        np.array([[float(row[p + axis] or "nan") for axis in "xyz"] for row in rows])
        for p in ("", "d", "n", "c")
    )
    bend, length = (
        np.array([float(row[name]) for row in rows]) for name in ("curvature", "length")
    )
    radius = np.array([float(row["radius"] or "inf") for row in rows])
    left = np.cross(normal, along)
    h = 0.5 * bend * length
    size = length * np.sinc(h / np.pi)
    end = place + size[:, None] * (np.cos(h)[:, None] * along + np.sin(h)[:, None] * left)
    same = np.array([a["line"] == b["line"] for a, b in itertools.pairwise(rows)])
    assert np.abs(end[:-1] - place[1:])[same].max() < 1e-11
    assert np.isnan(centre).any(axis=1).tolist() == (bend == 0.0).tolist()
    curved = (bend != 0.0) & (radius < 1e4)
    assert np.linalg.norm(place - centre, axis=1)[curved] == pytest.approx(radius[curved], 1e-9)
    assert [int(row["number"]) for row in rows if row["line"] == "WL 1"][:2] == [1, 2]


def test_axes_are_those_that_dxf_gives_a_plane() -> None:
    """Any normal; x runs to the right in planes along the ship, y in planes athwart."""
    ezdxf = pytest.importorskip("ezdxf")
    rng = np.random.default_rng(2)
    drawn = rng.normal(size=(50, 3))
    normals = [*np.eye(3), *-np.eye(3), *(drawn / np.linalg.norm(drawn, axis=1)[:, None])]
    for normal in normals:
        axes = drawing_axes(np.asarray(normal))
        ocs = ezdxf.math.OCS(tuple(axes[2]))
        assert abs(axes[2] @ normal) == pytest.approx(1.0)
        for given, wanted in zip(np.eye(3), axes, strict=True):
            assert np.array(tuple(ocs.to_wcs(tuple(given)))) == pytest.approx(wanted, abs=1e-12)
    assert drawing_axes(np.array([-1.0, 0.0, 0.0]))[:2].tolist() == [[0, 1, 0], [0, 0, 1]]


def test_a_space_curve_comes_as_two_views(shipped: Any) -> None:
    """A deck edge with sheer: plan and profile, each within the tolerance of its view."""
    hull = shipped("plain_ship")
    found = hull.production_arcs("deck edge", WITHIN)
    assert [line.name for line in found.lines] == ["deck edge (plan)", "deck edge (profile)"]
    assert [line.axes[2].tolist() for line in found.lines] == [[0, 0, 1], [0, -1, 0]]
    assert found.deviation <= WITHIN
    assert "deck edge is a space curve" in found.notes[0]
    own = hull.lines["deck edge"].curves[0].polyline(4)
    for line, axis in zip(found.lines, (2, 1), strict=True):
        begin = own[0].copy()
        begin[axis] = 0.0
        assert line.starts()[0] == pytest.approx(begin, abs=1e-12)


def test_a_line_too_sharp_is_left_out_or_refused_by_place(series60_70: Hull) -> None:
    """Asked for by name it is an error, among all lines a sentence in the result."""
    with pytest.raises(GeometryError, match=r"profile has a radius of .* m at \(.*, 0, .*\)") as e:
        series60_70.production_arcs("profile", WITHIN, 20.0)
    assert float(str(e.value.values["radius"])) < 20.0
    among = series60_70.production_arcs(None, 0.01, 20.0)
    assert any("profile has a radius" in each for each in among.left_out)
    assert among.least_radius >= 20.0
    assert "profile" not in [line.name for line in among.lines]


def test_no_ezdxf_no_drawing(
    arcs: ProductionArcs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The extra is named; tables need none."""
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[dxf\]"):
        arcs.save(tmp_path / "a.dxf")
    arcs.save(tmp_path / "a.csv")
    assert [each.name for each in tmp_path.iterdir()] == ["a.csv"]


@pytest.mark.parametrize("name", ["a.step", "a.hull", "dxf"])
def test_other_endings_are_refused(arcs: ProductionArcs, tmp_path: Path, name: str) -> None:
    """The two that are known are named."""
    with pytest.raises(BadInputError, match=r"end it in \.dxf or \.csv"):
        arcs.save(tmp_path / name)
