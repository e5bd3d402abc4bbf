"""Offset tables: what is read, what is refused, and every trap seen in the report."""

from __future__ import annotations

import re
from pathlib import Path

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import OffsetReport

STATIONS = np.arange(21.0)
HEIGHTS = np.array([0.0, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0])
LENGTH, BREADTH, DRAUGHT = 200.0, 32.0, 10.0


def fair_offsets() -> FloatArray:
    """Half-breadths (21, 9) m of a fair hull, fuller aft above water, station 0 at the AP."""
    x, z = STATIONS[:, None] / 10.0 - 1.0, HEIGHTS[None, :] / 12.0
    aft, forward = np.clip(-x, 0, 1), np.clip(x, 0, 1)
    plan = 1.0 - (1.0 - 0.5 * z**3) * aft**2.5 - forward**2.0 * (1.0 - 0.1 * z**3)
    return np.asarray(BREADTH / 2.0 * plan * (0.6 + 0.4 * (1.0 - (1.0 - z) ** 4)))


def csv_text(
    offsets: FloatArray | None = None,
    *,
    digits: int = 3,
    comment: str = "# station 0 = AP",
    header: str = "",
) -> str:
    """Write a table as a file would hold it, blanks for nan."""
    offsets = fair_offsets() if offsets is None else offsets
    header = header or "station," + ",".join(f"wl_{z:g}" for z in HEIGHTS)
    rows = [
        ",".join([f"{s:g}", *("" if np.isnan(y) else f"{y:.{digits}f}" for y in row)])
        for s, row in zip(STATIONS, offsets, strict=True)
    ]
    return "\n".join([comment, header, *rows]) + "\n"


def read(text: str | Path, **given_values: float | str | None) -> tuple[OffsetTable, OffsetReport]:
    """Read with the particulars of the fair hull, unless told otherwise."""
    values: dict[str, object] = {"length": LENGTH, "breadth": BREADTH, "draught": DRAUGHT}
    values |= given_values
    return read_offsets(text, **values)  # type: ignore[arg-type]


def planted(i: int, j: int, value: float) -> OffsetReport:
    """The report on the fair hull with one other value."""
    offsets = fair_offsets()
    offsets[i, j] = value
    return read(csv_text(offsets))[1]


def test_a_fair_table_in_metres_raises_no_suspicion() -> None:
    """What is read is what was written, to the printed digit, frozen, and nothing is suspected."""
    table, report = read(csv_text())
    np.testing.assert_allclose(table.half_breadth, fair_offsets(), atol=5.001e-4)
    np.testing.assert_allclose(table.x, STATIONS * 10.0)
    np.testing.assert_allclose(table.rounding, 5e-4)
    assert (table.length, table.breadth, table.draught, table.depth) == (200, 32, 10, None)
    assert table.keel is None
    assert table.buttock_height is None
    assert len(table.buttock_y) == 0
    assert not table.half_breadth.flags.writeable
    assert not table.x.flags.writeable
    assert report.suspicions == report.repairs == ()
    assert report.kinds("assumptions") == ("station numbers", "station zero", "unit")


def test_the_report_is_data_and_text() -> None:
    """A report becomes plain data and a readable text with every note in it."""
    report = read(csv_text())[1]
    data = attrs.asdict(report)
    assert data["assumptions"][0]["kind"] == report.assumptions[0].kind
    assert all(str(note) in str(report) for note in report.assumptions)
    assert "suspicions (0)" in str(report)


def test_a_table_in_millimetres() -> None:
    """Millimetres are told from the breadth, or given; waterlines are in mm too."""
    header = "station," + ",".join(f"wl_{1000 * z:g}" for z in HEIGHTS)
    text = csv_text(fair_offsets() * 1000.0, digits=0, header=header)
    for unit in ("auto", "mm"):
        table, report = read(text, unit=unit)
        np.testing.assert_allclose(table.half_breadth, fair_offsets(), atol=5.001e-4)
        np.testing.assert_allclose(table.z, HEIGHTS)
        np.testing.assert_allclose(table.rounding, 5e-4)
        assert report.suspicions == ()


def test_a_normalised_table() -> None:
    """y/(B/2) and z/T come to full scale, the rounding with them."""
    header = "station," + ",".join(f"wl_{z / DRAUGHT:g}" for z in HEIGHTS)
    text = csv_text(fair_offsets() / 16.0, digits=4, header=header)
    table, report = read(text, unit="normalised")
    np.testing.assert_allclose(table.half_breadth, fair_offsets(), atol=8.001e-4)
    np.testing.assert_allclose(table.z, HEIGHTS)
    np.testing.assert_allclose(table.rounding, 8e-4)
    assert report.suspicions == ()


def test_station_zero_forward_is_turned_round() -> None:
    """The same hull numbered from the FP gives the same table, and the repair is reported."""
    table, report = read(csv_text(fair_offsets()[::-1], comment="# station 0 at the FP"))
    np.testing.assert_allclose(table.half_breadth, fair_offsets(), atol=5.001e-4)
    np.testing.assert_allclose(table.x, STATIONS * 10.0)
    assert table.station is not None
    np.testing.assert_allclose(table.station, STATIONS[::-1])
    assert report.kinds("repairs") == ("station order",)


def test_the_wrong_end_is_suspected() -> None:
    """Station 0 said to be at the FP though the fuller end lies there is a suspicion."""
    report = read(csv_text(comment=""), station_zero="fp")[1]
    assert "frame" in report.kinds()


def test_arguments_that_contradict_the_comments_are_reported() -> None:
    """The argument counts, the contradiction is a suspicion with both values."""
    text = csv_text(fair_offsets()[::-1], comment="# station 0 = AP; B = 30 m; unit: m")
    table, report = read(text, station_zero="fp", unit="m")
    assert table.breadth == BREADTH
    assert {note.where for note in report.suspicions} == {"breadth", "station zero"}


@pytest.mark.parametrize(
    ("comment", "unit"),
    [
        ("unit: mm", "m"),
        ("half-breadths in mm, heights in m", "m"),
        ("half-breadths in m, heights in mm", "m"),
        ("half-breadths in mm, heights in m", "mm"),
        ("y/(B/2)", "mm,m"),
        ("all dimensions in feet", "in"),
    ],
)
def test_a_unit_against_the_one_in_the_file_is_refused(comment: str, unit: str) -> None:
    """What the file says of a block and what is given must agree: one of the two is wrong."""
    text = csv_text(comment=f"# station 0 = AP; {comment}")
    with pytest.raises(BadInputError, match=r"was given and the file says.*leave the unit out"):
        read(text, unit=unit)


def test_trailing_zeros_are_no_printed_digits() -> None:
    """A column whose numbers all end in 0 was printed with a digit less."""
    offsets = np.round(fair_offsets(), 3)
    offsets[:, 4:] = np.round(offsets[:, 4:], 2)
    table, report = read(csv_text(offsets))
    np.testing.assert_allclose(table.rounding, [5e-4] * 4 + [5e-3] * 5)
    assert "printed digits" in report.kinds("assumptions")


def test_rounding_in_the_comments_counts() -> None:
    """A comment may give the rounding of each waterline in the unit of the table."""
    comment = "# station 0 = AP\n# rounding: " + " ".join(["0.02"] * 9)
    np.testing.assert_allclose(read(csv_text(comment=comment))[0].rounding, 0.02)
    with pytest.raises(BadInputError, match="has 2 numbers and the table 9 waterlines"):
        read(csv_text(comment="# station 0 = AP\n# rounding: 1 2"))


@pytest.mark.parametrize("mark", ["\t", ";"])
def test_other_separators_and_decimal_commas(mark: str) -> None:
    """Tabs and semicolons separate cells; decimal commas are mended and reported."""
    comment, table_text = csv_text().split("\n", 1)
    plain = table_text.replace(",", mark)
    table, report = read(f"{comment}\n{plain}")
    assert report.repairs == ()
    commas = re.sub(r"([0-9])\.([0-9])", r"\1,\2", plain.split("\n", 1)[1])
    header = plain.split("\n", 1)[0]
    again, report = read(f"{comment}\n{header}\n{commas}")
    np.testing.assert_array_equal(again.half_breadth, table.half_breadth)
    assert report.kinds("repairs") == ("decimal comma",)


def test_profile_deck_and_buttocks() -> None:
    """Keel, deck and a second block of buttocks are read into ship axes."""
    text = """# station 0 = AP
station,x_m,z_keel_m,z_sheer_m,y_deck,wl_0,wl_2,wl_4
0,0,1.5,6,3,,0.5,2
5,20,0,5,4,2,3.5,4
10,40,0,5.5,1,0,0.3,0.5
station,bt_1,bt_2
0,2.5,4
5,0,0.1
10,,
"""
    table, report = read(text, length=40.0, breadth=8.0)
    assert table.keel is not None
    assert table.keel.tolist() == [1.5, 0, 0]
    assert table.deck_height is not None
    assert table.deck_height.tolist() == [6, 5, 5.5]
    assert table.deck_half_breadth is not None
    assert table.depth == 5.0
    assert table.buttock_y.tolist() == [1, 2]
    assert table.buttock_height is not None
    np.testing.assert_array_equal(table.buttock_height, [[2.5, 4], [0, 0.1], [np.nan, np.nan]])
    assert "blank" not in report.kinds()
    first, second = text.split("station,bt", 1)
    apart, _ = read_offsets(first, length=40.0, breadth=8.0, buttocks="station,bt" + second)
    assert apart.buttock_height is not None
    np.testing.assert_array_equal(apart.buttock_height, table.buttock_height)
    with pytest.raises(BadInputError, match="station 6 has buttock heights and no half-breadths"):
        read_offsets(text.replace("5,0,0.1", "6,0,0.1"), length=40.0, breadth=8.0)


def test_x_from_the_forward_perpendicular_and_at_negative_x() -> None:
    """x counted from the FP, or with the bow at negative x, is turned round with a repair."""
    rows = "wl_0,wl_2\n{},0,0.5\n{},3,4\n{},0,0.2\n"
    head = "x_m,"
    for places, zero in (((40, 20, 0), "fp"), ((-40, -20, 0), "fp"), ((0, -20, -40), "ap")):
        table, report = read(
            head + rows.format(*places), length=40.0, breadth=8.0, station_zero=zero
        )
        assert table.x.tolist() == [0, 20, 40]
        assert table.half_breadth[:, 1].tolist() == [0.5, 4, 0.2]
        assert set(report.kinds("repairs")) & {"frame", "bow at negative x"}
    with pytest.raises(BadInputError, match="which end x = 0 is"):
        read(head + rows.format(-40, -20, 0), length=40.0, breadth=8.0)
    table, report = read(head + rows.format(-20, 0, 20), length=40.0, breadth=8.0)
    assert table.x.tolist() == [-20, 0, 20]
    assert any("amidships" in note.what for note in report.assumptions)
    with pytest.raises(BadInputError, match="amidships and not the ap"):
        read(head + rows.format(-20, 0, 20), length=40.0, breadth=8.0, station_zero="ap")


def test_a_repeated_row_is_dropped_and_a_different_one_refused() -> None:
    """An identical double is a repair; one with other numbers an error that names both rows."""
    text = csv_text()
    line = next(row for row in text.splitlines() if row.startswith("7,"))
    table, report = read(text.replace(line, f"{line}\n{line}"))
    assert len(table.x) == 21
    assert report.kinds("repairs") == ("repeated station",)
    other = line[:-1] + ("1" if line[-1] != "1" else "2")
    with pytest.raises(BadInputError, match=r"in row 10, .*row 11 \(station 7\), column 'wl_12'"):
        read(text.replace(line, f"{line}\n{other}"))


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("cell", [(5, 5), (10, 2), (14, 6)])
def test_a_wild_value_is_named(cell: tuple[int, int], sign: int) -> None:
    """A value 2 % of B/2 off its neighbours is the only outlier, with what they say."""
    i, j = cell
    fair = fair_offsets()[i, j]
    value = min(fair + sign * 0.32, BREADTH / 2.0) if sign > 0 else fair - 0.32
    if abs(value - fair) < 0.1:
        pytest.skip("no room below B/2")
    found = [note for note in planted(i, j, value).suspicions if note.kind == "outlier"]
    assert [note.where for note in found] == [f"station {i}, waterline {HEIGHTS[j]:g}"]
    assert found[0].amount == pytest.approx(value - fair, abs=0.08)


def test_swapped_digits_are_named() -> None:
    """Two neighbouring digits swapped after the point come out on top."""
    i, j = 16, 6
    text = f"{fair_offsets()[i, j]:.3f}"
    swapped = text[:-3] + text[-2] + text[-3] + text[-1]
    assert swapped != text
    found = planted(i, j, float(swapped)).suspicions
    assert (found[0].kind, found[0].where) == ("outlier", f"station {i}, waterline 8")


def test_a_ten_typed_for_nil_is_named() -> None:
    """A lone number between zeros at an end, and a 10 inside, are both suspected."""
    offsets = fair_offsets()
    offsets[20] = 0.0
    offsets[20, 3] = 0.010
    report = read(csv_text(offsets))[1]
    notes = [n for n in report.suspicions if n.where == "station 20, waterline 2"]
    assert [(note.kind, note.amount) for note in notes] == [("lone value", 0.010)]
    assert planted(3, 4, 0.0).suspicions[0].where == "station 3, waterline 4"


def test_blanks_below_a_rising_keel_are_reported() -> None:
    """Blanks at the foot are taken as below the keel; blanks between numbers are suspected."""
    offsets = fair_offsets()
    offsets[0, :3] = np.nan
    offsets[20, 7:] = np.nan
    offsets[9, 4] = np.nan
    table, report = read(csv_text(offsets))
    assert np.isnan(table.half_breadth[0, :3]).all()
    noted = {note.where for note in report.assumptions if note.kind == "blank"}
    assert noted == {"station 0", "station 20"}
    blanks = [note.where for note in report.suspicions if note.kind == "blank"]
    assert blanks == ["station 9, waterline 4"]


def test_a_blank_above_the_keel_line_is_suspected() -> None:
    """With a keel line, a blank above it and a number below it are suspected."""
    text = "x_m,z_keel_m,wl_0,wl_1,wl_2\n0,0.5,,,2\n20,0,2,3,4\n40,1.5,0,0.2,0.4\n"
    report = read(text, length=40.0, breadth=8.0, draught=2.0)[1]
    found = [note.where for note in report.suspicions if note.kind == "blank"]
    assert found == ["station 0, waterline 1", "station 40, waterline 1"]


def test_a_table_normalised_per_waterline_is_suspected() -> None:
    """Every waterline scaled to its own largest value looks wrong at the lowest one."""
    offsets = fair_offsets()
    text = csv_text(offsets / offsets.max(axis=0) * BREADTH / 2.0)
    assert "normalised per waterline" in read(text)[1].kinds()


def test_metres_read_as_millimetres_are_a_fault() -> None:
    """The wrong unit gives a ship of impossible proportions."""
    report = read_offsets(csv_text(), length=LENGTH, unit="mm")[1]
    assert [each.kind for each in report.faults].count("unit") > 0
    assert any("length to breadth" in note.what for note in report.faults)


def test_waterlines_in_another_unit_are_read() -> None:
    """Half-breadths in metres over waterlines in millimetres make one ship only: it is told."""
    header = "station," + ",".join(f"wl_{1000 * z:g}" for z in HEIGHTS)
    table, report = read(csv_text(header=header))
    np.testing.assert_allclose(table.z, HEIGHTS)
    assert report.suspicions == ()
    assert any(note.what.startswith("heights in mm") for note in report.assumptions)
    header = "station," + ",".join(f"wl_{1000 * z:g}mm" for z in HEIGHTS)
    assert read(csv_text(header=header))[1].suspicions == ()


def test_a_hull_that_narrows_amidships_is_suspected() -> None:
    """Below the draught a hull does not narrow upward amidships."""
    offsets = fair_offsets()
    offsets[8:13, 6] = offsets[8:13, 5] - 0.2
    kinds = [n.where for n in read(csv_text(offsets))[1].suspicions if n.kind.startswith("decr")]
    assert kinds == [f"station {i}, waterline 8" for i in range(8, 13)]


@pytest.mark.parametrize("fill", [0.0, np.nan])
def test_a_missing_flat_of_bottom_is_suspected(fill: float) -> None:
    """No half-breadth at the base line under a broad waterline: the flat bottom is missing."""
    offsets = fair_offsets()
    offsets[:, 0] = fill
    assert "flat bottom missing" in read(csv_text(offsets))[1].kinds()


def test_above_half_the_breadth_within_rounding_is_told() -> None:
    """Half a printed digit above B/2 passes with a note, or what a breadth of few digits lacks;
    more is refused."""
    offsets = np.minimum(fair_offsets(), 15.99)
    offsets[10, 8] = 15.99
    report = read(csv_text(offsets, digits=2), breadth=31.975)[1]
    assert "above B/2" in report.kinds("assumptions")
    with pytest.raises(BadInputError, match=r"station 9\), column 'wl_10'; .*breadth="):
        read(csv_text(offsets, digits=2), breadth=31.9)


def test_a_number_that_cannot_be_is_a_fault_with_its_place() -> None:
    """One number beyond B/2 does not make the ship broader, given or not: it is named."""
    text = change(5, 3, "160.5")
    for breadth in (BREADTH, None):
        table, report = read(text, breadth=breadth)
        assert table.breadth == pytest.approx(BREADTH, abs=1e-9)
        (fault,) = report.faults
        assert (fault.kind, fault.where) == ("outlier", "text, row 5 (station 2), column 'wl_1'")
        assert "160.5 m, 10.03 times B/2" in fault.what


def test_a_wrong_height_in_the_header_is_suspected() -> None:
    """Columns may stand in any order; one whose height is wrong does not fit its place."""
    where = {note.where for note in read(change(2, 5, "wl_0.2"))[1].suspicions}
    assert "waterline 0.2" in where


def change(line: int, column: int, cell: str) -> str:
    """The fair table with one cell replaced; lines count from 1 as in the file."""
    lines = csv_text().splitlines()
    cells = lines[line - 1].split(",")
    cells[column] = cell
    lines[line - 1] = ",".join(cells)
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (change(5, 3, "abc"), r"'abc' is not a number, text, row 5 \(station 2\), column 'wl_1'"),
        (change(5, 3, "nan"), "'nan' is not a number"),
        (change(5, 3, "-inf"), "'-inf' is not a number"),
        (change(5, 3, "1_0"), "'1_0' is not a number"),
        (change(5, 3, "1e99"), "1e99 is beyond any ship"),
        (change(5, 3, "-0.5"), r"-0\.5 is negative, text, row 5"),
        (change(5, 3, "1,2"), "the row has 11 cells and the header 10"),
        (change(5, 0, ""), "the cell is empty"),
        (change(5, 0, "30"), "against the order of the others"),
        (change(2, 4, "wl_1"), "column 'wl_1' repeats column 'wl_1'"),
        (change(2, 4, "wl_2mm"), "in several units"),
        (change(2, 0, "place"), "neither a station nor an x column"),
        (change(2, 1, "station"), "both hold the station"),
        (change(5, 3, '"1'), "mend the quotation marks"),
        ("\n\n", "there is nothing in it"),
        ("# only a comment\n", "no row besides comments"),
        ("1,2\n3,4\n", "the first row holds numbers only"),
        ("station,wl_0,wl_1\n0,1,2\n", r"1 station\(s\) and 2 waterline"),
        ("station,wl_0\n0,1\n1,2\n", r"2 station\(s\) and 1 waterline"),
        ("station,wl_0,wl_1\n", r"0 station\(s\)"),
        ("station,wl_0,wl_1\n0,0,0\n10,0,0\n", "no half-breadth is above 0"),
        ("station,wl_0,wl_1\n0,0,1\n7,0,16\n", "whether station 0 is at the aft"),
        ("# 0 = AP\nstation,wl_0,wl_1\n0,0,1\n7,0,16\n", "run from 0 to 7"),
        ("station,bt_1\n0,1\n7,2\n", "no column is named as a waterline"),
        ("\x00\x01\n", "the content is binary"),
    ],
)
def test_bad_input_is_refused_with_place_and_remedy(text: str, message: str) -> None:
    """Each fault is a package error that names row, column and number."""
    with pytest.raises(BadInputError, match=message):
        read(text)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"length": None}, "give length="),
        ({"length": -1.0}, "length is -1.0"),
        ({"breadth": float("nan")}, "breadth is nan"),
        ({"unit": "feet"}, "'feet' is unknown"),
        ({"station_zero": "bow"}, "station_zero is 'bow'"),
        ({"unit": "normalised", "draught": None}, "draught is not known"),
        ({"breadth": 5.0}, "the unit cannot be told"),
    ],
)
def test_bad_arguments_are_refused(values: dict[str, float | str], message: str) -> None:
    """What cannot be known must be given, and the message names the argument."""
    with pytest.raises(BadInputError, match=message):
        read(csv_text(), **values)


def test_an_ambiguous_unit_is_refused() -> None:
    """A largest half-breadth of 1 may be a metre or a part of B/2: the unit must be given."""
    with pytest.raises(BadInputError, match="m or normalised"):
        read_offsets("x_m,wl_0,wl_1\n0,0,0.5\n5,0.8,1\n")


def test_bad_files_are_refused(tmp_path: Path) -> None:
    """Missing, a folder, empty, binary: package errors that name the path."""
    empty, binary = tmp_path / "empty.csv", tmp_path / "binary.csv"
    empty.write_bytes(b"")
    binary.write_bytes(bytes(range(256)))
    for path, message in (
        (tmp_path / "none.csv", "No such file"),
        (tmp_path, "cannot be read"),
        (empty, "nothing in it"),
        (binary, "binary"),
    ):
        with pytest.raises(BadInputError, match=message) as caught:
            read_offsets(path)
        assert str(path) in str(caught.value)


def test_a_file_is_read_like_its_text(tmp_path: Path) -> None:
    """Byte order mark, Windows line ends and Latin-1 comments do not matter; names come along."""
    path = tmp_path / "ship.csv"
    path.write_bytes(b"\xef\xbb\xbf" + csv_text().replace("\n", "\r\n").encode())
    table, _ = read(path)
    assert table.name == "ship"
    np.testing.assert_array_equal(table.half_breadth, read(csv_text())[0].half_breadth)
    path.write_bytes(csv_text(comment="# 0 = AP, Gr\xf6\xdfe").encode("latin-1"))
    assert read(str(path))[1].kinds("repairs") == ("encoding",)


def test_sysser_yacht_is_read(data_folder: Path) -> None:
    """Metres, blanks below the keel, x = 0 at the stern: read whole, nothing suspected."""
    table, report = read_offsets(data_folder / "sysser1" / "sysser01_offsets.csv")
    assert table.half_breadth.shape == (21, 25)
    assert table.x[0] == 0.0
    assert table.x[-1] == pytest.approx(10.047431)
    assert table.keel is not None
    assert table.deck_height is not None
    assert table.keel[0] == pytest.approx(0.794001)
    assert table.draught == pytest.approx(0.794, abs=1e-6)
    assert np.isnan(table.half_breadth[0, :17]).all()
    assert np.isnan(table.half_breadth[:, 0]).all()
    assert np.nanmax(table.half_breadth) == 1.836578
    assert report.suspicions == ()
    assert {"unit", "breadth", "length", "frame"} <= set(report.kinds("assumptions"))


PIECES = st.sampled_from(
    [",", "\n", "", "#", "nan", "-", "1e9", "10", '"', "wl_3", "station", "\t", ";", "0", "x", " "]
)


@given(
    st.lists(
        st.tuples(st.integers(0, 1600), st.integers(0, 12), st.one_of(PIECES, st.text(max_size=3))),
        min_size=1,
        max_size=6,
    ),
    st.sampled_from(["auto", "m", "mm", "normalised"]),
    st.booleans(),
)
def test_a_mangled_text_gives_a_table_or_a_package_error(
    edits: list[tuple[int, int, str]], unit: str, known: bool
) -> None:
    """Whatever is typed into a table: a table with sound axes, or an error of the family."""
    text = csv_text()
    for place, gone, piece in edits:
        text = text[:place] + piece + text[place + gone :]
    try:
        table, report = read(text, unit=unit) if known else read_offsets(text + "\n", unit=unit)
    except AssocHullError:
        return
    assert np.all(np.diff(table.x) > 0)
    assert np.all(np.diff(table.z) > 0)
    assert np.nanmin(table.half_breadth) >= 0
    assert str(report)
