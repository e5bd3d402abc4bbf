"""Tables of one of two hulls, counted from the ship's centre plane: refused, told, and read."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.shipped.wigley import wigley_half_breadth

_X, _Z = np.linspace(0.0, 100.0, 21), np.linspace(0.0, 6.25, 11)


def table(path: Path, off: float, factor: float = 1.0, deck: bool = False) -> Path:
    """A Wigley demihull, its half-breadths counted from `off` m beside its centre plane."""
    head = "station," + ",".join(f"wl_{each:g}" for each in _Z) + (",z_deck,y_deck" if deck else "")
    rows = ["# station 0 = AP, Lpp = 100, T = 5", head]
    for i, place in enumerate(_X.tolist()):
        y = factor * (off + wigley_half_breadth(np.full(11, place), _Z, 100.0, 10.0, 6.25))
        cells = [f"{each:.5f}" for each in y]
        cells += ["7", cells[-1]] if deck else []
        rows.append(",".join([f"{i}", *cells]))
    path.write_text("\n".join(rows) + "\n")
    return path


@pytest.mark.parametrize("deck", [False, True], ids=["bare", "with a deck edge"])
def test_the_remedy_for_a_table_of_two_hulls_leads_to_one(tmp_path: Path, deck: bool) -> None:
    """The centre plane is proposed; with it the table is that of the demihull."""
    path = table(tmp_path / "two.csv", 8.0, deck=deck)
    with pytest.raises(BadInputError, match=r"there are two hulls side by side") as refused:
        ah.read(path)
    found = re.search(r"centre=([0-9.]+)", str(refused.value))
    assert found is not None
    assert float(found[1]) == 8.0
    hull = ah.read(path, centre=float(found[1]))
    alone = ah.read(table(tmp_path / "one.csv", 0.0, deck=deck))
    assert hull.hydrostatics().volume == pytest.approx(alone.hydrostatics().volume, rel=1e-6)
    assert hull.particulars.breadth == pytest.approx(alone.particulars.breadth, rel=1e-6)
    assert hull.adoption is not None
    assert any("one hull: the table: half-breadths are counted" in n for n in hull.adoption.notes)


def test_the_centre_of_a_table_is_in_the_unit_of_its_half_breadths(tmp_path: Path) -> None:
    """8000 of a table in mm; a centre with a unit is asked for again."""
    path = table(tmp_path / "mm.csv", 8.0, factor=1000.0)
    with pytest.raises(BadInputError, match=r"centre=8000;"):
        ah.read(path, unit="mm,m")
    hull = ah.read(path, unit="mm,m", centre=8000)
    assert hull.hydrostatics().volume == pytest.approx(1955.0, rel=2e-3)
    with pytest.raises(BadInputError, match="in the unit of its half-breadths"):
        ah.read(path, unit="mm,m", centre="8 m")


def test_a_centre_outside_of_half_breadths_is_refused_with_the_cell(tmp_path: Path) -> None:
    """A metre too far out."""
    path = table(tmp_path / "off.csv", 8.0)
    with pytest.raises(BadInputError, match=r"8 lies inside centre=9, .*station 0, column 'wl_0'"):
        ah.read(path, centre=9.0)


def test_a_hull_with_blunt_ends_is_no_demihull(tmp_path: Path) -> None:
    """A barge is as broad at its ends as anywhere; a ship with a transom differs at her bow."""
    barge = tmp_path / "barge.csv"
    rows = [f"{i}," + ",".join(["4.5", *["5"] * 10]) for i in range(21)]
    head = "# station 0 = AP, Lpp = 100, T = 5\nstation," + ",".join(f"wl_{z:g}" for z in _Z)
    barge.write_text(head + "\n" + "\n".join(rows) + "\n")
    with pytest.raises(ah.errors.AssocHullError) as refused:
        ah.read(barge, strict=True)
    assert "two hulls" not in str(refused.value)
    path = table(tmp_path / "transom.csv", 0.0)
    kept = [row for row in path.read_text().splitlines() if not row.startswith(("0,", "1,", "2,"))]
    path.write_text("\n".join(kept) + "\n")
    assert ah.read(path, accept=True).hydrostatics(on_error="report").volume > 1800.0
