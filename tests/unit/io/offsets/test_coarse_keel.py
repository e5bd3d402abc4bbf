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
