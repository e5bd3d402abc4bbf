"""The doctor of offsets on files: forms of tables, what it refuses, and the mended table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.io.offsets.read import read_offsets, read_printed
from assoc_hull.shipped.wigley import wigley_half_breadth
from tests.damaged_tables import PlainTable, series60_table

STATION, WATERLINE = "18", "0.75"


def spoilt(*slips: tuple[str, str, str]) -> PlainTable:
    """Series 60 .70 with other numbers: station, number, what is typed for it."""
    table = series60_table("070")
    rows = [list(row) for row in table.rows]
    for station, number, typed in slips:
        (row,) = [each for each in rows if each[0] == station]
        row[row.index(number)] = typed
    return table.with_rows(rows)


SLIP = (STATION, "0.425", "0.245")
ONE, THREE = (SLIP,), (SLIP, ("14", "0.8852", "0.8582"), ("5", "0.935", "0.953"))


def turned(table: PlainTable) -> str:
    """The table with stations across and waterlines down."""
    columns = zip(table.header, *table.rows, strict=True)
    rows = [",".join(column) for column in columns]
    return "\n".join([f"# {each}" for each in table.comments] + rows) + "\n"


def written(path: Path, text: str) -> Path:
    """A file of this text."""
    path.write_text(text, encoding="utf-8")
    return path


FORMS: dict[str, Callable[[PlainTable], str]] = {
    "commas": lambda table: table.text(),
    "semicolons and decimal commas": lambda table: table.text(";", comma=True),
    "tabs": lambda table: table.text("\t"),
    "blanks": lambda table: table.text(" "),
    "turned": turned,
    "a title and a note": lambda table: "Table of offsets" + "," * 8 + "\n" + table.text(),
}


@pytest.mark.parametrize("form", FORMS)
def test_a_slip_is_found_and_mended_in_every_form_of_a_table(form: str, tmp_path: Path) -> None:
    """The cell, the number that was meant, and a mended table that differs in that cell alone."""
    path = written(tmp_path / "table.csv", FORMS[form](spoilt(*ONE)))
    before = path.read_bytes()
    report = ah.doctor(path, mend=tmp_path / "mended.csv")
    (slip,) = report.alarms
    assert (slip.station, slip.waterline, slip.printed) == (STATION, WATERLINE, "0.245")
    assert [(each.text, each.slip) for each in slip.numbers[:1]] == [
        ("0.425", "two digits exchanged")
    ]
    assert path.read_bytes() == before
    lines = (tmp_path / "mended.csv").read_text("utf-8").splitlines()
    told = [line for line in lines if line.startswith("# mended")]
    assert told == [
        f"# mended: station 18, waterline 0.75: 0.245 to 0.425, score {slip.score:.1f}, two digits "
        "exchanged"
    ]
    assert "\n".join(lines[1:]) + "\n" == FORMS[form](spoilt())
    again = ah.doctor(tmp_path / "mended.csv")
    assert again.alarms == ()
    assert np.array_equal(
        read_printed(tmp_path / "mended.csv")[1].y, read_printed(spoilt().text())[1].y
    )


def test_several_slips_are_mended_at_once_and_the_table_imports(tmp_path: Path) -> None:
    """Three slips: one call finds them, the mended table has none and makes the right hull."""
    path = written(tmp_path / "table.csv", spoilt(*THREE).text())
    report = ah.doctor(path, mend=tmp_path / "mended.csv")
    assert sorted(each.mended for each in report.alarms) == ["0.425", "0.8852", "0.935"]
    assert report.written == str(tmp_path / "mended.csv")
    assert "0.245 to 0.425" in str(report)
    table, notes = read_offsets(tmp_path / "mended.csv", length=121.92)
    assert notes.suspicions == ()
    right = read_offsets(spoilt().text(), length=121.92)[0]
    np.testing.assert_array_equal(table.half_breadth, right.half_breadth)


def test_a_sound_table_is_written_as_it_is(tmp_path: Path) -> None:
    """What stands under the name afterwards is that table, and no other's that stood there."""
    path = written(tmp_path / "table.csv", spoilt().text())
    (tmp_path / "mended.csv").write_text("another one")
    found = ah.doctor(path, mend=tmp_path / "mended.csv", replace=True)
    assert (found.alarms, found.written) == ((), str(tmp_path / "mended.csv"))
    first, rest = (tmp_path / "mended.csv").read_text().split("\n", 1)
    assert first == "# no slip is called: nothing was mended"
    assert rest == path.read_text()


def test_nothing_is_written_over(tmp_path: Path) -> None:
    """Not the table, by whatever name; not another file, unless that is wished."""
    path = written(tmp_path / "table.csv", spoilt(*ONE).text())
    (tmp_path / "same.csv").symlink_to(path)
    before = path.read_bytes()
    for name in ("table.csv", "same.csv"):
        with pytest.raises(BadInputError, match="over the table itself"):
            ah.doctor(path, mend=tmp_path / name, replace=True)
    written(tmp_path / "other.csv", "mine")
    with pytest.raises(BadInputError, match="there is a file of this name"):
        ah.doctor(path, mend=tmp_path / "other.csv")
    assert (tmp_path / "other.csv").read_text() == "mine"
    ah.doctor(path, mend=tmp_path / "other.csv", replace=True)
    assert "mended" in (tmp_path / "other.csv").read_text()
    with pytest.raises(BadInputError, match="written as text"):
        ah.doctor(path, mend=tmp_path / "other.xlsx")
    assert path.read_bytes() == before


def wigley(write: str, times: float, slip: tuple[str, str] | None = None) -> str:
    """The Wigley hull, 21 x 9, zeros at both ends and at the keel, in some unit."""
    x, z = np.linspace(0.0, 100.0, 21), np.linspace(0.0, 6.25, 9)
    y = times * np.array([wigley_half_breadth(np.full(9, a), z, 100.0, 10.0, 6.25) for a in x])
    rows = [f"{k}," + ",".join(format(each, write) for each in row) for k, row in enumerate(y)]
    head = "station," + ",".join(f"wl_{times * each:g}" for each in z)
    text = "\n".join([head, *rows]) + "\n"
    return text if slip is None else text.replace(*slip, 1)


@pytest.mark.parametrize(
    ("write", "times", "slip"),
    [(".0f", 1000.0, ("3609", "3069")), (".3f", 1.0, ("3.609", "3.069")),
     (".3f", 1.0 / 0.3048, ("11.842", "11.482"))],
)  # fmt: skip
def test_units_need_not_be_known(write: str, times: float, slip: tuple[str, str]) -> None:
    """Millimetres, metres and feet; neither length nor unit is told: numbers count as printed."""
    report = ah.doctor(wigley(write, times, slip))
    assert report.unit == ""
    (found,) = report.alarms
    assert (found.printed, found.mended) == (slip[1], slip[0])
    assert found.off == pytest.approx(float(slip[1]) - float(slip[0]), abs=2e-3 * times)


def test_feet_and_inches_are_told_as_printed() -> None:
    """12-6-3 is feet, inches and eighths: what neighbours ask for is told in these."""
    table = read_printed(wigley(".4f", 1.0 / 0.3048))[1]
    rows = [[eighths(each) for each in row] for row in table.y.tolist()]
    assert rows[6][5] == "11-10-1"
    rows[6][5] = "11-1-1"
    text = "station," + ",".join(f"wl_{each:g}" for each in table.z)
    text = "\n".join([text, *(f"{k},{','.join(row)}" for k, row in enumerate(rows))])
    (found,) = ah.doctor(text).alarms
    assert (found.station, found.printed, found.mended) == ("6", "11-1-1", "11-10-1")


def eighths(feet: float) -> str:
    """As a loftsman writes it."""
    inches, parts = divmod(round(96.0 * feet), 8)
    return f"{inches // 12}-{inches % 12}-{parts}"


def test_starboard_stays_starboard(tmp_path: Path) -> None:
    """Half-breadths with a minus are judged as others, and mended with it."""
    table = spoilt(*ONE)
    rows = [[row[0], *(f"-{each}" for each in row[1:])] for row in table.rows]
    path = written(tmp_path / "table.csv", table.with_rows(rows).text())
    (slip,) = ah.doctor(path, mend=tmp_path / "mended.csv").alarms
    assert slip.mended == "0.425"
    assert ",-0.425," in (tmp_path / "mended.csv").read_text()


def test_a_repeated_row_is_mended_as_well(tmp_path: Path) -> None:
    """A row that stands twice is read once; both have the new number, and the table reads."""
    table = spoilt(*ONE)
    rows = [row for row in table.rows for _ in range(1 + (row[0] == STATION))]
    path = written(tmp_path / "table.csv", table.with_rows(rows).text())
    assert len(ah.doctor(path, mend=tmp_path / "mended.csv").alarms) == 1
    assert (tmp_path / "mended.csv").read_text().count(",0.425,") == 2


def test_a_table_without_five_neighbours_is_told_so() -> None:
    """Three rows by three columns: nothing can be checked, nothing is called."""
    report = ah.doctor("station,wl_0,wl_1,wl_2\n0,0,0,0\n5,3,7,8\n10,0,0,0\n")
    assert (report.findings, report.both, report.single) == ((), 0, 0)
    assert len(report.unchecked) == 3
    assert "nothing could be checked" in str(report)


def test_five_rows_of_three_waterlines_are_checked_along_the_ship() -> None:
    """In one direction, and the finding says so."""
    rows = [[0.0, 0.0, 0.0], *([a, 1.5 * a, 2.0 * a] for a in (10, 30, 50, 66, 76, 80, 80, 80))]
    rows[5][1] = 69.0  # for 99
    text = "\n".join(f"{k}," + ",".join(f"{each:g}" for each in row) for k, row in enumerate(rows))
    report = ah.doctor("station,wl_0,wl_1,wl_2\n" + text)
    assert report.both == 0
    assert not report.findings[0].both
    assert (report.findings[0].station, report.findings[0].waterline) == ("5", "1")


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("station,wl_0,wl_1\n0,nan,1\n1,2,3\n", "'nan' is not a number"),
        ("hello\nworld\n", "no row besides words"),
        ("line,x,y,z\nWL 1,0,1,2\nWL 1,1,2,3\n", r"1 waterline\(s\)"),
        ("\n\n", "nothing in it"),
    ],
)
def test_what_is_no_table_is_refused(text: str, wanted: str) -> None:
    """With the place and what to do, as an import refuses it."""
    with pytest.raises(BadInputError, match=wanted):
        ah.doctor(text)


def test_a_hull_file_is_refused_with_the_way_to_its_table(tmp_path: Path) -> None:
    """A hull is no table; and a missing file is told by name."""
    hull = ah.examples.wigley()
    hull.save(tmp_path / "ship.hull")
    with pytest.raises(BadInputError, match="ask the hull itself"):
        ah.doctor(tmp_path / "ship.hull")
    with pytest.raises(BadInputError, match=r"none\.csv"):
        ah.doctor(tmp_path / "none.csv")
    hull.export(tmp_path / "offsets.csv")
    assert ah.doctor(tmp_path / "offsets.csv").alarms == ()


def test_a_table_with_slips_all_over_is_not_mended_cell_by_cell(tmp_path: Path) -> None:
    """So many slips that whole lines must be wrong: told, and nothing is written."""
    x, z = np.linspace(0.0, 100.0, 31), np.linspace(0.0, 8.0, 21)
    y = np.array([wigley_half_breadth(np.full(21, a), z, 100.0, 10.0, 8.0) for a in x])
    wrong = np.random.default_rng(3).random(y.shape) < 0.2
    y[wrong] = np.round(1.7 * y[wrong] + 0.5, 3)
    text = "station," + ",".join(f"wl_{each:g}" for each in z) + "\n"
    text += "\n".join(f"{k}," + ",".join(f"{each:.3f}" for each in r) for k, r in enumerate(y))
    report = ah.doctor(text)
    assert report.overrun
    assert "whole rows or columns" in str(report)
    with pytest.raises(BadInputError, match="by hand; nothing was written"):
        ah.doctor(text, mend=tmp_path / "mended.csv")
    assert not (tmp_path / "mended.csv").exists()


def test_an_import_notes_what_the_doctor_calls(tmp_path: Path) -> None:
    """As a suspicion of the table, which is no refusal; `strict` is one."""
    path = written(tmp_path / "table.csv", spoilt(("5", "0.935", "0.953")).text())
    hull = ah.read(path, length=121.92)
    assert hull.adoption is not None
    (note,) = [each for each in hull.adoption.notes if "outlier" in each]
    assert "station 5, waterline 1:" in note
    assert "0.935: two digits exchanged?" in note
    with pytest.raises(ah.errors.NotSoundError, match="two digits exchanged"):
        ah.read(path, length=121.92, strict=True)


def with_cells(text: str, *cells: tuple[int, int, str]) -> str:
    """A table with other cells: row, column and number."""
    rows = [line.split(",") for line in text.splitlines()]
    for row, column, number in cells:
        rows[row][column] = number
    return "\n".join(map(",".join, rows)) + "\n"


def test_rules_tell_what_no_batten_does() -> None:
    """A number between zeros, numbers that are all even, a number typed twice."""
    text = wigley(".0f", 1001.0)
    assert ah.doctor(text).remarks == ()
    (remark,) = ah.doctor(with_cells(text, (1, 3, "10"))).remarks
    assert (remark.kind, remark.amount) == ("lone value", 10.0)
    cells = text.splitlines()[6].split(",")
    even = [(6, k, f"{2 * (int(cell) // 2)}") for k, cell in enumerate(cells) if k]
    even += [(9, k, f"{10 * (int(cell) // 10)}") for k, cell in enumerate(cells) if k]
    told = ah.doctor(with_cells(text, *even)).remarks
    assert {"shared factor: station 8: all its numbers"} <= {
        str(each).partition(" are")[0] for each in told
    }
    for row, times in ((6, 2.0), (9, 0.5)):
        cells = text.splitlines()[row].split(",")
        other = [(row, k, f"{times * int(cell):.0f}") for k, cell in enumerate(cells) if k]
        (first, *_) = ah.doctor(with_cells(text, *other)).remarks
        assert (first.kind, first.where) == ("shared factor", f"station {row - 1}")
        assert first.amount == pytest.approx(times, rel=0.02)
        assert "times what the lines beside ask for" in str(first)
    twice = text.splitlines()[13].split(",")[5]
    (remark,) = ah.doctor(with_cells(text, (13, 4, twice))).remarks
    assert (remark.kind, remark.where) == ("equal neighbours", "station 12, waterline 2346.09")
