"""Lines of a table have the names that the table has for them."""

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah

LEVELS = (0.0, 0.8, 1.6, 2.4, 3.2)


def read(folder: Path, first: str, head: str, top: str = "") -> ah.Hull:
    """A hull of 40 m, B 8 m, T 3.2 m: 21 stations, their first column as given."""
    rows = []
    for k, x in enumerate(np.linspace(0.0, 40.0, 21)):
        fullness = 1.0 - ((x - 20.0) / 20.0) ** 2
        y = [4.0 * fullness * (1.0 - (1.0 - 0.25 * j) ** 2) for j in range(len(LEVELS))]
        y = y if top else [0.4 * fullness, *y[1:]]
        place = {"number": f"{k}", "x": f"{x:g}"}[first]
        rows.append(f"{place}," + ",".join(f"{each:.3f}" for each in y))
    path = folder / "ship.csv"
    path.write_text("\n".join(["# Lpp = 40 m, B = 8 m, T = 3.2 m", top, head, *rows]) + "\n")
    return ah.read(path, accept=True, draught=3.2)


def names(hull: ah.Hull, group: str) -> set[str]:
    """Give the names of the lines of a group."""
    return set(hull.groups[group].lines)


@pytest.mark.parametrize("zero", ["FP", "AP"])
def test_sections_have_the_numbers_that_the_table_prints(tmp_path: Path, zero: str) -> None:
    """From whichever end it counts, and whether its ends can be closed or not."""
    head = "station," + ",".join(f"wl_{z:g}" for z in LEVELS)
    hull = read(tmp_path, "number", head, f"# station 0 = {zero}")
    place = hull.groups["sections"].lines["ST 16"].curves[0].points[0].position[0]
    assert place == pytest.approx(32.0 if zero == "AP" else 8.0)
    assert {"WL 0.8", "WL 1.6", "WL 2.4"} <= names(hull, "waterlines")
    with hull.edit("between two of them") as edit:
        edit.add_line("sections", 9.0)
    assert ("ST 4.5" if zero == "AP" else "ST 15.5") in names(hull, "sections")


def test_sections_by_place_are_named_by_it(tmp_path: Path) -> None:
    """Metres from AP, also where the rules for ends close the hull."""
    head = "x," + ",".join(f"wl_{z:g}" for z in LEVELS)
    hull = read(tmp_path, "x", head)
    assert "ST 32" in names(hull, "sections")
    assert "ST 16" in names(hull, "sections")
    assert hull.groups["sections"].lines["ST 16"].curves[0].points[0].position[0] == pytest.approx(
        16.0
    )


def test_waterlines_in_draughts_keep_their_parts(tmp_path: Path) -> None:
    """A table of z/T speaks of WL 0.5, and so does the hull."""
    head = "station," + ",".join(f"wl_{z / 3.2:g}" for z in LEVELS)
    hull = read(tmp_path, "number", head, "# station 0 = AP, waterlines z/T")
    assert {"WL 0.25", "WL 0.5", "WL 0.75"} <= names(hull, "waterlines")
    with hull.edit("between two of them") as edit:
        edit.add_line("waterlines", 2.0)
    assert "WL 0.625" in names(hull, "waterlines")
