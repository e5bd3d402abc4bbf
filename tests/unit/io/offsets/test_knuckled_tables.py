"""Tables of hulls with hard knuckles: built as they are, or told; none folds by itself."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.io.offsets.complete_table import net_from_table
from assoc_hull.io.offsets.knuckles import knuckles_of_table
from assoc_hull.io.offsets.net import lines_of_table
from assoc_hull.io.offsets.read import read_offsets
from assoc_hull.model.line_source import LineSource

LENGTH, DRAUGHT = 60.0, 3.0
CHAMFER = np.array([[0.0, 0.0], [4.0, 0.0], [5.5, 1.2], [5.5, 5.0]])
"""Half-breadth and height (m) of corners amidships: a flat bottom and a bilge cut off."""
KNUCKLED = np.array([[0.0, 0.0], [4.0, 0.4], [5.3, 1.6], [5.5, 5.0]])
"""A rise of floor, a straight bilge and a flared side."""


def fullness(x: float) -> float:
    """Part of the midship breadth at x (m): a parallel body from 22 to 34 m."""
    fore, aft = np.clip([(LENGTH - x) / 26.0, x / 22.0], 0.0, 1.0)
    return float(min(1.0 - (1.0 - fore) ** 2, 1.0 - (1.0 - aft) ** 2.5))


def table(corners: FloatArray, levels: Sequence[float], stations: int = 21) -> str:
    """Write stations of a hull of straight sides between corners (n, 2), m, to the mm."""
    first = int(np.flatnonzero(corners[:, 1] == 0.0)[-1])
    across = np.interp(levels, corners[first:, 1], corners[first:, 0])
    rows = ["x_m," + ",".join(f"wl_{z:g}" for z in levels)]
    rows += [
        f"{x:g}," + ",".join(f"{fullness(x) * y:.3f}" for y in across)
        for x in np.linspace(0.0, LENGTH, stations).tolist()
    ]
    return "\n".join(["# x from AP, half-breadths and heights in m", *rows]) + "\n"


def volume(corners: FloatArray) -> float:
    """Give the volume (m3) below the draught."""
    first = int(np.flatnonzero(corners[:, 1] == 0.0)[-1])
    y, z = corners[first:].T
    height = np.linspace(0.0, DRAUGHT, 30001)
    area = 2.0 * np.trapezoid(np.interp(height, z, y), height)
    x = np.linspace(0.0, LENGTH, 6001)
    return float(area * np.trapezoid([fullness(each) for each in x.tolist()], x))


def section_lines(text: str) -> dict[float, LineSource]:
    """Give the sections of a table by place."""
    lines = lines_of_table(read_offsets(text, length=LENGTH, draught=DRAUGHT)[0])
    return {each.offset: each for each in lines if each.group == "sections"}


def test_a_level_flat_of_side_does_not_sink_between_its_corners() -> None:
    """Identical stations of a parallel body make identical sections, none of them folded."""
    text = table(CHAMFER, [0.0, 0.4, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0])
    state = net_from_table(read_offsets(text, length=LENGTH, draught=DRAUGHT)[0], imported=True)[0]
    sections = {
        str(state.lines.name.data[state.line_of(curve)]): sample(state.spline(curve), 16)[1][:, 1:]
        for curve in state.live("curves").tolist()
    }
    assert sections["ST 33"] == pytest.approx(sections["ST 30"], abs=1e-4)
    assert sections["ST 33"][:, 1].min() >= -1e-9


@pytest.mark.parametrize(
    ("corners", "levels", "heights"),
    [
        (KNUCKLED, [0.0, 0.2, 0.4, 0.8, 1.2, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0], ("0.4", "1.6")),
        (CHAMFER, [0.0, 0.3, 0.6, 0.9, 1.2, 1.6, 2.0, 2.5, 3.0, 4.0, 5.0], ("0", "1.2")),
    ],
)
def test_knuckles_on_waterlines_are_found_and_told(
    corners: FloatArray, levels: list[float], heights: tuple[str, str], tmp_path: Path
) -> None:
    """They cost 1.1 % of V and 1.5 % of S in silence."""
    path = tmp_path / "knuckled.csv"
    path.write_text(table(corners, levels, 13))
    hull = ah.read(path, length=LENGTH, draught=DRAUGHT)
    assert hull.adoption is not None
    told = [each for each in hull.adoption.notes if each.startswith("assumed: knuckle")]
    assert len(told) == 2
    for note, height in zip(told, heights, strict=True):
        assert f"a knuckle at z = {height} m, at 11 stations from x = 5 to 55 m" in note
    assert float(hull.hydrostatics().volume) == pytest.approx(volume(corners), rel=1.5e-3)


def test_a_swing_that_no_knuckle_explains_is_suspected(tmp_path: Path) -> None:
    """A last digit off the straight line hides the knuckle; the sections swing, and it is told."""
    path = tmp_path / "knuckled.csv"
    levels = [0.0, 0.2, 0.4, 0.8, 1.2, 1.6, 2.5, 4.0, 5.0]
    lines = table(KNUCKLED, levels, 13).splitlines()
    cells = [line.split(",") for line in lines[2:]]
    for row in cells:
        row[2] = f"{0.99 * float(row[2]):.3f}"
        row[4] = f"{1.01 * float(row[4]):.3f}"
    path.write_text("\n".join([*lines[:2], *map(",".join, cells)]) + "\n")
    hull = ah.read(path, length=LENGTH, draught=DRAUGHT)
    assert hull.adoption is not None
    told = [each for each in hull.adoption.notes if each.startswith("suspicion: overshoot")]
    assert told
    assert "between the given heights 1.6 and 2.5 m" in told[0]
    assert "give more waterlines there" in told[0]
    assert "mm out" in told[0]


def test_a_round_bilge_is_no_knuckle() -> None:
    """Coarse offsets of a bilge of 1.2 m radius between a straight floor and an upright side."""
    levels = np.array([0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 3.0, 4.0, 5.0])
    for radius in (0.6, 1.2, 2.0):
        turn = np.linspace(0.0, 0.5 * np.pi, 40)
        arc = np.column_stack([5.5 - radius + radius * np.sin(turn), radius * (1 - np.cos(turn))])
        corners = np.vstack([[0.0, 0.0], arc, [5.5, 5.0]])
        found = read_offsets(table(corners, levels.tolist()), length=LENGTH, draught=DRAUGHT)[0]
        assert not knuckles_of_table(found).any()


def test_the_side_over_a_knuckle_is_not_entered_tangent() -> None:
    """A chine below an upright side is a corner at its own height."""
    chine = np.array([[0.0, 0.0], [5.5, 1.6], [5.5, 5.0]])
    line = section_lines(table(chine, [0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 3.0, 4.0, 5.0]))[30.0]
    assert line.points[:, 2].tolist() == [0.0, 0.4, 0.8, 1.2, 1.6, 2.0, 3.0, 4.0, 5.0]
    assert np.flatnonzero(line.kind == PointKind.KNUCKLE).tolist() == [4]
