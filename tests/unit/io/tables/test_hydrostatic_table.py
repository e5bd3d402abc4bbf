"""Tables of hydrostatics as files: read back they hold the numbers, names, units and the head."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.hydrostatics.floating_body import Appendage, FloatingPosition
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import table_of
from assoc_hull.analysis.hydrostatics.record import FIELDS, HydrostaticTable
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.hydrostatics import (
    hydrostatic_csv,
    hydrostatic_xlsx,
    write_hydrostatic_table,
)
from tests.floating_bodies import Box, head

FIN = Appendage("fin, port", 30.0, (20.0, 0.0, -1.0), 50.0)


@pytest.fixture(scope="module")
def table() -> HydrostaticTable:
    """Three positions of a box with an appendage, one of them heeled, with estimates."""
    header = head(
        100.0, 20.0, 6.0, kg=4.0, keel_thickness=0.02, appendages=(FIN,), date="2026-01-31",
        ship="Ship,\n# 1",
    )  # fmt: skip
    places = [FloatingPosition(5.0, 5.0), FloatingPosition(7.0, 5.0), FloatingPosition(6, 6, 8.0)]
    return table_of(Box(off=1e-6), places, header, notes=("ST 3 is open",))


def check(names: list[str], units: list[str], rows: list[list[float]], table: HydrostaticTable,
          accuracy: float) -> None:  # fmt: skip
    """Compare what was read with the table."""
    found = dict(zip(names, np.array(rows, np.float64).T, strict=True))
    for name, values in table.columns.items():
        assert_allclose(found[name], values, rtol=accuracy, err_msg=name)
        assert_allclose(found[f"error_{name}"], table.errors[name], rtol=accuracy)
        assert units[names.index(name)] == FIELDS[name].unit
    assert found["draught_aft"].tolist() == [5.0, 7.0, 6.0]
    assert found["draught_fore_extreme"].tolist() == [5.02, 5.02, 6.02]
    assert found["heel_deg"].tolist() == [0.0, 0.0, 8.0]
    free = [each.least for each in table.freeboards]
    assert_allclose(found["freeboard"], free, rtol=accuracy)
    assert found["volume of fin, port"].tolist() == [30.0] * 3


def test_a_csv_reads_back(table: HydrostaticTable) -> None:
    """To twelve digits; what a position has not is blank; the head stands above."""
    text = hydrostatic_csv(table)
    above = [line for line in text.splitlines() if line.startswith("#")]
    names, units, *rows = csv.reader(io.StringIO("\n".join(text.splitlines()[len(above) :])))
    numbers = [[float(cell or "nan") for cell in row] for row in rows]
    check(names, units, numbers, table, 1e-11)
    assert np.isnan(numbers[2][names.index("kmt")])
    assert "# water: salt water, 1.025 t/m3" in above
    assert "# appendage: fin, port: 30 m3 at (20, 0, -1) m, 50 m2" in above
    assert "# date: 2026-01-31" in above
    assert "# note: ST 3 is open" in above
    assert any(line.startswith("# datum: x from AP, + forward") for line in above)
    assert any(line.startswith("# fingerprint: ") for line in above)


def test_a_workbook_reads_back(table: HydrostaticTable) -> None:
    """To the last bit but that a cell holds fifteen or more digits; the same bytes each time."""
    openpyxl = pytest.importorskip("openpyxl")
    data = hydrostatic_xlsx(table)
    assert data == hydrostatic_xlsx(table)
    sheet = openpyxl.load_workbook(io.BytesIO(data)).active
    cells = [list(row) for row in sheet.iter_rows(values_only=True)]
    top = next(k for k, row in enumerate(cells) if not str(row[0]).startswith("#"))
    names, units, *rows = cells[top:]
    numbers = [[np.nan if cell is None else cell for cell in row] for row in rows]
    check(names, units, numbers, table, 1e-14)
    assert cells[0][:2] == ["# ship", "Ship, # 1"]
    assert sheet.freeze_panes == f"C{top + 3}"


@pytest.mark.parametrize("name", ["t.csv", "t.XLSX"])
def test_the_ending_tells_the_form(table: HydrostaticTable, tmp_path: Path, name: str) -> None:
    """In either case of letters."""
    write_hydrostatic_table(table, tmp_path / name)
    assert (tmp_path / name).stat().st_size > 1000


def test_another_ending_is_refused(table: HydrostaticTable, tmp_path: Path) -> None:
    """And nothing is written."""
    with pytest.raises(BadInputError, match=r"\.csv or \.xlsx"):
        write_hydrostatic_table(table, tmp_path / "t.txt")
    assert list(tmp_path.iterdir()) == []


def test_a_name_that_looks_like_a_formula_stays_text() -> None:
    """What a spreadsheet would take for a formula stands in the head as it was given."""
    openpyxl = pytest.importorskip("openpyxl")
    named = Appendage("=1+1", 30.0, (20.0, 0.0, -1.0), 50.0)
    header = head(100.0, 20.0, 6.0, appendages=(named,), ship="=A1")
    book = hydrostatic_xlsx(table_of(Box(off=1e-6), [FloatingPosition(5.0, 5.0)], header))
    sheet = openpyxl.load_workbook(io.BytesIO(book)).active
    cells = [cell for row in sheet.iter_rows(max_col=2) for cell in row]
    assert all(cell.data_type != "f" for cell in cells)
    assert "=A1" in [cell.value for cell in cells]
