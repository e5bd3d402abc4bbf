"""The template of a table, filled in as a user does, comes in with the right volume."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.shipped.wigley import wigley_half_breadth

LENGTH, BREADTH, DRAUGHT = 100.0, 10.0, 6.25
TRUTH = 4.0 / 9.0 * LENGTH * BREADTH * DRAUGHT


def filled(template: str, unit: str, times: float, *, from_fp: bool) -> str:
    """Write the Wigley hull over the numbers of the template, and over what its comments say."""
    facts = {
        r"unit: m$": f"unit: {unit}",
        r"station 0 = AP, 20 = FP": "station 0 = FP, 20 = AP" if from_fp else "station 0 = AP",
        r"Lpp = .*": f"Lpp = {LENGTH:g} m", r"B = .*": f"B = {BREADTH:g} m",
        r"T = .*": f"T = {DRAUGHT:g} m",
    }  # fmt: skip
    for said, mine in facts.items():
        template, count = re.subn(rf"^# {said}", f"# {mine}", template, flags=re.MULTILINE)
        assert count == 1, said
    comments = [line for line in template.splitlines() if line.startswith("#")]
    z = np.linspace(0.0, DRAUGHT, 9)
    heads = ["station", *(f"wl_{times * each:.10g}" for each in z)]
    rows = []
    for k in range(21):
        x = LENGTH / 20.0 * (20 - k if from_fp else k)
        y = wigley_half_breadth(np.full(9, x), z, LENGTH, BREADTH, DRAUGHT)
        rows.append(",".join([str(k), *(f"{times * each:.5g}" for each in y)]))
    return "\n".join([*comments, ",".join(heads), *rows]) + "\n"


@pytest.mark.parametrize(
    ("unit", "times", "from_fp"),
    [("m", 1.0, False), ("mm", 1000.0, True), ("ft", 1.0 / 0.3048, False)],
)
def test_a_filled_template_is_the_hull(
    unit: str, times: float, from_fp: bool, tmp_path: Path
) -> None:
    """In metres, millimetres and feet, from either end: sound, V and LCB as of the formula."""
    path = tmp_path / "table.csv"
    assert main(["import", "--template", str(path)]) == 0
    path.write_text(filled(path.read_text("utf-8"), unit, times, from_fp=from_fp))
    assert main(["import", str(path), "-o", str(tmp_path / "ship.hull")]) == 0
    found = ah.open(tmp_path / "ship.hull").hydrostatics()
    assert found.volume == pytest.approx(TRUTH, rel=2e-3)
    assert found.lcb == pytest.approx(0.5 * LENGTH, abs=0.02)
    hull = ah.read(path)
    assert hull.adoption is not None
    assert "verdict: sound" in hull.adoption.notes


def test_the_template_imports_as_it_stands(tmp_path: Path) -> None:
    """Series 60, CB .70: what the template says of itself holds."""
    path = tmp_path / "table.csv"
    assert main(["import", "--template", str(path)]) == 0
    hull = ah.read(path)
    assert hull.adoption is not None
    assert "verdict: sound" in hull.adoption.notes
    assert hull.hydrostatics().cb == pytest.approx(0.70, abs=0.003)
