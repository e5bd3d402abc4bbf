"""Blank cells where waterlines run out: a plumb end and the edge of a keel, told."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.shipped.wigley import wigley_half_breadth

X, Z = np.linspace(0.0, 100.0, 11), np.linspace(0.0, 6.25, 6)
VOLUME = 4.0 / 9.0 * 100.0 * 10.0 * 6.25


def wigley(blank: Callable[[int, int], bool], rake: float = 0.0) -> str:
    """Write Wigley's hull with blank cells; its ends are plumb, or lean out by so much per m."""
    rows = ["x_m," + ",".join(f"wl_{z:g}" for z in Z)]
    for i, x in enumerate(X.tolist()):
        along = 50.0 + (x - 50.0) / (1.0 + rake * Z)
        y = wigley_half_breadth(along, Z, 100.0, 10.0, 6.25).tolist()
        rows.append(
            ",".join([f"{x:g}", *("" if blank(i, j) else f"{b:.4f}" for j, b in enumerate(y))])
        )
    return "\n".join(["# m, x from AP", *rows]) + "\n"


@pytest.mark.parametrize(
    "blank",
    [
        lambda i, j: i in (0, 10),
        lambda i, j: i in (0, 10) and j > 0,
        lambda i, j: i in (0, 10) or j == 0,
    ],
)
def test_a_blank_end_where_waterlines_run_out_is_plumb(
    blank: Callable[[int, int], bool], tmp_path: Path
) -> None:
    """It was told as 80 of 100 m, with S known to 23 %, of a hull that was right."""
    path = tmp_path / "blank.csv"
    path.write_text(wigley(blank))
    hull = ah.read(path, length=100, draught=6.25)
    assert hull.adoption is not None
    notes = hull.adoption.notes
    assert sum(each.startswith("assumed: plumb end") for each in notes) == 2
    assert not [each for each in notes if each.startswith(("suspicion: length", "suspicion: few"))]
    assert float(hull.hydrostatics().volume) == pytest.approx(VOLUME, rel=2e-3)


def test_a_blank_end_of_a_raked_hull_stays_blank() -> None:
    """Waterlines that end before it, or reach over it, tell no plumb end."""
    text = wigley(lambda i, j: i in (0, 10), rake=0.04)
    table, report = read_offsets(text, length=100, draught=6.25)
    assert np.isnan(table.half_breadth[[0, 10]]).all()
    assert "plumb end" not in report.kinds("assumptions")
