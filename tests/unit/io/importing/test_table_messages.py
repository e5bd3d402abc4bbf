"""What an import of a table says names the cause, the option and numbers as they are printed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.io.offsets.hints import read_hints
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.io.placing.frame import _other_unit
from assoc_hull.shipped.wigley import wigley_half_breadth

Z = np.linspace(0.0, 6.25, 6)


def rows(x: list[float]) -> list[list[float]]:
    """Half-breadths, m, of Wigley's hull at some x."""
    return [wigley_half_breadth(np.full(6, a), Z, 100.0, 10.0, 6.25).tolist() for a in x]


def test_one_column_is_named_for_a_table_alone() -> None:
    """A mesh has none."""
    assert _other_unit(100.0 / 0.0254, 100.0, "in the mesh").endswith("give unit='in'; else ")
    assert "name its column 'x_in'" in _other_unit(100.0 / 0.0254, 100.0, "in the table")


@pytest.mark.parametrize(("comment", "unit"), [("inches", "in"), ("mm", "mm"), ("inch model", "")])
def test_a_comment_that_is_a_unit_is_one(comment: str, unit: str) -> None:
    """It was ignored."""
    assert (read_hints((comment,)).units.y or "") == unit


def test_a_blank_cell_is_the_first_fault(tmp_path: Path) -> None:
    """Amidships it opens the section, and the open section was told as the fault alone."""
    x = np.linspace(0.0, 100.0, 11).tolist()
    text = ["# m, x from AP", "x_m," + ",".join(f"wl_{z:g}" for z in Z)]
    for a, y in zip(x, rows(x), strict=True):
        cells = ["" if a == 50.0 and j == 3 else f"{b:.4f}" for j, b in enumerate(y)]
        text.append(",".join([f"{a:g}", *cells]))
    path = tmp_path / "blank.csv"
    path.write_text("\n".join(text) + "\n")
    with pytest.raises(ah.errors.NotSoundError) as caught:
        ah.read(path, length=100, draught=6.25)
    first = caught.value.findings[0]
    assert first == "blank: station 50, waterline 3.75: blank between numbers: fill the cell"


def test_numbers_of_frames_name_their_options() -> None:
    """`frame_spacing=` or `station_spacings=` read them."""
    text = ["Frame," + ",".join(f"{z:g}" for z in Z)]
    x = np.linspace(0.0, 100.0, 11).tolist()
    text += [f"{20 * k}," + ",".join(map(str, y)) for k, y in enumerate(rows(x))]
    whole = "\n".join(text) + "\n"
    with pytest.raises(ah.errors.BadInputError, match="frame_spacing="):
        read_offsets(whole, length=100.0)
    with pytest.raises(ah.errors.BadInputError, match=r"station_spacings=.*frame_spacing="):
        read_offsets(whole, length=100.0, station_zero="ap")


def test_feet_are_told_as_they_are_printed() -> None:
    """14-0-2 was told as 14.0208."""
    text = ["# station 0 = AP", "station," + ",".join(f"WL {k} ft" for k in range(0, 24, 4))]
    x = np.linspace(0.0, 100.0, 11).tolist()
    for k, y in enumerate(rows(x)):
        inches = [round(b / 0.0254 * 8) + (96 * 3 if (k, j) == (4, 3) else 0)
                  for j, b in enumerate(y)]  # fmt: skip
        text.append(f"{k}," + ",".join(f"{e // 96}-{e % 96 // 8}-{e % 8}" for e in inches))
    report = read_offsets("\n".join(text) + "\n", length=100.0)[1]
    [note] = [each for each in report.suspicions if each.kind == "outlier"]
    cell = text[6].split(",")[4]
    assert f"(printed {cell})" in note.what
