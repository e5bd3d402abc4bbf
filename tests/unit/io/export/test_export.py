"""Each form: written, read back, compared, for three hulls; and what a form cannot hold is told."""

import inspect
import json
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.export.sections import sections_to_export
from assoc_hull.io.export.write import FORMS
from assoc_hull.io.lines.line_points import CHORD, LinePolylines, lines_as_points
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import ExportBook, ExportReport
from assoc_hull.model.tables import Particulars

SECTIONS = ("britfair", "delftship", "gf")
LINES = (*SECTIONS, "delftship-offsets")
TABLES = ("csv", "xlsx")
HULLS = ("wigley", "series60_70", "bulk_carrier")
LinesOf = Callable[[Hull, str], tuple[ExportReport, HullSlices]]
TableOf = Callable[[Hull, str], tuple[OffsetTable, ExportReport]]


@pytest.fixture(scope="session")
def wigley() -> Hull:
    """The Wigley hull of the examples."""
    return examples.wigley()


@pytest.fixture(params=HULLS)
def hull(request: pytest.FixtureRequest) -> Hull:
    """Each of the three hulls."""
    found: Hull = request.getfixturevalue(request.param)
    return found


def written_lines(hull: Hull, form: str) -> list[LinePolylines]:
    """The lines of a hull that a form holds, as points before rounding."""
    if form in SECTIONS:
        return sections_to_export(hull.state, ExportBook(decimals=9))
    return lines_as_points(hull.state, ("sections", "waterlines", "buttocks"))


def largest_difference(wanted: list[LinePolylines], found: HullSlices) -> float:
    """The largest difference of any coordinate of any point, m; lines and pieces must agree."""
    worst = 0.0
    for line in wanted:
        [same] = [each for each in found.group(line.group) if abs(each.offset - line.offset) < 1e-3]
        assert [len(piece.points) for piece in same.pieces] == [
            len(piece.points) for piece in line.pieces
        ], line.name
        for one, other in zip(line.pieces, same.pieces, strict=True):
            worst = max(worst, float(np.abs(one.points - other.points).max()))
    return worst


@pytest.fixture(scope="module")
def lines_of(
    tmp_path_factory: pytest.TempPathFactory,
) -> LinesOf:
    """What an export said, and what is read of its file; each made once."""
    folder = tmp_path_factory.mktemp("lines")

    @cache
    def go(hull: Hull, form: str) -> tuple[ExportReport, HullSlices]:
        report = hull.export(folder / "lines.dat", form)
        return report, read_lines(folder / "lines.dat")

    return go


@pytest.mark.parametrize("form", LINES)
def test_points_come_back_within_the_rounding(hull: Hull, form: str, lines_of: LinesOf) -> None:
    """Every point of every curve comes back within half a digit, and each curve as one piece."""
    report, found = lines_of(hull, form)
    wanted = written_lines(hull, form)
    assert len(found.lines) == len(wanted)
    worst = largest_difference(wanted, found)
    print(f"\n{hull.particulars.name} {form}: {report.points} points, {1e3 * worst:.4f} mm")
    assert worst <= report.rounding * (1.0 + 1e-6)
    assert report.largest <= report.rounding * (1.0 + 1e-6)
    assert report.rounding <= 5.01e-5
    assert report.chord <= CHORD


@pytest.mark.parametrize("form", LINES)
def test_points_lie_on_the_curves(hull: Hull, form: str, lines_of: LinesOf) -> None:
    """What is read lies on the hull's own curves within the rounding of both coordinates."""
    report, found = lines_of(hull, form)
    limit = np.sqrt(2.0) * report.rounding * (1.0 + 1e-6)
    for line in hull.groups["sections"].lines.values():
        position = line.position
        assert position is not None
        [same] = [each for each in found.group("sections") if abs(each.offset - position) < 1e-3]
        for piece in same.pieces:
            places = piece.points.copy()
            places[:, 0] = position
            off = np.min([closest_points(c.spline, 0, places)[2]
                          for c in line.curves], axis=0)  # fmt: skip
            assert off.max() <= limit, line.name


@pytest.fixture(scope="module")
def table_of(tmp_path_factory: pytest.TempPathFactory) -> TableOf:
    """The table of a hull as it is read back, and what the export said; each made once."""
    folder = tmp_path_factory.mktemp("tables")

    @cache
    def go(hull: Hull, form: str) -> tuple[OffsetTable, ExportReport]:
        report = hull.export(folder / f"offsets.{form}")
        return read_offsets(folder / f"offsets.{form}")[0], report

    return go


def positions(hull: Hull, group: str) -> list[float]:
    """The places of the lines of a group to a nanometre, m."""
    return [round(each.position or 0.0, 9) for each in hull.groups[group].lines.values()]


def own_offsets(hull: Hull, x: float, heights: list[float]) -> list[float]:
    """The half-breadths of the section at x, m; nan where there is none."""
    for line in hull.groups["sections"].lines.values():
        if abs((line.position or 0.0) - x) < 1e-8:
            every = [line.meet(((0.0, 0.0, 1.0), z)) for z in heights]
            return [float(met[:, 1].max()) if len(met) else float("nan") for met in every]
    return [float("nan")] * len(heights)


@pytest.mark.parametrize("form", TABLES)
def test_offsets_come_back_within_the_rounding(hull: Hull, form: str, table_of: TableOf) -> None:
    """Places come back to a nanometre, half-breadths and heights within half a digit."""
    table, report = table_of(hull, form)
    for group, places in (("sections", table.x), ("waterlines", table.z)):
        assert set(positions(hull, group)) <= set(places.tolist())
    assert report.rounding == pytest.approx(5e-5)
    assert (table.rounding == 5e-5).all()
    assert (table.length, table.draught) == (hull.particulars.length, hull.particulars.draught)
    some = slice(None, None, 3 if form == "xlsx" else 1)
    x, z = table.x.tolist()[some], table.z.tolist()
    wanted = np.array([own_offsets(hull, one, z) for one in x])
    known = np.isfinite(wanted)
    off = np.abs(wanted - table.half_breadth[some])[known]
    assert known.sum() > 0.6 * known.size
    assert off.max() <= 5e-5 * (1.0 + 1e-6)
    _compare_buttocks(hull, table)
    print(f"\n{hull.particulars.name} {form}: {known.sum()} cells, {1e3 * off.max():.4f} mm")


def _compare_buttocks(hull: Hull, table: OffsetTable) -> None:
    """The heights are the lowest where a section passes a buttock."""
    assert table.buttock_y.tolist() == positions(hull, "buttocks")
    if table.buttock_height is None:
        return
    for line in hull.groups["sections"].lines.values():
        row = table.buttock_height[int(np.abs(table.x - (line.position or 0.0)).argmin())]
        for y, height in zip(table.buttock_y.tolist(), row.tolist(), strict=True):
            met = line.meet(((0.0, 1.0, 0.0), y))
            if len(met):
                assert abs(met[:, 2].min() - height) <= 5e-5 * (1.0 + 1e-6)


def test_workbook_and_text_hold_the_same(hull: Hull, table_of: TableOf) -> None:
    """The XLSX and the CSV of a hull read back as the same table."""
    one, other = (table_of(hull, form)[0] for form in TABLES)
    for name in ("x", "z", "half_breadth", "buttock_y", "rounding", "station"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    assert (one.length, one.breadth, one.draught) == (other.length, other.breadth, other.draught)


@pytest.mark.parametrize("form", FORMS)
def test_the_same_hull_gives_the_same_bytes(wigley: Hull, form: str, tmp_path: Path) -> None:
    """Two exports of one hull are the same file, to the byte; of Rhino, the same hull in it."""
    for name in ("a", "b"):
        wigley.export(tmp_path / name, form)
    one, other = tmp_path / "a", tmp_path / "b"
    if form == "3dm":  # openNURBS puts in the time, chance ids and checksums over them
        assert one.stat().st_size == other.stat().st_size
        texts = [tmp_path / f"{each.name}.hull.json" for each in (one, other)]
        for path, text in zip((one, other), texts, strict=True):
            ah.read(path).save(text)
        one, other = texts
    assert one.read_bytes() == other.read_bytes()


@pytest.mark.parametrize(
    ("name", "form"),
    [
        ("a.csv", "csv"), ("a.xlsx", "xlsx"), ("a.BRI", "britfair"), ("a.txt", "delftship"),
        ("a.gf", "gf"), ("a.hull.json", "hull"),
    ],
)  # fmt: skip
def test_the_ending_tells_the_form_and_the_content_tells_it_back(
    name: str, form: str, tmp_path: Path
) -> None:
    """A name chooses the form; `read` finds it by content, under any name, and it is sound."""
    assert examples.wigley(stations=7, waterlines=5).export(tmp_path / name).form == form
    (tmp_path / name).rename(tmp_path / "hull.dat")
    hull = ah.read(tmp_path / "hull.dat")
    assert len(hull.groups["sections"].lines) == 5
    assert hull.check() == ()
    assert hull.verify() == ()


@cache
def read_back(name: str, form: str, folder: Path) -> Hull:
    """A small hull of a name, written without an ending and read by its content."""
    with pytest.MonkeyPatch.context() as patch:
        module = sys.modules["assoc_hull.shipped.wigley"]
        patch.setattr(module, "Particulars", lambda _, *sizes: Particulars(name, *sizes))
        # Not a twin of one that was made under another name.
        ship = Hull(inspect.unwrap(module.wigley)(stations=5, waterlines=5))
    assert ship.particulars.name == name
    path = folder / form
    ship.export(path, form)
    return ah.read(path) if form in TABLES else ah.read(path, draught=6.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for what is written once."""
    return tmp_path_factory.mktemp("plain")


@pytest.mark.parametrize("name", ["1234", "12 34.5", "Station 3", "T = 2", "unit: ft", "=1+1"])
@pytest.mark.parametrize("form", [*TABLES, "britfair", "gf"])
def test_a_ship_may_be_called_anything(form: str, name: str, tmp_path: Path, folder: Path) -> None:
    """A yard number, or words the reader looks for: the name says nothing of the numbers."""
    one, other = read_back("plain", form, folder), read_back(name, form, tmp_path)
    sizes = [attrs.astuple(each.particulars)[1:] for each in (one, other)]
    assert sizes[0] == sizes[1]
    assert [list(each.groups["sections"].lines) for each in (one, other)] == [
        list(one.groups["sections"].lines)
    ] * 2


def test_a_table_that_no_rule_completes_is_adopted_as_it_stands(
    bulk_carrier: Hull, tmp_path: Path
) -> None:
    """The carrier, with bulb and bossing, comes back with its lines, if taken with its faults."""
    bulk_carrier.export(tmp_path / "t.csv")
    hull = ah.read(tmp_path / "t.csv", accept=True)
    assert hull.adoption is not None
    # Of bulb and bossing a table tells too little: the verdict names the places, and would refuse.
    assert any(note.startswith("verdict: not sound") for note in hull.adoption.notes)
    assert any("off its source: ST 1.5" in note for note in hull.adoption.notes)
    # The table holds heights of the keel, so there is a profile.
    assert any(note.startswith("flats are left open") for note in hull.adoption.notes)
    assert hull.check() == ()
    every = [row for line in hull.groups["sections"].lines.values() for row in line.curves]
    off = []
    for curve in every:
        x = float(curve.ends[0, 0])
        same = [
            each for each in bulk_carrier.groups["sections"].lines.values()
            if each.position is not None and abs(each.position - x) < 1e-6
        ]  # fmt: skip
        if same:
            places = curve.polyline(4)
            off.append(
                np.min([closest_points(c.spline, 0, places)[2] for c in same[0].curves], axis=0)
            )
    away: FloatArray = np.concatenate(off)
    print(f"\np95 {1e3 * np.percentile(away, 95):.1f} mm, largest {1e3 * away.max():.1f} mm")
    assert np.percentile(away, 95) < 0.02
    assert away.max() < 0.1


def kinds(notes: tuple[object, ...]) -> set[str]:
    """The kinds of notes."""
    return {str(note).partition(":")[0] for note in notes}


def test_what_a_form_cannot_hold_is_told(bulk_carrier: Hull, tmp_path: Path) -> None:
    """Lines, borders, ends, given directions, joined curves and mended names are in the report."""
    for form in SECTIONS:
        report = bulk_carrier.export(tmp_path / "a", form)
        assert {"lines", "boundary", "end", "tangents"} <= kinds(report.left_out), form
        assert {"boundary", "several curves"} <= kinds(report.mended), form
        assert (report.lines, report.curves) == (42, 47)
    britfair = bulk_carrier.export(tmp_path / "a", "britfair")
    assert any("'Bulkca'" in str(note) for note in britfair.mended)
    table = bulk_carrier.export(tmp_path / "a", "csv")
    assert {"heights", "boundary"} <= kinds(table.left_out)
    every = bulk_carrier.export(tmp_path / "a", "delftship-offsets")
    assert kinds(every.left_out) == set()
    assert "boundary" in kinds(every.mended)


def test_a_list_of_all_lines_gives_boundary_curves_back(bulk_carrier: Hull, tmp_path: Path) -> None:
    """Profile, edge of the deck and transom are known again by how they lie; others are told."""
    bulk_carrier.export(tmp_path / "a.txt", "delftship-offsets")
    found = read_lines(tmp_path / "a.txt")
    assert {line.name for line in found.boundaries} == {"profile", "deck edge", "transom"}
    assert "curve" in found.report.kinds()
    assert len(found.knuckles["profile"]) == 2


def test_knuckles_are_marked_and_come_back(tmp_path: Path) -> None:
    """A chine is a knuckle in BRITFAIR and in the list of lines, and one again when it is read."""
    text = "line,x,y,z\n" + "".join(
        f"ST {x},{x},{y},{z}\n" for x in (10, 20, 30) for y, z in _chine(x)
    )
    (tmp_path / "chine.csv").write_text(text)
    chine = ah.read(tmp_path / "chine.csv")
    assert _knuckles(chine) == 3
    for form in ("britfair", "delftship-offsets"):
        chine.export(tmp_path / "a", form)
        content = (tmp_path / "a").read_text()
        assert content.count("-999.0" if form == "britfair" else "KNUCKLE") == 3
        assert _knuckles(ah.read(tmp_path / "a")) == 3


def _chine(x: int) -> list[tuple[float, float]]:
    bottom = [(each, 0.1 * each) for each in np.linspace(0.0, 5.0 + 0.01 * x, 12).tolist()]
    y, z = bottom[-1]
    return bottom + [(y + 0.1 * up, z + up) for up in np.linspace(0.2, 4.0, 12).tolist()]


def _knuckles(hull: Hull) -> int:
    return sum(
        int(piece.knuckle.sum())
        for line in lines_as_points(hull.state, ("sections",)) for piece in line.pieces
    )  # fmt: skip


def test_gf_has_the_frame_of_ghs(bulk_carrier: Hull, tmp_path: Path) -> None:
    """Feet; sections from forward aft, places ascending; outlines counterclockwise; limits kept."""
    bulk_carrier.export(tmp_path / "a.gf")
    rows = (tmp_path / "a.gf").read_text("ascii").splitlines()
    assert len(rows[0]) <= 58
    assert rows[-1] == "****"
    at = rows.index("*")
    assert (rows[at + 1], rows[at + 2]) == ("HULL", "42")
    place, row, deck = [], at + 3, 0
    while "," in rows[row] and rows[row] != "0,0,0":
        x, count = rows[row].split(",")
        outline = np.array([r.split(",")[:2] for r in rows[row + 1 : row + 1 + int(count)]], float)
        y, z = np.concatenate([outline, outline[::-1] * [-1.0, 1.0]]).T
        area = np.sum(y * np.roll(z, -1) - np.roll(y, -1) * z)
        assert area > 0.0
        assert int(count) < 256
        deck += rows[row + int(count)].endswith(",0,0,DK")
        place.append(float(x))
        row += int(count) + 1
    assert np.diff(place).min() > 0.01
    assert place[0] == pytest.approx(-304.5 / 0.3048, abs=1e-4)
    assert deck == 42


def test_a_hull_stays_a_hull(wigley: Hull, tmp_path: Path) -> None:
    """The canonical text that `export` writes is what `save` writes."""
    report = wigley.export(tmp_path / "a.hull.json")
    wigley.save(tmp_path / "b.hull.json")
    assert (tmp_path / "a.hull.json").read_bytes() == (tmp_path / "b.hull.json").read_bytes()
    assert (report.rounding, report.largest, report.left_out) == (0.0, 0.0, ())
    assert json.loads((tmp_path / "a.hull.json").read_text())["format"] == "assoc-hull"


def test_an_unknown_form_is_refused(wigley: Hull, tmp_path: Path) -> None:
    """Neither ending nor format: the message names what there is, and nothing is written."""
    with pytest.raises(BadInputError, match=r"\.bri"):
        wigley.export(tmp_path / "a.dat")
    with pytest.raises(BadInputError, match="britfair"):
        wigley.export(tmp_path / "a.dat", "dwg")
    assert list(tmp_path.iterdir()) == []
