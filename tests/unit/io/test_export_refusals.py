"""Damaged files of every form give one line that says what and where, and never hang."""

import io
import random
import zipfile
from collections.abc import Callable
from pathlib import Path

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, BadInputError, MissingExtraError
from assoc_hull.graph.journal import Journal
from assoc_hull.hull.sources import examples
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.export.ghs_geometry import MOST, dumps_gf
from assoc_hull.io.lines.line_points import LinePolylines, lines_as_points
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.reports import ExportBook
from assoc_hull.io.tables import table_text as offset_xlsx
from assoc_hull.model.kinds import State
from assoc_hull.model.tables import HullState, Particulars

TEXTS = ("britfair", "delftship", "delftship-offsets", "gf")
TABLES = ("csv", "xlsx")


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """A small Wigley hull in every form."""
    folder, hull = tmp_path_factory.mktemp("forms"), examples.wigley(stations=5, waterlines=4)
    found = {}
    for form in (*TEXTS, *TABLES):
        hull.export(folder / form, form)
        found[form] = (folder / form).read_bytes()
    return found


def read(path: Path, form: str) -> None:
    """Read a file as the form it was."""
    if form in TABLES:
        read_offsets(path)
    else:
        read_lines(path)


def refusal(path: Path, data: bytes) -> str:
    """The one line with which `ah.read` refuses a file."""
    path.write_bytes(data)
    with pytest.raises(BadInputError) as caught:
        ah.read(path)
    text = str(caught.value)
    assert "\n" not in text
    assert len(text) < 400
    return text


@pytest.mark.parametrize("form", TEXTS)
@pytest.mark.parametrize("part", [0.3, 0.6, 0.9])
def test_a_truncated_text_is_refused(
    files: dict[str, bytes], form: str, part: float, tmp_path: Path
) -> None:
    """A file that ends too early says so; a list of lines has no end, and is read so far."""
    rows = files[form].splitlines(keepends=True)
    data = b"".join(rows[: int(part * len(rows))])
    if form == "delftship-offsets":
        (tmp_path / "a").write_bytes(data)
        read(tmp_path / "a", form)
        return
    text = refusal(tmp_path / "a", data)
    assert "take a whole file" in text
    assert "line" in text


@pytest.mark.parametrize("form", TEXTS)
def test_a_missing_number_is_refused(files: dict[str, bytes], form: str, tmp_path: Path) -> None:
    """A point with one coordinate less names its line."""
    rows = files[form].decode().splitlines()
    k = len(rows) // 2
    while rows[k].count(".") < 2 or ("," in rows[k] and rows[k].count(",") > 1):
        k += 1
    mark = "," if form == "gf" else None
    rows[k] = rows[k].split(mark)[0]
    assert f"line {k + 1} of" in refusal(tmp_path / "a", "\n".join(rows).encode())


@pytest.mark.parametrize("value", ["nan", "inf", "1e300", "x", "1;5", "--1"])
@pytest.mark.parametrize("form", TEXTS)
def test_what_is_no_number_is_refused(
    files: dict[str, bytes], form: str, value: str, tmp_path: Path
) -> None:
    """Words, infinities and numbers of no ship name their line."""
    rows = files[form].decode().splitlines()
    k = next(i for i in range(len(rows) // 2, len(rows)) if rows[i].count(".") > 1)
    rows[k] = rows[k].replace(rows[k].split("," if form == "gf" else None)[1], value, 1)
    assert "line" in refusal(tmp_path / "a", "\n".join(rows).encode())


@pytest.mark.parametrize(
    ("content", "holds"),
    [
        ("S\n1\n999999 1 5.0\n0 0\n1 1\n0\n0 0 0\n", "999999 points are announced"),
        ("S\n1\n2 1 -999.0\n0 0\n1 1\n0\n0 0 0\n", "continues another"),
        ("S\n1\n2 1 5.0\n0 0\n1 1\n7\n0 0 0\n", "no kind of tangents"),
        ("S\n1\n2 1 5.0\n0 0\n1 1\n0\n9 9\n", "3"),
        ("S\n1\n0 0 0\n", "no points"),
        ("0\n1 2 3\n", "before EOF"),
        ("0\n1 2 3\nEOF\n", "no points"),
        ("1\n0 0 0\n0 1 1\n\n0 1\nEOF\n", "line 5"),
        ("Station 5.000\n 5 0 0\n 5 1 1 KNOT\n", "line 3"),
        ("Station 5.000\n", "no points"),
        ("T\n*\nHULL\n999999999\n0,2\n0,0\n1,1\n****\n", "section"),
        ("T\n*\nHULL\n1\n0,999999999\n0,0\n****\n", "999999999 points are announced"),
        ("T\n*\nHULL\n0\n0,0,0\n****\n", "no points"),
        ("T\n*\nHULL\n1\n0\n0,0\n****\n", "place and number of points"),
        ("T\n*\nHULL\n1\n0,1\n5\n****\n", "one number"),
        ("T\n*\nHULL\n1\n0,2\n0,0\n1,1\n0,0,0\n***\nHULL\nSEA\nx\n", "whole number"),
    ],
)
def test_a_text_that_breaks_its_form_is_refused(content: str, holds: str, tmp_path: Path) -> None:
    """Huge counts, unknown kinds and missing lines are named."""
    assert holds in refusal(tmp_path / "a", content.encode())


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(lambda data: b"", id="empty"),
        pytest.param(lambda data: data.decode("latin-1").encode("utf-32"), id="UTF-32"),
        pytest.param(lambda data: b"\x00\x01\x02" + data[::-1], id="binary"),
        pytest.param(lambda data: b"\n \n\t\n", id="blank"),
    ],
)
@pytest.mark.parametrize("form", TEXTS)
def test_what_is_no_text_is_refused(
    files: dict[str, bytes], form: str, change: Callable[[bytes], bytes], tmp_path: Path
) -> None:
    """Empty files, binary ones and other encodings get their line."""
    refusal(tmp_path / "a", change(files[form]))


@pytest.mark.parametrize("form", TEXTS)
def test_a_text_in_utf_16_is_the_text(form: str, files: dict[str, bytes], tmp_path: Path) -> None:
    """What a spreadsheet saves as "Unicode text" is read as the same text in UTF-8 is."""
    data = files[form]
    for name, content in (("a", data), ("b", data.decode("latin-1").encode("utf-16"))):
        (tmp_path / name).mkdir()
        (tmp_path / name / "hull").write_bytes(content)
    one, other = (ah.read(tmp_path / name / "hull", accept=True) for name in "ab")
    assert other.fingerprint == one.fingerprint


def rezipped(data: bytes, member: str, change: Callable[[bytes], bytes]) -> bytes:
    """A workbook with one of its members changed."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            new.writestr(name, change(content) if name == member else content)
    return out.getvalue()


SHEET = "xl/worksheets/sheet1.xml"


@pytest.mark.parametrize(
    ("change", "holds"),
    [
        (lambda data: data[: len(data) // 2], "no workbook"),
        (lambda data: b"PK\x03\x04 and no more", "no workbook"),
        (lambda data: data.replace(b"\x01\x02\x14\x03\x14", b"\x01\x02\x14\x03\x65"), "version"),
        (lambda data: rezipped(data, SHEET, lambda xml: xml[:200]), "no workbook"),
        (lambda data: rezipped(data, SHEET, lambda xml: b""), "no workbook"),
        (lambda data: rezipped(data, "xl/workbook.xml", lambda xml: b"<a/>"), ""),
        (lambda data: rezipped(data, SHEET, lambda xml: xml + b" " * 60_000_000), "MB"),
        (
            lambda data: rezipped(
                data, SHEET, lambda xml: xml.replace(b'r="9"', b'r="1048576"', 1)
            ),
            "larger than any table",
        ),
    ],
)  # fmt: skip
def test_a_damaged_workbook_is_refused(
    files: dict[str, bytes], change: Callable[[bytes], bytes], holds: str, tmp_path: Path
) -> None:
    """Half an archive, foreign members, sheets of any size: one line, and soon."""
    assert holds in refusal(tmp_path / "a.xlsx", change(files["xlsx"]))


def test_cells_that_are_no_offsets_are_refused(tmp_path: Path) -> None:
    """A date and an error of a formula are named with sheet and row."""
    openpyxl = pytest.importorskip("openpyxl")
    for value, holds in ((True, "True is no offset"), ("#DIV/0!", "#DIV/0!")):
        book = openpyxl.Workbook()
        for row in (["x_m", "wl_0", "wl_1"], [0, 0, 1], [5, value, 2]):
            book.active.append(row)
        book.save(tmp_path / "a.xlsx")
        text = refusal(tmp_path / "a.xlsx", (tmp_path / "a.xlsx").read_bytes())
        assert holds in text
        assert "row 3" in text


def test_other_sheets_of_a_workbook_are_told(tmp_path: Path) -> None:
    """A sheet that begins as no table is not read, and the report says so."""
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in (["x_m", "wl_0", "wl_1"], [0, 0, 1], [50, 2, 3.5], [90, 0, 1]):
        book.active.append(row)
    book.create_sheet("weights").append(["steel", 4000])
    book.save(tmp_path / "a.xlsx")
    table, report = read_offsets(tmp_path / "a.xlsx")
    assert table.half_breadth.tolist() == [[0.0, 1.0], [2.0, 3.5], [0.0, 1.0]]
    assert "sheet" in report.kinds("assumptions")


def test_without_openpyxl_one_line_names_the_extra(
    files: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Reading and writing a workbook say what to install; nothing is written."""
    monkeypatch.setitem(__import__("sys").modules, "openpyxl", None)
    (tmp_path / "a.xlsx").write_bytes(files["xlsx"])
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[xlsx\]"):
        read_offsets(tmp_path / "a.xlsx")
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[xlsx\]"):
        examples.wigley(stations=5, waterlines=4).export(tmp_path / "b.xlsx")
    assert not (tmp_path / "b.xlsx").exists()
    assert offset_xlsx.__doc__ is not None


@pytest.mark.parametrize("form", [*TEXTS, *TABLES])
def test_random_damage_is_read_or_refused(
    files: dict[str, bytes], form: str, tmp_path: Path
) -> None:
    """Bytes and rows changed at random: a result or an error of ours, nothing else."""
    draw = random.Random(form)
    path = tmp_path / "a"
    read_all = refused = 0
    for _ in range(60):
        data = bytearray(files[form])
        for _ in range(draw.randint(1, 4)):
            at = draw.randrange(len(data))
            data[at : at + draw.randint(0, 3)] = draw.choice(
                [b"", b"9", b"-", b"\n", b",", b"\xff", b"e5"]
            )
        path.write_bytes(bytes(data))
        try:
            read(path, form)
            read_all += 1
        except AssocHullError:
            refused += 1
    assert refused > 0
    assert read_all + refused == 60


def test_a_hull_a_form_cannot_hold_is_refused_and_nothing_is_written(tmp_path: Path) -> None:
    """No sections, or too many for a geometry file: the old file stays."""
    (tmp_path / "a.gf").write_text("old")
    empty = HullState(Particulars("S", 9.0, 2.0, 1.0, 1.0))
    for name in ("a.gf", "a.bri", "a.txt", "a.csv", "a.xlsx"):
        with pytest.raises(BadInputError, match="section"):
            ah.Hull(empty).export(tmp_path / name)
    [line, *_] = lines_as_points(examples.wigley(stations=5).state, ("sections",))
    many = [LinePolylines(line.group, line.name, float(k), line.pieces) for k in range(MOST + 1)]
    with pytest.raises(BadInputError, match="256 sections"):
        dumps_gf("S", 9.0, 2.0, many, ExportBook(decimals=4))
    assert [path.read_text() for path in tmp_path.iterdir()] == ["old"]


def test_a_curve_that_failed_is_refused(tmp_path: Path) -> None:
    """A hull with a failed curve is not exported; the line is named."""
    hull = examples.wigley(stations=5, waterlines=4)
    number = hull.lines["ST 1"].curves[0].number
    Journal().put(hull.document.state.curves.state, [number], [State.FAILED])
    for name in ("a.csv", "a.bri"):
        with pytest.raises(BadInputError, match="ST 1"):
            hull.export(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_name_the_form_cannot_hold_is_mended_and_told(tmp_path: Path) -> None:
    """Line breaks, other alphabets and words that look like hints do no harm."""
    examples.wigley(stations=5, waterlines=4).export(tmp_path / "w.csv")
    odd = "Ж\n# unit: mm\n****\nL/B = 3, " + "long " * 20
    table = attrs.evolve(read_offsets(tmp_path / "w.csv")[0], name=odd)
    hull = ah.Hull(net_from_table(table)[0])
    for name in ("a.csv", "a.xlsx", "a.bri", "a.gf"):
        report = hull.export(tmp_path / name)
        assert "name" in {note.kind for note in report.mended}, name
        found = ah.read(tmp_path / name)
        # Plumb ends are sections of no breadth: three are too few to make a profile of.
        assert len(found.groups["sections"].lines) == (5 if name in ("a.bri", "a.gf") else 3)
        assert found.particulars.length == pytest.approx(100.0, rel=0.6)
