"""Stability as files: read back they hold the numbers, names, units and the head."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest

from assoc_hull.analysis.hydrostatics.floating_body import Appendage
from assoc_hull.analysis.stability.condition import ConditionRequest
from assoc_hull.analysis.stability.cross_curves import CrossCurves, cross_curves_of
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.stability_report import Stability, stability_of
from assoc_hull.errors import BadInputError
from assoc_hull.io.tables.stability import (
    ENDINGS,
    stability_csv,
    stability_document,
    stability_text,
    stability_xlsx,
    write_stability,
)
from tests.floating_bodies import box_body, head


@pytest.fixture(scope="module")
def levers() -> Stability:
    """The box with an open deck, an appendage and an opening; 40 degrees drown its deck."""
    fin = Appendage("fin, port", 30.0, (50.0, 2.0, 1.0), 5.0)
    header = head(100.0, 20.0, 6.0, kg=5.0, deck="open", ship="=Ship,\n1", appendages=(fin,))
    point = FloodingPoint("hatch", (50.0, 8.0, 10.0))
    heels = np.array([-10.0, 0.0, 10.0, 40.0])
    return stability_of(
        box_body(closed=False),
        header,
        ConditionRequest(draught=6.0, kg=5.0),
        "fixed",
        heels,
        [point],
    )


@pytest.fixture(scope="module")
def curves() -> CrossCurves:
    """The open box at two draughts; the deeper one does not float at 25 degrees."""
    asked = [ConditionRequest(draughts=(t, t)) for t in (6.0, 8.0)]
    header = head(100.0, 20.0, 6.0, deck="open", date="2026-01-31")
    return cross_curves_of(box_body(False), header, asked, "fixed", np.array([10.0, 25.0]))


def parted(text: str) -> tuple[list[str], list[list[str]]]:
    """Head and rows of a CSV."""
    lines = text.splitlines()
    above = [line for line in lines if line.startswith("# ")]
    return above, list(csv.reader(io.StringIO("\n".join(lines[len(above) :]))))


def test_levers_read_back_from_csv(levers: Stability) -> None:
    """To twelve digits; where she does not float it is blank; the head says the deck is open."""
    above, (names, units, *rows) = parted(stability_csv(levers))
    assert names == ["heel_deg", "kn", "gz", "arm", "draught_aft", "draught_fore"]
    assert units == ["deg", "m", "m", "m rad", "m", "m"]
    numbers = np.array([[float(cell or "nan") for cell in row] for row in rows])
    for name, column in zip(names, numbers.T, strict=True):
        np.testing.assert_allclose(column, levers.columns[name], rtol=1e-11, atol=1e-15)
    assert rows[3][1:] == [""] * 5
    assert "# deck: open" in above
    assert "# ship: =Ship, 1" in above
    assert any(line.startswith("# appendage: fin, port: 30 m3") for line in above)
    assert any(line.startswith("# opening: hatch (50.0, 8.0, 10.0): goes under") for line in above)
    assert sum(line.startswith("# criterion: ") for line in above) == 7
    assert any("A 2.3" in line and "not evaluated" in line for line in above)


def test_cross_curves_read_back_from_csv(curves: CrossCurves) -> None:
    """A row per displacement, a column per heel."""
    above, (names, units, *rows) = parted(stability_csv(curves))
    assert names == ["displacement", "volume", "draught", "KN 10", "KN 25"]
    assert units == ["t", "m3", "m", "m", "m"]
    assert [float(row[3]) for row in rows] == pytest.approx(curves.kn[:, 0].tolist(), rel=1e-11)
    assert rows[1][4] == ""
    assert "# date: 2026-01-31" in above
    assert any("open" in line for line in above if line.startswith("# note"))


def test_workbooks_hold_the_same_numbers(levers: Stability, curves: CrossCurves) -> None:
    """Whole ones, under names and units; the name of the ship is no formula."""
    openpyxl = pytest.importorskip("openpyxl")
    for found in (levers, curves):
        sheet = openpyxl.load_workbook(io.BytesIO(stability_xlsx(found))).active
        rows = [[cell.value for cell in row] for row in sheet.iter_rows()]
        top = next(k for k, row in enumerate(rows) if not str(row[0]).startswith("# "))
        above, (names, units, *numbers) = parted(stability_csv(found))
        assert len(above) == top
        assert [rows[top], rows[top + 1]] == [names, units]
        for row, wanted in zip(rows[top + 2 :], numbers, strict=True):
            for cell, text in zip(row, wanted, strict=True):
                assert cell is None if text == "" else cell == pytest.approx(float(text), rel=1e-11)
        assert all(cell.data_type != "f" for row in sheet.iter_rows() for cell in row)


def test_documents_are_json(levers: Stability, curves: CrossCurves) -> None:
    """What is not there is null; criteria have margins."""
    document = json.loads(json.dumps(stability_document(levers), allow_nan=False))
    assert document["columns"]["gz"][3] is None
    assert document["columns"]["gz"][2] == levers.gz[2]
    assert document["criteria"][5]["margin"] == levers.criteria[5].margin
    assert document["header"]["appendages"][0]["name"] == "fin, port"
    kn = json.loads(json.dumps(stability_document(curves), allow_nan=False))["kn"]
    assert kn[1][1] is None
    assert kn[0] == curves.kn[0].tolist()


def test_words_have_every_row(levers: Stability, curves: CrossCurves) -> None:
    """Figures stand under their names; a dash where there is none."""
    lines = stability_text(levers).splitlines()
    assert lines[-1].split() == ["40.00", "-", "-", "-", "-", "-"]
    assert lines[-6].split() == [
        "heel_deg", "kn", "gz", "arm", "draught_aft", "draught_fore"
    ]  # fmt: skip
    assert stability_text(curves).splitlines()[-1].split()[-1] == "-"


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_same_result_gives_the_same_bytes(
    levers: Stability, curves: CrossCurves, tmp_path: Path, ending: str
) -> None:
    """In every form."""
    if ending == ".xlsx":
        pytest.importorskip("openpyxl")
    for found in (levers, curves):
        one, other = tmp_path / f"a{ending}", tmp_path / f"b{ending}"
        write_stability(found, one)
        write_stability(found, other)
        assert one.read_bytes() == other.read_bytes()


def test_another_ending_is_refused(levers: Stability, tmp_path: Path) -> None:
    """With those that are known."""
    with pytest.raises(BadInputError, match=r"\.txt, \.csv, \.xlsx, \.json"):
        write_stability(levers, tmp_path / "a.doc")
