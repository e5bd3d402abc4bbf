"""Tables as spreadsheets save them: encodings, stations across, zeros that are not printed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.io.importing.import_hull import import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.shipped.wigley import wigley_half_breadth

L, B, D = 100.0, 10.0, 6.25
X, Z = np.linspace(0.0, L, 11), np.linspace(0.0, D, 6)
Y = wigley_half_breadth(X[:, None], Z[None], L, B, D)


def down(mark: str = ",", said: str = "# station 0 = AP\n") -> str:
    """A station a row, with numbers as `str` prints them: no zeros at the end."""
    head = mark.join(["station", *(f"wl_{z:g}" for z in Z)])
    rows = [mark.join([f"{i}", *(f"{y:.4g}" for y in row)]) for i, row in enumerate(Y)]
    return "\n".join([said + head, *rows]) + "\n"


def across(corner: str, names: list[str], mark: str = "\t") -> str:
    """A station a column, waterlines down."""
    rows = [mark.join([corner, *names])]
    rows += [mark.join([f"{z:g}", *(f"{y:.4g}" for y in Y[:, k])]) for k, z in enumerate(Z)]
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize("name", ["utf-16", "utf-16-le", "utf-16-be"])
def test_a_table_in_utf_16_is_read_and_told(name: str, tmp_path: Path) -> None:
    """As spreadsheets save 'Unicode text': with the mark at its head, and without."""
    path = tmp_path / "ship.txt"
    path.write_bytes(down("\t").encode(name))
    table, report = read_offsets(path, length=L, draught=4.5)
    np.testing.assert_allclose(table.half_breadth, Y, atol=1e-3)
    assert report.kinds("repairs") == ("encoding",)


def test_digitised_lines_in_utf_16_are_lines(tmp_path: Path) -> None:
    """Their head tells what they are, as that of any other file."""
    rows = ["line,x,y,z"]
    rows += [f"ST {x:g},{x:g},{y:.6g},{z:g}" for x, row in zip(X, Y, strict=True)
             for z, y in zip(Z, row, strict=True)]  # fmt: skip
    path = tmp_path / "lines.csv"
    path.write_bytes("\n".join(rows).encode("utf-16"))
    assert ah.read(path, length=L, draught=4.5, accept=True).particulars.length == L


@pytest.mark.parametrize(
    ("corner", "options"),
    [
        ("x", {}),
        ("x [m]", {}),
        ("z \\ x", {}),
        ("", {}),
        ("WL", {}),
        ("Station", {"length": L, "station_zero": "ap"}),
        ("", {"length": L, "station_zero": "ap", "frame_spacing": 1.0}),
    ],
)
def test_stations_across_are_found_by_the_numbers(corner: str, options: dict[str, object]) -> None:
    """Down a section half-breadths rise, along a waterline they fall again: no name need say it."""
    numbers = range(11) if corner == "Station" else X.tolist()
    table, report = read_offsets(across(corner, [f"{x:g}" for x in numbers]), **options)  # type: ignore[arg-type]
    np.testing.assert_allclose(table.x, X)
    np.testing.assert_allclose(table.half_breadth, Y, atol=1e-3)
    assert "stations across" in report.kinds("repairs")
    assert report.suspicions == report.faults == ()


def test_places_under_numbers_of_stations_across() -> None:
    """A row x below the row of stations is a column of places when the table is turned."""
    text = across("Station", [str(i) for i in range(11)])
    head, rest = text.split("\n", 1)
    table, _ = read_offsets(head + "\n" + "\t".join(["x", *(f"{x:g}" for x in X)]) + "\n" + rest)
    np.testing.assert_allclose(table.x, X)
    np.testing.assert_allclose(table.half_breadth, Y, atol=1e-3)


def test_stations_down_stay_where_they_are() -> None:
    """Of a table as usual nothing is turned, whatever its corner says."""
    for corner in ("station", "", "x"):
        _, report = read_offsets(down().replace("station,wl_", f"{corner},wl_"), length=L)
        assert "stations across" not in report.kinds("repairs")


def test_zeros_that_are_not_printed_tell_no_coarser_rounding(tmp_path: Path) -> None:
    """A keel of 0 and a deck of 1.8, 3.2, 4.2 are known as well as the waterlines between.

    Taken for whole metres, sections ran straight from 4.2 to the deck at 5, 170 mm off.
    """
    table, _ = read_offsets(down(), length=L, draught=4.5)
    assert set(table.rounding.tolist()) == {5e-4}
    whole, _ = read_offsets(down().replace(",0,0,0,0,0,0\n", ",0.0,0,0,0,0,0\n"), length=L)
    assert set(whole.rounding.tolist()) == {5e-4}
    path = tmp_path / "ship.csv"
    path.write_text(down())
    hull = ah.read(path, length=L, draught=4.5)
    area = hull.hydrostatics(on_error="report", draughts=(4.0, 4.0)).waterplane_area
    assert area == pytest.approx(2.0 / 3.0 * L * B * (1.0 - (1.0 - 4.0 / D) ** 2), rel=1e-3)


def test_both_draughts_of_a_trim_make_the_draught(tmp_path: Path) -> None:
    """They count like the draught, nothing is suspected; a third that is not their mean is told."""
    path = tmp_path / "ship.csv"
    path.write_text(down())
    given = ImportOptions(length=L, draught_aft=5.0, draught_fwd=4.0)
    state, report = import_hull(path, given)
    assert (state.particulars.draught, str(report.verdict)) == (4.5, "sound")
    more = ImportOptions(length=L, draught_aft=5.0, draught_fwd=4.0, draught=4.51)
    state, report = import_hull(path, more)
    assert state.particulars.draught == 4.51
    assert any("the mean of draught_aft and draught_fwd is 4.5 m" in each.what
               for each in report.notes.assumptions)  # fmt: skip


def test_a_scale_of_nothing_is_refused(tmp_path: Path) -> None:
    """0 is no scale, and not the same as none given."""
    path = tmp_path / "ship.csv"
    path.write_text(down())
    with pytest.raises(BadInputError, match="scale is 0, as an argument; give a number above 0"):
        ah.read(path, length=L, draught=4.5, scale=0)


@pytest.mark.parametrize(
    "options",
    [{"draught": 40.0}, {"draught": 4.0, "depth": 30.0},
     {"draught": 4.0, "ap": 10, "length": 10.0, "fp": 500},
     {"draught": 4.0, "base": 30}, {"draught": 4.0, "ap": 500}],
    ids=["draught", "depth", "length", "base line", "perpendicular"],
)  # fmt: skip
def test_dimensions_that_do_not_fit_a_table_name_its_file(
    options: dict[str, float], tmp_path: Path
) -> None:
    """Of ten tables read in a loop, the message says which."""
    path = tmp_path / "ferry.csv"
    path.write_text(down())
    with pytest.raises(BadInputError, match=r"in the table ferry\.csv; "):
        ah.read(path, **{"length": L, **options})  # type: ignore[arg-type]
