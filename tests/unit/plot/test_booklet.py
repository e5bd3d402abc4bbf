"""The booklet: one PDF with all that is known of a hull, or its tables in one workbook."""

from __future__ import annotations

import re
from pathlib import Path

import attrs
import openpyxl
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.errors import BadInputError
from assoc_hull.plot.booklet.pages import book_pages
from assoc_hull.plot.booklet.parts import PARTS, BookPart, BookRequest, Rounded, parts_of
from assoc_hull.plot.booklet.write import write_booklet
from assoc_hull.shipped.bulk_carrier_207k import bulk_carrier_207k_adopted
from tests.trawler import trawler


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """Give a small ship."""
    return ah.examples.wigley(stations=9, waterlines=6)


def made(hull: ah.Hull, *names: str, kg: float | None = None) -> tuple[BookPart, ...]:
    """Compute parts."""
    asked = BookRequest(
        names, (3.0, 4.0, 5.0), 4.0, kg, (), 1.025, 1.0, (), "refuse", None, None, None, None
    )
    return parts_of(hull, asked)[0]


def words_of(hull: ah.Hull, *names: str, kg: float | None = None) -> list[str]:
    """Give all that is written on the pages."""
    asked = BookRequest(
        names, (3.0, 4.0, 5.0), 4.0, kg, (), 1.025, 1.0, (), "refuse", None, None, None, None
    )
    parts, design = parts_of(hull, asked)
    pages, _ = book_pages(hull, parts, design, "Hull report")
    return [
        " ".join(text.get_text() for text in [*page.texts, *page.axes[0].texts]) for page in pages
    ]


def test_one_document_holds_title_contents_numbered_parts_and_fingerprint(hull: ah.Hull) -> None:
    """Every page has its number; the contents name the page on which each part begins."""
    pages = words_of(hull, "lines", "hydrostatics", "areas")
    count = len(pages)
    assert all(f"{k} / {count}" in page for k, page in enumerate(pages, 1))
    assert "Hull report" in pages[0]
    assert hull.fingerprint in pages[0]
    assert "Length between perpendiculars" in pages[0]
    for title in ("Lines plan", "Hydrostatics", "Sectional areas"):
        told = re.search(rf"{title} (\d+)", pages[1])
        assert told is not None, title
    where = re.search(r"Sectional areas (\d+)", pages[1])
    assert where is not None
    assert "Sectional areas" in pages[int(where[1]) - 1]


def test_a_criterion_that_is_not_evaluated_is_never_passed(hull: ah.Hull) -> None:
    """Without KG none of the seven is evaluated; with it the weather criterion is not."""
    (without,) = made(hull, "stability")
    criteria = without.tables[0]
    assert [row[5] for row in criteria.rows] == ["not evaluated"] * 7
    assert {row[6] for row in criteria.rows} == {"KG was not given"}
    (judged,) = made(hull, "stability", kg=4.0)
    results = {row[0]: row[5] for row in judged.tables[0].rows}
    assert results["2.3"] == "not evaluated"
    assert set(results.values()) <= {"passed", "FAILED", "not evaluated"}
    found = hull.stability(kg=4.0, draught=4.0)
    assert [row[5] == "passed" for row in judged.tables[0].rows] == [
        each.passed is True for each in found.criteria
    ]


def test_numbers_of_the_booklet_are_those_of_the_methods(hull: ah.Hull) -> None:
    """The tables hold what `hydrostatics` and `sectional areas` give, unrounded."""
    floats, areas = made(hull, "hydrostatics", "areas")
    names = [each.name for each in floats.tables[0].columns]
    volume = [row[names.index("∇")] for row in floats.tables[0].rows]
    assert volume == hull.hydrostatic_table([3.0, 4.0, 5.0]).columns["volume"].tolist()
    assert len(areas.tables[0].rows) == len(hull.bonjean(3).stations.x)


def test_the_same_hull_gives_the_same_bytes_unless_a_date_is_given(
    hull: ah.Hull, tmp_path: Path
) -> None:
    """No time stands in PDF or workbook; a date in words does, where it is given."""
    for ending in (".pdf", ".xlsx"):
        first, second = tmp_path / f"a{ending}", tmp_path / f"b{ending}"
        for path in (first, second):
            assert hull.report(path, "areas") == ("areas",)
        assert first.read_bytes() == second.read_bytes()
        hull.report(second, ["areas"], date="28 November")
        assert first.read_bytes() != second.read_bytes()
    dated = (tmp_path / "b.pdf").read_bytes()
    assert b"CreationDate" not in dated
    assert b"(28 November)" in dated


def test_a_workbook_has_a_sheet_for_each_table(hull: ah.Hull, tmp_path: Path) -> None:
    """The sheets hold whole numbers below names and units; the first one lists them."""
    path = tmp_path / "ship.xlsx"
    hull.report(path, ["hydrostatics", "areas"], draughts=[4.0, 5.0])
    book = openpyxl.load_workbook(path)
    assert book.sheetnames[:2] == ["contents", "Hydrostatics"]
    page = book["Hydrostatics"]
    assert (page["A2"].value, page["A3"].value) == ("T_A", "m")
    names = [cell.value for cell in page[2]]
    volume = page.cell(4, names.index("∇") + 1).value
    # A workbook keeps 16 digits.
    assert volume == pytest.approx(hull.hydrostatic_table([4.0, 5.0])[0].volume, rel=1e-15)
    listed = [row[1].value for row in book["contents"].iter_rows()]
    assert any(hull.fingerprint in str(each) for each in listed)


def test_all_parts_that_can_be_made_are_written_by_default(hull: ah.Hull, tmp_path: Path) -> None:
    """Surface and plates stand in it where they are given, and not otherwise."""
    written = hull.report(tmp_path / "ship.xlsx", draughts=[4.0, 5.0], draught=4.0)
    assert written == tuple(each for each in PARTS if each not in ("surface", "plates"))
    with_surface = hull.report(
        tmp_path / "ship.xlsx", ["surface", "areas"], draught=4.0, surface=hull.surface()
    )
    assert with_surface == ("areas", "surface")


@pytest.mark.parametrize(
    ("path", "parts", "words"),
    [
        ("ship.txt", None, "end the name in .pdf or .xlsx"),
        ("ship.pdf", ["lines", "engine"], "lines"),
        ("ship.pdf", ["surface"], "give surface="),
        ("ship.pdf", [], "no part is named"),
    ],
    ids=["another ending", "no such part", "a surface that is not given", "no parts"],
)
def test_what_cannot_be_written_is_refused_before_any_work(
    hull: ah.Hull, tmp_path: Path, path: str, parts: list[str] | None, words: str
) -> None:
    """The message says what to give; no file is left."""
    with pytest.raises(BadInputError, match=re.escape(words)):
        hull.report(tmp_path / path, parts)  # type: ignore[arg-type]
    assert list(tmp_path.iterdir()) == []


def test_the_command_writes_chosen_parts_and_hydrostatics_alone(
    hull: ah.Hull, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`report` names the parts it wrote; `hydrostatics -o x.pdf` is a PDF of that table."""
    ship = tmp_path / "ship.hull.json"
    hull.save(ship)
    out = tmp_path / "ship.pdf"
    assert main(["report", str(ship), str(out), "--parts", "areas", "--draught", "4"]) == 0
    assert "written:" in capsys.readouterr().out
    assert out.read_bytes()[:5] == b"%PDF-"
    alone = tmp_path / "table.pdf"
    given = ["hydrostatics", str(ship), "--table", "3:5:1", "-o", str(alone), "--no-estimate"]
    assert main(given) == 0
    assert alone.read_bytes()[:5] == b"%PDF-"
    assert main(["report", str(ship), str(out), "--parts", "plates"]) == 2
    assert "--butts" in capsys.readouterr().err


def test_bookmarks_lead_to_the_pages_of_the_contents(hull: ah.Hull, tmp_path: Path) -> None:
    """Each part stands in the outline, its tables and pictures below it; no page is changed."""
    path = tmp_path / "ship.pdf"
    hull.report(path, parts=["hydrostatics", "areas"], draughts=(3.0, 4.0, 5.0), draught=4.0)
    data = path.read_bytes()
    titles = [
        bytes.fromhex(each.decode())[2:].decode("utf-16-be")
        for each in re.findall(rb"/Title <([0-9a-f]+)>", data)
    ]
    assert titles[:2] == ["Title page", "Contents"]
    parts = [part.title for part in made(hull, "hydrostatics", "areas")]
    assert [title for title in titles if title in parts] == parts
    # Where the table of places says it is, each object begins.
    update = data[data.rindex(b"\nxref\n") :]
    for number, place in re.findall(rb"(\d+) 1\n(\d{10}) 00000 n \n", update):
        assert data[int(place) :].startswith(b"%s 0 obj\n" % number)
    root = re.findall(rb"/Outlines (\d+) 0 R", data)
    assert len(root) == 1
    targets = {int(each) for each in re.findall(rb"/Dest \[(\d+) 0 R /Fit\]", data)}
    kids = re.search(rb"/Kids \[(.*?)\]", data, re.DOTALL)
    assert kids is not None
    assert targets <= {int(each) for each in re.findall(rb"(\d+) 0 R", kids[1])}


def test_names_in_any_script_are_printed_without_a_warning(tmp_path: Path) -> None:
    """Characters that the font lacks are blank squares; a warning is an error here."""
    ship = ah.examples.wigley(stations=9, waterlines=6)
    with ship.edit("names") as edit:
        edit.rename(None, "船 Größe")
        edit.rename("ST 5", "肋骨 5")
    ship.report(tmp_path / "ship.pdf", parts=["areas"], draught=4.0, title="报告")
    assert "\u25a1 Größe" in " ".join(words_of(ship, "areas"))


def test_one_document_has_one_moment_to_trim(hull: ah.Hull) -> None:
    """With KG both parts tell MTC by GM_L, without by BM_L; the form parameters say which."""
    for kg, lever in ((3.0, "GM_L"), (None, "BM_L")):
        form = made(hull, "form", kg=kg)[0]
        (row,) = [row for table in form.tables for row in table.rows if row[0] == "MTC"]
        told = hull.hydrostatics(draught=4.0, kg=kg).mtc
        assert str(row[1]).endswith(f", by {lever}")
        value = row[2]
        assert isinstance(value, Rounded)
        assert value.value == pytest.approx(told, rel=1e-12)


def test_a_long_report_tells_which_part_it_is_at(hull: ah.Hull, tmp_path: Path) -> None:
    """Each part is computed, then drawn, in order; then the pages are written."""
    heard: list[tuple[str, int, int]] = []
    parts = ["bonjean", "areas"]
    write_booklet(hull, tmp_path / "a.pdf", parts, tell=lambda *step: heard.append(step))
    doing = [f"{act} {part}" for act in ("computing", "drawing") for part in parts]
    assert heard == [*((words, k, 4) for k, words in enumerate(doing)), ("writing pages", 0, 0)]


def test_places_along_the_ship_say_from_where_they_count(hull: ah.Hull) -> None:
    """LCB in % counts from midship and LCF in m from AP: each says so, with its direction."""
    rows = [row for table in made(hull, "form")[0].tables for row in table.rows]
    names = {str(row[0]): str(row[1]) for row in rows}
    assert names["LCB"] == "centre of buoyancy, from midship, + forward"
    assert names["LCF"] == "centre of flotation, from AP, + forward"
    along = [row for row in rows if str(row[0]).startswith(("LCB", "LCF", "X"))]
    for row in along:
        assert str(row[1]).endswith((", + forward", ", + aft")) or row[0] == "LCF-LCB", row


def test_a_hull_under_suspicion_is_not_called_sound(tmp_path: Path) -> None:
    """The verdict of the import stands in its booklet, with the suspicions."""
    boat = trawler(tmp_path)
    asked = BookRequest(
        ("accuracy",), (2.0, 3.0), 3.1, None, (), 1.025, 1.0, (), "refuse", None, None, None, None
    )
    part = parts_of(boat, attrs.evolve(asked, adoption=boat.adoption))[0][0]
    facts = dict(part.facts)
    assert facts["findings"] == "none in the net"
    assert facts["import"].startswith("sound with suspicions (")
    assert any(note.startswith("suspicion: ") for note in part.notes)


def test_curves_of_one_line_are_told_apart_and_those_beyond_their_tolerance_are_marked(
    hull: ah.Hull,
) -> None:
    """In the table of how far curves pass the points they were made of."""
    _, report = bulk_carrier_207k_adopted()
    first, second, *others = report.lines
    line = attrs.evolve(first, tolerance_used=0.5)
    beyond = attrs.evolve(first, tolerance_used=3.9)
    report = attrs.evolve(
        report, lines=(line, beyond, attrs.evolve(second, tolerance_used=1.0), *others)
    )
    asked = BookRequest(
        ("accuracy",), (3.0, 4.0), 4.0, None, (), 1.025, 1.0, (), "refuse", None, None, report, None
    )
    (part,) = parts_of(hull, asked)[0]
    table = next(each for each in part.tables if "pass the points" in each.title)
    assert [(row[0], row[-1]) for row in table.rows[:3]] == [
        (f"{first.line}, curve 1", ""),
        (f"{first.line}, curve 2", "beyond its tolerance"),
        (second.line, ""),
    ]
