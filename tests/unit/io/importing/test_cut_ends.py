"""Sections alone that stop before the hull does: the verdict says where, and what it may cost."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.edit.document import Document
from assoc_hull.io.importing.import_hull import ImportReport, import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.wigley import wigley_half_breadth

L, B, D, T = 100.0, 10.0, 6.25, 4.5
SURFACE = 1129.61
"""By quadrature of the formula, m2."""

VOLUME = 2.0 / 3.0 * L * B * (T**2 / D - T**3 / (3.0 * D**2))


def read(
    ends: tuple[float, float], folder: Path, **options: object
) -> tuple[HullState, ImportReport]:
    """Read 20 sections of Wigley's hull, between two places, as curves of DELFTship."""
    z = np.linspace(0.0, D, 9)
    rows = ["0"]
    for x in np.linspace(*ends, 20):
        y = wigley_half_breadth(np.full(len(z), x), z, L, B, D)
        rows += [f"{x:.4f} {a:.4f} {b:.4f}" for a, b in zip(y, z, strict=True)] + [""]
    path = folder / "sections.txt"
    path.write_text("\n".join([*rows, "EOF"]) + "\n")
    return import_hull(path, ImportOptions(**options))  # type: ignore[arg-type]


def test_ends_that_no_section_shows_are_told_with_what_they_may_cost(tmp_path: Path) -> None:
    """Sections from 2.5 to 97.5 m: both places are named, and V is off by no more than is said."""
    state, report = read((2.5, 97.5), tmp_path, draught=T)
    told = [each for each in report.verdict.suspicions if each.kind == "open end"]
    assert len(told) == 1
    assert "at x = 0 m and ST 95 at x = 95 m" in told[0].where
    assert told[0].amount is not None
    found = hydrostatics(Document(state), on_error="report")
    assert 0.001 < VOLUME / found.volume - 1.0 < told[0].amount < 0.02
    said = re.search(r"and S by ([0-9.]+) %", told[0].what)
    assert said is not None
    assert 3.0 < 100.0 * (SURFACE / found.wetted_surface - 1.0) < float(said[1]) < 10.0


def test_perpendiculars_that_are_given_close_the_ends(tmp_path: Path) -> None:
    """What the suspicion says to do leads to the right volume, and no other doubt of the ends."""
    state, report = read((2.5, 97.5), tmp_path, draught=T, length=L, ap="0 m")
    kinds = {each.kind for each in report.verdict.suspicions}
    assert "open end" in kinds
    assert not kinds & {"aft perpendicular", "forward perpendicular"}
    volume = hydrostatics(Document(state), on_error="report").volume
    assert volume == pytest.approx(VOLUME, rel=5e-4)


def test_sections_that_end_in_the_centre_plane_leave_nothing_open(tmp_path: Path) -> None:
    """A section that is the stem, and one that is the stern, are no ends cut off."""
    _, report = read((0.0, L), tmp_path, draught=T, length=L)
    assert str(report.verdict) == "sound"
