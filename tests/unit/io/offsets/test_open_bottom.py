"""A keel that rises below broad half-breadths: no section dips below it, and the gap is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.edit.document import Document
from assoc_hull.io.importing.import_hull import import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.offsets.net import lines_of_table
from assoc_hull.io.offsets.read import read_offsets

L, B, T, RAKE, RISE = 60.0, 11.0, 3.0, 8.0, 3.2
X = np.array([0, 2, 4, 6, 8, 14, 20, 26, 32, 38, 44, 50, 52, 54, 56, 58, 60], np.float64)
Z = np.arange(0.0, 4.1, 0.5)
VOLUME = B * (T * (L - 2.0 * RAKE) + T**2 * RAKE / RISE)


def barge(*, keel: bool, half: float = 0.5 * B) -> str:
    """A box with raked ends, blank below its bottom; with or without a column of the keel."""
    low = RISE * np.clip(np.maximum(RAKE - X, X - (L - RAKE)) / RAKE, 0.0, 1.0)
    rows = ["x_m," + ",".join(f"WL {z:g} m" for z in Z) + (",keel" if keel else "")]
    for x, k in zip(X, low, strict=True):
        cells = ["" if z < k - 1e-9 else f"{half:.3f}" for z in Z]
        rows.append(",".join([f"{x:g}", *cells, *([f"{k:.3f}"] if keel else [])]))
    return "\n".join(rows) + "\n"


def test_no_section_dips_below_its_keel() -> None:
    """A spline from the keel to an upright side swung .8 m below it, and V was 5 % too large."""
    table, report = read_offsets(barge(keel=True), length=L, draught=T)
    assert "open bottom" in report.kinds("suspicions")
    sections = {line.offset: line for line in lines_of_table(table) if line.group == "sections"}
    assert sections[4.0].points[0].tolist() == [4.0, 0.0, 1.6]
    assert sections[4.0].kind[1] == 2


@pytest.mark.parametrize("keel", [True, False])
def test_what_lies_between_keel_and_half_breadths_is_told(keel: bool, tmp_path: Path) -> None:
    """V is off by no more than the suspicion says; without heights of the keel blanks tell it."""
    path = tmp_path / "barge.csv"
    path.write_text(barge(keel=keel))
    state, report = import_hull(path, ImportOptions(length=L, draught=T, origin="ap"))
    (told,) = [each for each in report.verdict.suspicions if each.kind == "open bottom"]
    assert told.amount is not None
    assert "0, 2, 4, 6" in told.where
    volume = hydrostatics(Document(state), on_error="report").volume
    assert abs(VOLUME / volume - 1.0) < told.amount < 0.05


def test_a_sharp_bottom_leaves_nothing_open() -> None:
    """Where the lowest half-breadths run out to the keel, nothing is suspected."""
    rows = ["station,wl_0,wl_1,wl_2,wl_3,keel"]
    for i in range(11):
        k, full = 0.05 * abs(i - 5) ** 2 / 5.0, 4.0 * (1.0 - (i / 5.0 - 1.0) ** 2)
        cells = ["" if z < k else f"{full * (z - k) / 3.0:.4f}" for z in (0.0, 1.0, 2.0, 3.0)]
        rows.append(",".join([str(i), *cells, f"{k:.4f}"]))
    _, report = read_offsets("\n".join(rows), length=L, draught=2.0, station_zero="ap")
    assert "open bottom" not in report.kinds("suspicions")


def test_a_counter_that_reaches_the_deck_alone_is_taken(tmp_path: Path) -> None:
    """A station with one half-breadth, at the deck: it was refused for a curve of one point."""
    x, z = np.linspace(0.0, 14.0, 15), np.array([-0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.6, 0.9, 1.2])
    rows = ["x," + ",".join(f"{each:g}" for each in z)]
    for place in x:
        u = abs(place / 7.0 - 1.0)
        low = -0.75 + 1.05 * u**2 + 0.7 * u**4
        half = 1.9 * (1.0 - min(abs((place - 6.6) / 7.4) ** 2.3, 1.0))
        up = np.clip((z - low) / (1.2 - low), 0.0, 1.0) ** 0.62
        cells = ["" if a < low - 1e-9 else f"{half * b:.3f}" for a, b in zip(z, up, strict=True)]
        rows.append(",".join([f"{place:g}", *cells]))
    path = tmp_path / "yacht.csv"
    path.write_text("\n".join(rows) + "\n")
    state, report = import_hull(path, ImportOptions(draught=0.7, accept=True))
    assert "left open" in str(report.adoption.notes)
    assert hydrostatics(Document(state), on_error="report").volume == pytest.approx(5.887, rel=0.02)


def test_a_hull_that_is_out_of_the_water_is_told_as_such() -> None:
    """Its sections have no area below the draught, of which a part could be missing."""
    rows = ["x_m,WL 2 m,WL 3 m,WL 4 m,keel", *(f"{x},4,5,5,1.6" for x in range(0, 60, 6))]
    _, report = read_offsets("\n".join(rows), length=54.0, draught=1.0)
    assert "open bottom" not in report.kinds("suspicions")
