"""What the parts of `io.tables` give, one small example of each."""

from __future__ import annotations

import json

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.export.offset_table import OffsetCells, offsets_xlsx
from assoc_hull.io.reports import Notebook
from assoc_hull.io.tables.form_parameters import catalogue_json
from assoc_hull.io.tables.plates import plates_csv
from assoc_hull.io.tables.spreadsheets import openpyxl_module, workbook_bytes
from assoc_hull.io.tables.table_blocks import split_blocks
from assoc_hull.io.tables.table_text import text_of_xlsx
from assoc_hull.surface.plating.hull_plates import hull_plates
from assoc_hull.surface.plating.hull_seams import HullSeams


def test_xlsx_workbooks_through_openpyxl_extra_xlsx_the_same_bytes() -> None:
    """XLSX workbooks through openpyxl (extra ``xlsx``): the same bytes for the same cells."""
    assert workbook_bytes(openpyxl_module().Workbook())[:2] == b"PK"


def test_form_parameters_as_json_the_catalogue_and_the_values() -> None:
    """Form parameters as JSON: the catalogue, and the values of a hull."""
    assert json.loads(catalogue_json())["entries"][0]["symbol"] == "Lpp"


def test_plates_of_a_hull_as_a_table_csv() -> None:
    """Plates of a hull as a table (CSV) or a document (JSON)."""
    x, z = np.mgrid[0:30:2j, 0:3:2j]
    side = SplineSurface.bezier(np.stack([x, 8.0 + 0.0 * x, z], axis=-1), "body")
    assert (
        str(plates_csv(hull_plates((side,), HullSeams(x=12.0))).splitlines()[0][:30])
        == "name,range,area,length,breadth"
    )


def test_from_a_file_or_a_text_to_blocks() -> None:
    """From a file or a text to blocks of cells: separators, comments, rows and numbers."""
    comments, blocks = split_blocks("# unit: m\nstation,wl_0\n0,1.5\n", "text", Notebook())
    assert (comments, blocks[0].header, blocks[0].rows) == (
        ("unit: m",),
        ("station", "wl_0"),
        (("0", "1.5"),),
    )


def test_tables_of_offsets_as_xlsx_workbooks_through_openpyxl_extra() -> None:
    """Tables of offsets as XLSX workbooks, through openpyxl (extra ``xlsx``): the cells of the
    CSV."""
    table = OffsetCells(("unit: m",), [[["x_m", "wl_0"], ["0", "0.50"], ["9", ""]]])
    assert text_of_xlsx(offsets_xlsx(table), "a.xlsx", Notebook()).splitlines() == [
        "# unit: m",
        "x_m,wl_0",
        "0,0.5",
        "9,",
    ]
