"""The forms in which tables of offsets come: headers, titles, units, eighths, stations across."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.io.offsets.hints import read_hints
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.offsets.table import OffsetTable
from assoc_hull.io.reports import OffsetReport
from assoc_hull.io.tables.column_names import cell_value, column_name, label_number

HALF = [(0, 0, 0.5, 2), (5, 3, 6, 7), (10, 5, 7.5, 8), (15, 4, 7, 7.5), (20, 0, 0.2, 1)]
HEAD = "# 0 = AP; Lpp = 100 m\n"


def rows(mark: str = ",", times: float = 1.0) -> str:
    """The rows of the usual table."""
    return "\n".join(mark.join([f"{row[0]}", *(f"{times * y:g}" for y in row[1:])]) for row in HALF)


def the_same(text: str, **options: object) -> tuple[OffsetTable, OffsetReport]:
    """Read a table that must be the usual one, without suspicion."""
    table, report = read_offsets(text, **options)  # type: ignore[arg-type]
    np.testing.assert_allclose(table.x, [0, 25, 50, 75, 100])
    np.testing.assert_allclose(table.z, [0, 2, 4], atol=1e-12)
    np.testing.assert_allclose(table.half_breadth, [row[1:] for row in HALF], atol=1e-9)
    assert report.suspicions == report.faults == ()
    return table, report


@pytest.mark.parametrize(
    "header",
    [
        "station,wl_0,wl_2,wl_4",
        "ST,WL 0,WL 2,WL 4",
        "Stn.,base,2.0 m,4.0 m",
        "station,0,2,4",
        ",0,2.0,4.00",
        ",WL 0,WL 2,WL 4",
        "no,0.0m WL,2.0m WL,4.0m WL",
        "frame,z=0,z=2,z=4",
        "0,2,4",
        "wl_0,wl_2,wl_4",
        "station,wl_0mm,wl_2000mm,wl_4000mm",
        "station,0 cm,200 cm,400 cm",
        "Table 3\nOffsets of the ship,,,\nstation,WL 0,WL 2,WL 4",
        "station,0,2,4\n,m,m,m",
    ],
)
def test_headers_name_waterlines_in_many_ways(header: str) -> None:
    """Words, bare numbers, units, a blank corner or none, titles above, units below."""
    the_same(HEAD + header + "\n" + rows())


def test_words_above_and_below_the_rows_are_comments() -> None:
    """What they say counts as what comments say does; decimal commas too."""
    text = "Offsets, in metres\nLpp;100,0;m\nB/T = 6,4\nst;0;2;4\n" + rows(";").replace(".", ",")
    table, report = the_same(text + "\nmoulded;;;\n", station_zero="ap", breadth=16.0)
    assert (table.length, table.draught) == (100.0, 2.5)
    assert dict(table.stated) == {"Lpp": 100.0, "B/T": 6.4}
    assert {"title", "unit"} <= set(report.kinds("assumptions"))


def test_blanks_part_cells() -> None:
    """Columns of a listing, with or without decimal commas."""
    the_same(HEAD + "station WL 0 WL 2 WL 4\n" + rows(" "))
    the_same(HEAD + "station  0  2  4\n" + rows("   ").replace(".", ","))


def test_columns_in_any_order() -> None:
    """Names tell which is which, not places."""
    turned = "\n".join(f"{s},{c},{a},{b}" for s, a, b, c in HALF)
    _, report = the_same(HEAD + "station,4,0,2\n" + turned)
    assert report.kinds("repairs") == ("column order",)


def test_stations_across_and_waterlines_down() -> None:
    """Turned where names say so plainly; keel and sheer come as rows then."""
    lines = ["WL," + ",".join(f"ST {row[0]}" for row in HALF)]
    lines += [f"{z}," + ",".join(str(row[k]) for row in HALF) for k, z in ((1, 0), (2, 2), (3, 4))]
    lines += ["height of keel,0,0,0,0,0", "sheer height,6,5.5,5,5.5,6.5"]
    lines += ["half-breadth of deck,3,7.5,8,8,3"]
    table, report = the_same(HEAD + "\n".join(lines))
    assert report.kinds("repairs") == ("stations across",)
    assert table.deck_height is not None
    assert table.deck_half_breadth is not None
    assert table.deck_height.tolist() == [6, 5.5, 5, 5.5, 6.5]
    assert table.deck_half_breadth[1] == 7.5
    lines[2] = "2,0.5,six,7.5,7,0.2"
    with pytest.raises(BadInputError, match=r"'six' is not a number, text, row 4 \(2\).*'ST 5'"):
        read_offsets(HEAD + "\n".join(lines))


def test_feet_inches_and_eighths() -> None:
    """12-6-3+ is twelve feet, six inches, three eighths and a sixteenth."""
    assert cell_value("12-6-3+") == pytest.approx(12 + 6 / 12 + 3.5 / 96)
    assert cell_value("12-6-3-") == pytest.approx(12 + 6 / 12 + 2.5 / 96)
    assert cell_value("12-12-3") is None
    text = "STA,2-0-0,4-0-0,6-0-0\n0,0-0-0,0-6-1+,1-2-3\n5,3-0-0,4-1-1,5-0-0\n"
    text += "10,4-0-0,5-0-0,6-0-0+\n15,3-0-0,4-0-0,5-0-0\n20,0-0-0,0-1-0,1-0-0\n"
    table, _ = read_offsets(text, length=30.0, station_zero="ap")
    np.testing.assert_allclose(table.z, np.array([2, 4, 6]) * 0.3048)
    assert table.half_breadth[2, 2] == pytest.approx((6 + 0.5 / 96) * 0.3048)
    np.testing.assert_allclose(table.rounding, 0.0254 / 32)
    with pytest.raises(BadInputError, match=r"'m' was given and the file says.*'ft'"):
        read_offsets(text, length=30.0, station_zero="ap", unit="m")
    with pytest.raises(BadInputError, match=r"'4\.1' stands among cells in feet-inches-eighths"):
        read_offsets(text.replace("4-1-1", "4.1"), length=30.0, station_zero="ap")


@pytest.mark.parametrize(
    ("said", "options"),
    [
        ("", {}),
        ("", {"unit": "mm,m"}),
        ("# half-breadths in mm, heights in m\n", {}),
        ("# Half-breadths (mm); waterlines (m)\n", {}),
        ("# units: mm/m\n", {}),
    ],
)
def test_half_breadths_in_millimetres_over_heights_in_metres(
    said: str, options: dict[str, str]
) -> None:
    """Given, told, or found: a ship 16 m broad and 4 mm deep there is none."""
    the_same(HEAD + said + "station,0,2,4\n" + rows(times=1000.0), **options)


def test_decks_in_the_unit_of_the_body() -> None:
    """Heights of the deck in mm beside headers in m make one ship only: read so, and told."""
    deck = ["deck", 6000, 5500, 5000, 5500, 6500]
    lines = ("station,0,2,4\n" + rows(times=1000.0)).splitlines()
    text = "\n".join(f"{line},{height}" for line, height in zip(lines, deck, strict=True))
    table, _ = the_same(HEAD + text)
    assert table.deck_height is not None
    assert table.deck_height.tolist() == [6, 5.5, 5, 5.5, 6.5]


def test_waterlines_by_number_with_a_spacing() -> None:
    """A comment gives the spacing of waterlines that go by number."""
    the_same(HEAD + "# waterline spacing: 2,0 m\nstation,WL 0,WL 1,WL 2\n" + rows())


def test_perpendiculars_as_names_of_stations() -> None:
    """AP and FP stand for 0 and the last number, and say where station 0 is."""
    text = "st,0,2,4\n" + rows().replace("\n20,", "\nFP,")
    the_same("# Lpp = 100 m\n" + "AP".join(text.split("\n0,", 1)).replace("4AP", "4\nAP,"))


def test_the_other_side_is_mirrored() -> None:
    """All with a minus is a side; some lines are suspected, single cells refused."""
    minus = "\n".join(",".join([f"{r[0]}", *(f"-{y}" for y in r[1:])]) for r in HALF)
    _, report = the_same(HEAD + "station,0,2,4\n" + minus)
    assert report.kinds("repairs") == ("port and starboard",)
    one = rows().replace("15,4,7,7.5", "15,-4,-7,-7.5")
    table, report = read_offsets(HEAD + "station,0,2,4\n" + one)
    assert table.half_breadth.min() == 0.0
    assert [note.where for note in report.suspicions] == ["station 15"]
    with pytest.raises(BadInputError, match=r"-7 is negative.*station 15"):
        read_offsets(HEAD + "station,0,2,4\n" + rows().replace("15,4,7,7.5", "15,4,-7,7.5"))


def test_a_column_of_largest_beams_and_one_of_areas_are_checks() -> None:
    """They are no geometry; a station that contradicts them is named."""
    beams, areas = [4, 14, 16, 15, 2], [0.12, 0.79, 1, 0.91, 0.05]
    lines = ["station,0,2,4,MaxBm,SAR"]
    lines += [
        f"{line},{b},{a}" for line, b, a in zip(rows().splitlines(), beams, areas, strict=True)
    ]
    the_same(HEAD + "\n".join(lines))
    wrong = "\n".join(lines).replace(",14,0.79", ",13,0.89")
    found = read_offsets(HEAD + wrong)[1].suspicions
    assert [(note.kind, note.where) for note in found] == [
        ("sectional area", "station 5"),
        ("largest beam", "station 5"),
    ]


def test_a_row_of_largest_beams_scales_its_waterlines() -> None:
    """Waterlines printed as parts of their own largest value, as in old series."""
    beams = np.array([5.0, 7.5, 8.0]) / 8.0
    lines = ["station,wl_0,wl_0.5,wl_1"]
    for row in HALF:
        cells = np.array(row[1:]) / [5.0, 7.5, 8.0]
        lines.append(",".join([f"{row[0]}", *(f"{each:.5f}" for each in cells)]))
    lines.append("MaxBm," + ",".join(f"{each:.5f}" for each in beams))
    text = HEAD + "# unit: normalised; B = 16 m; T = 4 m\n" + "\n".join(lines)
    table, report = read_offsets(text)
    np.testing.assert_allclose(table.half_breadth, [row[1:] for row in HALF], atol=2e-4)
    assert report.kinds("repairs") == ("largest beam",)


def test_commas_that_may_part_thousands_are_refused() -> None:
    """12,300 beside 950 may be either."""
    text = "station;0;2;4\n0;0;500;2,000\n10;5,000;7,500;8,000\n20;0;200;950\n"
    with pytest.raises(BadInputError, match=r"2,000 may be 2\.000 or 2000.*row 3"):
        read_offsets(HEAD + text)


def test_what_comments_say_of_the_hull_is_kept() -> None:
    """Particulars, ratios and coefficients, for a check against what was read."""
    hints = read_hints(
        (
            "Lpp = 121,92 m, B: 16256 mm, T=6.5",
            "D = 9 m",
            "L/B = 7.5",
            "CB=0.60, CM 0.977, CP = .614",
        )
    )
    assert dict(hints.stated()) == {
        "Lpp": 121.92, "B": 16.256, "T": 6.5, "D": 9.0, "L/B": 7.5,
        "CB": 0.6, "CM": 0.977, "CP": 0.614,
    }  # fmt: skip
    report = read_offsets("# 0 = AP; Lpp = 100 m; L/B = 7.5; B = 16 m\nstation,0,2,4\n" + rows())[1]
    assert [(note.kind, note.where) for note in report.suspicions] == [("contradiction", "L/B")]


def test_names_of_columns() -> None:
    """What a label says; a word that is none is left."""
    for label in ("z_keel_m", "keel [m]", "height of keel_m"):
        assert (name := column_name(label)) is not None
        assert (name.kind, name.unit) == ("keel", "m")
    assert column_name("Sheer half-breadth").kind == "deck half-breadth"  # type: ignore[union-attr]
    assert column_name("max. half-breadth").kind == "beam"  # type: ignore[union-attr]
    assert column_name("WL 1 1/2").value == 1.5  # type: ignore[union-attr]
    assert column_name("remarks") is None
    assert label_number("9\N{VULGAR FRACTION ONE HALF}") == 9.5


def test_a_workbook_with_a_title_and_a_blank_corner(tmp_path: Path) -> None:
    """The same in cells of a sheet, decimal commas typed as text."""
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.append(["Offsets of the ship", None, None, None])
    sheet.append(["# 0 = AP", "Lpp = 100 m"])
    sheet.append([None, "WL 0", "2,0 m", "4 m"])
    for row in HALF:
        sheet.append([row[0], row[1], str(row[2]).replace(".", ","), row[3]])
    path = tmp_path / "offsets.xlsx"
    book.save(path)
    table, _ = read_offsets(path)
    np.testing.assert_allclose(table.half_breadth, [row[1:] for row in HALF])


@pytest.mark.parametrize("word", ["draft", "Draught", "Wasserlinie", "WL", "Waterline"])
def test_waterlines_are_known_by_the_words_that_yards_use(word: str) -> None:
    """With the unit or without, in the head of each column."""
    heads = [column_name(f"{word} {each}") for each in ("0", "0.5 m", "1,5")]
    assert [each and (each.kind, each.value) for each in heads] == [
        ("waterline", 0.0), ("waterline", 0.5), ("waterline", 1.5),
    ]  # fmt: skip


def test_a_table_whose_heads_are_not_understood_quotes_them() -> None:
    """And says how to call a waterline; called so, the table is read."""
    table = "x_m,Ebene 0,Ebene 1,Ebene 2\n0,0,0,0\n50,0,2,3\n100,0,0,0\n"
    with pytest.raises(BadInputError, match="not understood: 'Ebene 0', 'Ebene 1', 'Ebene 2'"):
        read_offsets(table, length=100.0, draught=2.0)
    read_offsets(table.replace("Ebene ", "wl_"), length=100.0, draught=2.0)
