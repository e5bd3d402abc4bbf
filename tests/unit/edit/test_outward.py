"""Normals point out of the hull wherever a point lies and whichever way its curves are stored."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.hull_normals import hull_normals
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.line_source import LineSource
from assoc_hull.shipped.wigley import wigley
from tests.cases.valley import BREADTH, DEPTH, LENGTH, breadth_at, valley_hull

STEP = 1e-6


def _outward(xyz: FloatArray) -> FloatArray:
    """The gradient of y - b(x, z), unit, by central differences."""
    x, z = xyz[:, 0], xyz[:, 2]
    slope_x = (breadth_at(x + STEP, z) - breadth_at(x - STEP, z)) / (2 * STEP)
    slope_z = (breadth_at(x, z + STEP) - breadth_at(x, z - STEP)) / (2 * STEP)
    normal = np.column_stack([-slope_x, np.ones(len(x)), -slope_z])
    return np.asarray(normal / np.linalg.norm(normal, axis=1)[:, None])


def _inner(hull: ah.Hull) -> np.typing.NDArray[np.int64]:
    rows, xyz = hull.state.live("rows"), hull.state.rows.xyz.data
    x, z = xyz[rows, 0], xyz[rows, 2]
    inside = (x > 1.0) & (x < LENGTH - 1.0) & (z > 0.5) & (z < DEPTH - 0.5) & (xyz[rows, 1] > 0.1)
    return np.asarray(rows[inside])


def test_normals_are_those_of_the_formula() -> None:
    """Within what a spline through 19 sections leaves: 3 degrees."""
    hull = valley_hull()
    rows = _inner(hull)
    cosine = (hull_normals(hull.state)[rows] * _outward(hull.state.rows.xyz[rows])).sum(axis=1)
    assert len(rows) > 100
    assert cosine.min() > np.cos(np.radians(3.0))


def hollow(*, turned: bool) -> ah.Hull:
    """A hull whose aft sections are thin and hollow; its lines stored either way round."""
    x, z = np.linspace(0.0, LENGTH, 17), np.linspace(0.0, DEPTH, 17)
    lines = []
    for i, place in enumerate(x[1:-1], 1):
        part = z / DEPTH
        waist = 0.02 + 0.3 * (part - 0.45) ** 2
        half = 0.5 * BREADTH * (waist + (place / LENGTH) ** 2 * part * (2.0 - part))
        points = np.column_stack([np.full(len(z), place), half, z])
        lines.append(LineSource.make("sections", f"ST {i}", points[::-1] if turned else points))
    for height in z[2:-2:2]:
        part = height / DEPTH
        half = 0.02 + 0.3 * (part - 0.45) ** 2 + (x / LENGTH) ** 2 * part * (2.0 - part)
        points = np.column_stack([x, 0.5 * BREADTH * half, np.full(len(x), height)])
        lines.append(
            LineSource.make("waterlines", f"WL {height:g}", points[::-1] if turned else points)
        )
    ship = ah.Particulars("hollow", LENGTH, BREADTH, DEPTH, 0.75 * DEPTH)
    links = [ah.Association("sections", "waterlines")]
    return ah.Hull.from_lines(lines, particulars=ship, associations=links)


@pytest.mark.parametrize("turned", [False, True], ids=["as drawn", "turned round"])
def test_normals_of_thin_hollow_sections_point_out(turned: bool) -> None:
    """There the skin faces the line of the deck in the centre plane, and still lies to port."""
    hull = hollow(turned=turned)
    rows = hull.state.live("rows")
    normal = hull_normals(hull.state)[rows]
    facing_deck = normal[:, 1] * hull.state.rows.xyz[rows, 1] + normal[:, 2] * (
        hull.state.rows.xyz[rows, 2] - DEPTH
    )
    assert (facing_deck < 0.0).sum() > 5
    assert (normal[:, 1] > 0.5).all()


def test_a_pull_moves_a_thin_hollow_stern_one_way() -> None:
    """All points in reach go outward: none is drawn in beside one that is drawn out."""
    hull = hollow(turned=False)
    before = hull.state.rows.xyz.data.copy()
    with hull.edit("pull") as edit:
        edit.pull("WL 4 x ST 2", 0.03, (15.0, 4.0))
    moved = hull.state.rows.xyz[:, 1] - before[:, 1]
    assert moved.min() > -1e-12
    assert (moved > 0.0).sum() > 5


def test_no_normal_of_wigley_points_to_starboard() -> None:
    """At crossings, ends and points of one curve only."""
    state = wigley()
    assert (hull_normals(state)[state.live("rows"), 1] > -1e-12).all()


@pytest.mark.parametrize("turned", [False, True], ids=["as drawn", "turned round"])
def test_normals_of_closed_curves_point_away_from_their_inside(turned: bool) -> None:
    """A pod clear of the centre plane: closed sections and closed waterlines."""
    angle = np.linspace(0.0, 2.0 * np.pi, 25)
    sense = -1.0 if turned else 1.0
    lines = []
    for x in np.linspace(-3.0, 3.0, 7):
        r = np.sqrt(1.0 - (x / 4.0) ** 2)
        ring = [np.full(25, x), 3.0 + r * np.cos(angle), 5.0 + r * np.sin(sense * angle)]
        lines.append(LineSource.make("sections", f"ST {x:g}", np.column_stack(ring)))
    for z in (4.6, 5.0, 5.4):
        r = np.sqrt(1.0 - (z - 5.0) ** 2)
        ring = [4.0 * r * np.sin(sense * angle), 3.0 + r * np.cos(angle), np.full(25, z)]
        lines.append(LineSource.make("waterlines", f"WL {z:g}", np.column_stack(ring)))
    hull = ah.Hull.from_lines(
        lines,
        particulars=ah.Particulars("pod", 8.0, 8.0, 8.0, 6.0),
        associations=[ah.Association("sections", "waterlines")],
    )
    rows = hull.state.live("rows")
    crossing = rows[(hull.state.rows.curve[rows] >= 0).all(axis=1)]
    away = hull.state.rows.xyz[crossing] - [0.0, 3.0, 5.0]
    assert len(crossing) > 30
    assert ((hull_normals(hull.state)[crossing] * away).sum(axis=1) > 0.0).all()
