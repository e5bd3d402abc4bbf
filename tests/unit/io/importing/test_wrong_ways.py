"""Files that are read the wrong way round, or in another unit, are told: each had been sound."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.io.mesh.frame import place_mesh
from assoc_hull.io.placing.options import FrameOptions
from assoc_hull.io.reports import Notebook
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from assoc_hull.io.units import METRES
from tests import meshes

X, Z = np.linspace(0.0, 100.0, 11), np.linspace(0.0, 7.0, 8)


def table(
    path: Path, *, comment: str = "", z_unit: str = "", scale: float = 1.0, x_unit: str = "",
    copied: int | None = None,
) -> Path:  # fmt: skip
    """A ship's table of half-breadths in metres times a scale; heights in metres, or in feet.

    Stations are numbers, or x in a unit; `copied` is the waterline that the next one is a copy of.
    """
    foot = 0.3048 if z_unit else 1.0
    heads = ",".join(f"WL {z / foot:.4f} {z_unit}".strip() for z in Z)
    rows = [comment, f"{f'x_{x_unit}' if x_unit else 'station'},{heads}"]
    for i, x in enumerate(X):
        half = 7.0 * (1.0 - (abs(x - 50.0) / 50.0) ** 3) * (1.0 - (1.0 - Z / 7.0) ** 2)
        if copied is not None:
            half[copied + 1] = half[copied]
        place = f"{x / METRES[x_unit]:.4f}" if x_unit else f"{i}"
        rows.append(f"{place}," + ",".join(f"{scale * y:.4f}" for y in half))
    path.write_text("\n".join(row for row in rows if row) + "\n")
    return path


def suspicions(path: Path, **options: object) -> str:
    """What an import suspects, one a line."""
    hull = ah.read(path, accept=True, **{"station_zero": "ap", **options})  # type: ignore[arg-type]
    assert hull.adoption is not None
    return "\n".join(note for note in hull.adoption.notes if note.startswith("suspicion"))


def test_a_table_of_full_breadths_is_told(tmp_path: Path) -> None:
    """The comments say so; a beam in numbers is no such word."""
    full = table(tmp_path / "a.csv", comment="# full breadths, m", scale=2.0)
    assert "half-breadths are read: give half of each" in suspicions(full, length=100, draught=5)
    plain = table(tmp_path / "b.csv", comment="# total beam: 14.0 m")
    assert "full" not in suspicions(plain, length=100, draught=5)


def test_heights_in_feet_beside_half_breadths_of_no_unit_are_told(tmp_path: Path) -> None:
    """The unit of the heights is no evidence for metres; what is advised settles it."""
    path = table(tmp_path / "a.csv", z_unit="ft", scale=1.0 / 0.3048)
    told = suspicions(path, length=100, draught=5)
    assert "give unit='ft', or unit='m,ft' if it is so" in told
    right = ah.read(path, length=100, draught=5, unit="ft", station_zero="ap")
    assert right.particulars.breadth == pytest.approx(14.0 * (1.0 - (2.0 / 7.0) ** 2), rel=1e-3)


def test_x_in_feet_beside_half_breadths_of_no_unit_is_told(tmp_path: Path) -> None:
    """As much as feet read as metres; what is advised settles it, for all or for x alone."""
    feet = table(tmp_path / "a.csv", x_unit="ft", scale=1.0 / 0.3048)
    given: dict[str, Any] = {"length": 100, "draught": 5, "station_zero": "auto"}
    for unit in ("auto", "m"):
        told = suspicions(feet, **given, unit=unit)
        assert "x is in ft by the name of its column" in told
        assert "give unit='ft', or unit='m,m,ft' if it is so" in told
    mixed = table(tmp_path / "b.csv", x_unit="ft")
    assert "x is in ft" not in suspicions(mixed, **given, unit="m,m,ft")


def test_a_fine_ship_that_is_very_broad_is_told(tmp_path: Path) -> None:
    """Full breadths without a word, or feet read as metres, make her so."""
    full = table(tmp_path / "a.csv", scale=2.0)
    told = suspicions(full, length=100, draught=5)
    assert "L/B is 3.89, B/T 5.14 and CB" in told
    assert "are the half-breadths full breadths" in told
    assert "full breadths" not in suspicions(table(tmp_path / "b.csv"), length=100, draught=5)


def test_a_waterline_that_is_a_copy_of_the_next_is_told(tmp_path: Path) -> None:
    """Not so of a hull whose sides are upright from there up."""
    copied = table(tmp_path / "a.csv", copied=3)
    told = suspicions(copied, length=100, draught=5)
    assert (
        "doubled waterline: waterlines at 3 and 4 m: all their half-breadths are the same" in told
    )
    assert "doubled" not in suspicions(table(tmp_path / "b.csv"), length=100, draught=5)


def test_a_breadth_of_four_digits_fits_its_table(tmp_path: Path) -> None:
    """B/2 of few digits may lie below the largest half-breadth by a thousandth."""
    path = table(tmp_path / "a.csv")
    hull = ah.read(path, length=100, draught=5, breadth=13.995, station_zero="ap")
    assert hull.particulars.breadth == 13.995


def test_a_depth_far_below_the_deck_is_told(tmp_path: Path) -> None:
    """Heights in feet read as metres rise to three depths amidships."""
    path = table(tmp_path / "a.csv")
    assert "to which the hull rises amidships" in suspicions(path, length=100, draught=2, depth=2.2)
    assert "rises amidships" not in suspicions(path, length=100, draught=5, depth=6.5)


def test_axes_that_put_the_stern_forward_are_told() -> None:
    """A hull that is 3 m broad at one end near the deck has her stern there, whatever axes say."""

    def broad_aft(xyz: np.ndarray) -> np.ndarray:
        x, y, z = xyz.T
        return np.column_stack([x, y + 1.5 * (1.0 - x / 100.0) ** 2 * z / 6.25, z])

    ship = meshes.mirrored(meshes.moved(meshes.wigley_half(41, 11), broad_aft))
    for axes, told in (("+x+y+z", False), ("-x-y+z", True)):
        book = Notebook()
        place_mesh(ship, axes, book)
        assert [note.kind == "bow" for note in book.report().suspicions] == [True] * told


def test_axes_may_begin_with_a_minus(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a suspicion advises can be typed: it is no option of its own."""
    assert main(["import", str(tmp_path / "none.stl"), "--axes", "-x-y+z", "-o", "a.hull"]) == 2
    assert "none.stl" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("degrees", "options", "told"),
    [
        (1.0, {"draught": 5.0}, "the keel is straight and lies 1 degrees deeper by the bow"),
        (-0.3, {"draught": 5.0}, "the keel is straight and lies 0.3 degrees deeper by the stern"),
        (1.0, {"draught_aft": 4.2, "draught_fwd": 5.8}, ""),
        (0.0, {"draught": 5.0}, ""),
    ],
    ids=["by the bow", "by the stern", "trim given", "level"],
)
def test_a_mesh_that_lies_trimmed_is_told(
    degrees: float, options: dict[str, Any], told: str
) -> None:
    """A straight keel that is not level may be raked, or the hull may lie as it floats."""
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    turn = np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])
    mesh = meshes.moved(meshes.closed_wigley(), lambda xyz: xyz @ turn)
    frame = FrameOptions(length=100.0, **options)
    cuts = {"stations": [25.0, 50.0], "waterlines": [2.0], "buttocks": [2.0]}
    report = slice_mesh(mesh, **cuts, frame=frame).report  # type: ignore[arg-type]
    said = [note.what for note in report.suspicions if note.kind == "trim"]
    assert [each.partition(":")[0] for each in said] == [told][: len(told)]
