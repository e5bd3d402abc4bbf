"""Lines of a table run straight where it prints one greatest offset again and again."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.hull import Hull

UNIT = 0.01
LEVELS = np.array([0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0])


def ship(*, barrel: bool = False) -> str:
    """A hull of 100 m with flat of side from 2.2 m up, or a barrel broadest at 4.4 m; to 1 cm."""
    rows = []
    for k, x in enumerate(np.linspace(0.0, 100.0, 21)):
        fullness = np.clip((1.0 - abs(x - 50.0) / 50.0) / 0.35, 0.0, 1.0)
        bilge = 1.0 - (1.0 - np.clip(LEVELS / 2.2, 0.0, 1.0)) ** 2
        y = 8.0 * (1.0 - (1.0 - fullness) ** 2) * (0.35 + 0.65 * bilge)
        if barrel:
            y = 8.0 * fullness * (1.0 - ((LEVELS - 4.4) / 4.4) ** 2).clip(0.0)
        rows.append(f"{k}," + ",".join(f"{each:.2f}" for each in y))
    head = "station," + ",".join(f"wl_{z:g}" for z in LEVELS)
    return "\n".join(["# 0 = AP", "# Lpp = 100 m, B = 16 m, T = 6 m", head, *rows]) + "\n"


def most_over(hull: Hull) -> float:
    """By how much (m) a section or waterline passes the greatest of its own points."""
    every = [
        float(curve.polyline(48)[:, 1].max() - max(point.position[1] for point in curve.points))
        for group in ("sections", "waterlines")
        for line in hull.groups[group].lines.values() for curve in line.curves
    ]  # fmt: skip
    return max(every)


def test_lines_run_straight_between_equal_greatest_offsets(tmp_path: Path) -> None:
    """Neighbours equal to B/2, or to one another: nothing passes them by more than a digit."""
    path = tmp_path / "ship.csv"
    path.write_text(ship())
    hull = ah.read(path)
    assert hull.adoption is not None
    assert "verdict: sound" in hull.adoption.notes
    assert most_over(hull) <= 0.1 * UNIT
    assert not [note for note in hull.adoption.notes if note.startswith("broader")]
    # Straight, too, between the greatest offsets; a section onto the side ends tangent there.
    [section] = hull.groups["sections"].lines["ST 2"].curves
    side = section.polyline(48)
    high = side[side[:, 2] > 3.0]
    assert np.ptp(high[:, 1]) <= 0.1 * UNIT


def test_a_line_that_passes_unequal_offsets_is_told_with_its_place(tmp_path: Path) -> None:
    """Broadest at 4.4 m between offsets at 4 and 5 m: told in mm with the place, never clamped."""
    path = tmp_path / "ship.csv"
    path.write_text(ship(barrel=True))
    hull = ah.read(path, accept=True)
    assert hull.adoption is not None
    over = most_over(hull)
    assert over == pytest.approx(8.0 * (0.4 / 4.4) ** 2, abs=0.03)
    [note] = [each for each in hull.adoption.notes if each.startswith("broader between")]
    told = re.search(
        r"(ST [\d.]+) by ([\d.]+) mm over [\d.]+ m, at \([\d.]+, [\d.]+, (4\.\d+)\) m", note
    )
    assert told is not None
    assert float(told[2]) == pytest.approx(1e3 * over, abs=1.0)
    assert float(told[3]) == pytest.approx(4.4, abs=0.1)


@pytest.mark.parametrize("sheer", [False, True])
def test_a_deck_edge_runs_straight_in_plan_along_its_greatest_breadth(
    tmp_path: Path, sheer: bool
) -> None:
    """Also with sheer, and where no flat can be closed: B of the lines is B of the ship."""
    path, rows = tmp_path / "ship.csv", ship().splitlines()
    head, body = rows[:3], rows[3:]
    head[2] += ",keel,sheer,y_deck" if sheer else ",keel"
    for k, row in enumerate(body):
        deck = f",{9.0 + 0.02 * (k - 10) ** 2:.2f},{row.split(',')[-1]}" if sheer else ""
        body[k] = f"{row},{0.3 if k in (0, 20) else 0.0}{deck}"  # a keel that rises: no flats
    path.write_text("\n".join([*head, *body]) + "\n")
    hull = ah.read(path)
    [edge] = hull.lines["deck edge"].curves
    drawn = edge.polyline(48)
    assert np.ptp(drawn[:, 2]) == pytest.approx(2.0 if sheer else 0.0, abs=1e-6)
    assert drawn[:, 1].max() <= 8.0 + 0.1 * UNIT
    middle = drawn[abs(drawn[:, 0] - 50.0) < 20.0]
    assert np.ptp(middle[:, 1]) <= 0.1 * UNIT
    assert hull.adoption is not None
    assert not [note for note in hull.adoption.notes if note.startswith("broader")]
