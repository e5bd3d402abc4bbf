"""The shipped Series 60 tables against the published ones."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.shipped.series60 import todd_table

HULLS = [(0.60, "s60_cb060_offsets.csv", 7.5), (0.70, "s60_cb070_offsets.csv", 7.0)]


@pytest.mark.parametrize(("cb", "file", "ratio"), HULLS)
def test_the_shipped_numbers_are_the_published_ones(
    data_folder: Path, cb: float, file: str, ratio: float
) -> None:
    """Same half-breadths, stations and waterlines; the area column is compared."""
    shipped, _ = todd_table(cb)
    published, report = read_offsets(data_folder / "series60" / file, length=121.92)
    np.testing.assert_array_equal(shipped.half_breadth, published.half_breadth)
    np.testing.assert_array_equal(shipped.x, published.x)
    np.testing.assert_array_equal(shipped.z, published.z)
    np.testing.assert_array_equal(shipped.rounding, published.rounding)
    assert shipped.breadth == published.breadth == pytest.approx(121.92 / ratio)
    assert "sectional areas" in [n.where for n in report.assumptions if n.kind == "check"]
    assert report.suspicions == ()


@pytest.mark.parametrize(("cb", "ratio"), [(0.60, 7.5), (0.70, 7.0)])
def test_frame_and_rounding(cb: float, ratio: float) -> None:
    """AP at 0 with station 20, FP at Lpp with station 0; three printed digits from 0.5 T up."""
    table, report = todd_table(cb)
    assert table.station is not None
    assert (table.x[0], table.station[0], table.station[-1]) == (0.0, 20.0, 0.0)
    assert table.x[-1] == pytest.approx(121.92)
    assert table.draught == pytest.approx(121.92 / ratio / 2.5)
    half = 121.92 / ratio / 2.0
    np.testing.assert_allclose(table.rounding, [5e-5 * half] * 3 + [5e-4 * half] * 5)
    assert table.half_breadth[0, -1] > table.half_breadth[-1, -1] > 0
    assert report.suspicions == ()


@pytest.mark.parametrize(("cb", "file", "ratio"), HULLS)
def test_areas_are_near_the_published_ratios(
    data_folder: Path, cb: float, file: str, ratio: float
) -> None:
    """Trapezoids up to T give the published sectional-area ratios within 1 %."""
    with (data_folder / "series60" / file).open() as lines:
        rows = [row for row in csv.reader(lines) if not row[0].startswith("#")]
    published = np.array([float(row[-1]) for row in rows[1:]])[::-1]
    table, _ = todd_table(cb)
    areas = np.trapezoid(table.half_breadth[:, :6], table.z[:6], axis=1)
    np.testing.assert_allclose(areas / areas.max(), published, atol=0.01)


def test_the_corrected_number_was_a_trap(data_folder: Path) -> None:
    """The 10 printed at station 0, waterline 0.25, is suspected when put back."""
    lines = (data_folder / "series60" / HULLS[0][1]).read_text().splitlines()
    k = next(k for k, line in enumerate(lines) if line.startswith("0,"))
    cells = lines[k].split(",")
    cells[3] = "0.0099"
    lines[k] = ",".join(cells)
    report = read_offsets("\n".join(lines), length=121.92)[1]
    assert [(n.kind, n.where) for n in report.suspicions] == [
        ("lone value", "station 0, waterline 0.25")
    ]


def test_other_block_coefficients_are_refused() -> None:
    """The error names those there are."""
    with pytest.raises(BadInputError, match=r"0\.65.*give one of 0\.60 and 0\.70"):
        todd_table(0.65)
