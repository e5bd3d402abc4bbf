"""What the parts of `io.offsets` give, one small example of each."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_array_equal

from assoc_hull.io.offsets.complete_table import end_contours, flat_of_side
from assoc_hull.io.offsets.hints import OffsetHints, read_hints
from assoc_hull.io.offsets.net import lines_of_table, net_of_lines
from assoc_hull.io.offsets.read import build_table, read_offsets
from assoc_hull.io.offsets.scale import (
    OffsetScale,
    PrintedSizes,
    find_scale,
    station_places,
)
from assoc_hull.io.offsets.sheet import classify_columns, read_sheet
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.table_blocks import TableBlock
from assoc_hull.shipped.series60 import todd_table


def test_the_flats_of_a_hull_given_by_offsets_flat() -> None:
    """The flats of a hull given by offsets: flat of side in y = B/2, flat of bottom in z = 0."""
    flat = flat_of_side(todd_table(0.70)[0])
    assert [round(float(end[5]) / 121.92 * 20, 2) for end in (flat.x_aft, flat.x_forward)] == [
        6.92,
        13.08,
    ]


def test_the_ends_of_a_hull_given_by_offsets_stem() -> None:
    """The ends of a hull given by offsets: stem and stern contour, and the centre profile."""
    stern, _stem = end_contours(todd_table(0.70)[0])
    assert stern.round(3).tolist() == [0.0, 0.0, 0.0, 0.0, 0.0, -2.042, -3.661, -4.757]


def test_from_the_numbers_of_a_sheet_to_a_table() -> None:
    """From the numbers of a sheet to a table in ship axes."""
    rows = (("0", "100", "200"), ("50", "4000", "5000"))
    sheet = read_sheet(TableBlock("text", ("x_m", "wl_0", "wl_2000"), rows, (2, 3)), Notebook())
    scale = OffsetScale("mm", 1e-3, 1e-3, 1e-3, 50.0, 10.0, None)
    table = build_table(sheet, None, scale, OffsetHints(), "ap", Notebook())
    assert (table.z.tolist(), table.half_breadth[1].tolist()) == ([0.0, 2.0], [4.0, 5.0])


def test_tables_of_offsets_half_breadths_by_station_and_waterline() -> None:
    """Tables of offsets: half-breadths by station and waterline, heights by station and
    buttock."""
    text = """# station 0 = AP
    station,wl_0,wl_3,wl_6
    0,0,0,0.4
    5,3.0,7.0,8.0
    10,0,0,0
    """
    table, report = read_offsets(text, unit="m", length=100.0, breadth=16.0)
    assert (table.x.tolist(), table.half_breadth[1].tolist()) == (
        [0.0, 50.0, 100.0],
        [3.0, 7.0, 8.0],
    )
    assert [note.kind for note in report.assumptions] == ["station zero", "station numbers"]


def test_the_reader_notes_every_suspicion_on_a_table() -> None:
    """Every suspicion on a table in ship axes is noted with its place."""
    text = "# station 0 = AP\nstation,wl_0,wl_3,wl_6\n0,0,0,1\n5,0,8,8\n10,0,0,0\n"
    _, report = read_offsets(text, unit="m", length=100.0, breadth=16.0, draught=6.0)
    assert report.kinds() == ("flat bottom missing",)


def test_which_column_of_an_offset_table_holds() -> None:
    """Which column of an offset table holds what, from the header alone."""
    columns = classify_columns(
        TableBlock("text", ("station", "x_m", "wl_0", "WL 0.25"), (), ()), Notebook()
    )
    assert (columns.single["x"].unit, [column.value for column in columns.waterlines]) == (
        "m",
        [0.0, 0.25],
    )


def test_the_numbers_of_one_block_as_printed_rows_checked() -> None:
    """The numbers of one block as printed: rows checked, doubles dropped, digits counted."""
    rows = (("0", "0.10"), ("1", "0.25"))
    block = TableBlock("text", ("station", "wl_0"), rows, (2, 3))
    sheet = read_sheet(block, Notebook())
    assert (sheet.offsets.tolist(), sheet.half_unit.tolist()) == ([[0.1], [0.25]], [0.005])


def test_what_the_comments_above_an_offset_table_say_about() -> None:
    """What the comments above an offset table say about units, frame and particulars."""
    hints = read_hints(("y/(B/2) and z/T; station 0 = FP, 20 = AP", "L/B = 7.5, B/T = 2.5"))
    assert (hints.units.y, hints.station_zero, hints.divisions, hints.length_breadth) == (
        "normalised",
        "fp",
        20,
        7.5,
    )


def test_the_unit_of_an_offset_table_and_the_particulars() -> None:
    """The unit of an offset table and the particulars that give its full scale."""
    scale = find_scale(
        "auto",
        PrintedSizes(16200.0, 16200.0),
        OffsetHints(),
        None,
        32.4,
        None,
        Notebook(),
        "text",
    )
    assert (scale.unit, scale.y, scale.breadth) == ("mm", 0.001, 32.4)


def test_where_the_stations_of_an_offset_table_lie_order() -> None:
    """Where the stations of an offset table lie: order, origin and sense of x."""
    stations = np.array([0.0, 5.0, 10.0])
    assert_array_equal(
        station_places(stations, "fp", OffsetHints(), 100.0, Notebook(), "text"), [100.0, 50.0, 0.0]
    )


def test_a_table_of_offsets_as_lines_what_it_says() -> None:
    """A table of offsets as lines: what it says and no more, for hulls no rule completes."""
    text = "# unit: m\nx_m,z_keel,wl_1,wl_2\n0,1,0,1\n5,0.5,3,4\n9,0.5,3,5\n14,,0,2\n"
    table, _ = read_offsets(text)
    lines = lines_of_table(table)
    names = ["ST 0", "ST 5", "ST 9", "ST 14", "WL 1", "profile", "deck edge"]
    assert [line.name for line in lines] == names
    assert lines[1].points.tolist() == [[5.0, 0.0, 0.5], [5.0, 3.0, 1.0], [5.0, 4.0, 2.0]]
    assert len(net_of_lines(table)[1].lines) == 7
