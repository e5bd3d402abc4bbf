"""Heights of a keel too far apart to tell the profile: told, with what S may lack."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.shipped.wigley import wigley_half_breadth


def notes_of(path: Path, foot: float) -> list[str]:
    """Read a hull whose keel is level to the last station but one, `foot` m high at the last."""
    x, z = np.linspace(0.0, 100.0, 21), np.linspace(0.0, 6.0, 7)
    rows = ["# Lpp = 100, T = 5", "x_m,z_keel," + ",".join(f"wl_{each:g}" for each in z)]
    for place in x.tolist():
        y = wigley_half_breadth(np.full(7, 0.98 * place), z, 100.0, 10.0, 6.0)
        keel = foot if place == 100.0 else 0.0
        cells = [f"{v:.5f}" if h >= keel else "" for v, h in zip(y, z, strict=True)]
        rows.append(",".join([f"{place:g}", f"{keel:g}", *cells]))
    path.write_text("\n".join(rows) + "\n")
    hull = ah.read(path, accept=True, origin="ap")
    assert hull.adoption is not None
    return [note for note in hull.adoption.notes if "the keel rises by" in note]


@pytest.mark.parametrize(("foot", "told"), [(4.0, True), (1.0, False)])
def test_a_keel_that_rises_between_two_stations_is_told(
    tmp_path: Path, foot: float, told: bool
) -> None:
    """By four fifths of the draught, over 5 m: 20 m2 on both sides; by a fifth it is no matter."""
    notes = notes_of(tmp_path / "keel.csv", foot)
    assert len(notes) == told
    if told:
        assert "between x = 95 and 100 m the keel rises by 4 m" in notes[0]
        assert "S may lack up to 20 m2" in notes[0]


def test_why_ends_are_left_open_is_told_in_lengths_of_the_ship(tmp_path: Path) -> None:
    """A hull of 62 m whose bottom rises aft, and no height of the keel: the place is hers."""
    rows = [
        "# Lpp = 62, T = 5, unit: m, station 0 = AP, 10 = FP", "station,0,0.5,1,2,3,4,5,6.8",
        "0,0,0,0,0,0,3.93,5.825,6.95", "1,0,0,0,0,6.232,7.039,7.382,7.434",
        "2,0,0,5.599,7.108,7.569,7.636,7.636,7.636",
        "3,0,6.908,7.399,7.735,7.737,7.737,7.737,7.737",
        *(f"{i},6.15,7.312,7.633,7.75,7.75,7.75,7.75,7.75" for i in (4, 5, 6)),
        "7,5.142,6.599,7.105,7.533,7.61,7.66,7.692,7.725",
        "8,2.49,4.38,5.173,6.142,6.624,6.879,7.084,7.349",
        "9,0.12,1.656,2.315,3.279,4.03,4.669,5.15,5.887", "10,0,0,0,0,0,0,0,1.696",
    ]  # fmt: skip
    path = tmp_path / "supply.csv"
    path.write_text("\n".join(rows) + "\n")
    hull = ah.read(path, accept=True)
    assert hull.adoption is not None
    note = next(each for each in hull.adoption.notes if "are left open" in each)
    assert "the station at x = 12.4 m has its lowest half-breadth at 1 m" in note
    assert note.endswith("or give a column keel")
