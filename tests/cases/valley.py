"""A hull with a valley amidships: its outer buttocks have two pieces, its inner ones one."""

from __future__ import annotations

import numpy as np

import assoc_hull as ah
from assoc_hull.model.line_source import LineSource

LENGTH, BREADTH, DEPTH = 80.0, 12.0, 8.0


def breadth_at(x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Give the half-breadth (m): two humps along x, a parabola in z, nil at both ends."""
    along = np.sin(np.pi * x / LENGTH) * (1.0 - 0.55 * np.exp(-(((x - 40.0) / 12.0) ** 2)))
    up = 1.0 - (1.0 - z / DEPTH) ** 2
    return 0.5 * BREADTH * along * up


def valley_hull(buttock: float = 2.0) -> ah.Hull:
    """Make the net: 19 sections, 5 waterlines, profile, deck edge, and one buttock."""
    x, z = np.linspace(0.0, LENGTH, 41), np.linspace(0.0, DEPTH, 9)
    corners = np.array([[0, 0, DEPTH], [0, 0, 0], [LENGTH, 0, 0], [LENGTH, 0, DEPTH]])
    end, knuckle = ah.BoundaryKind.END, ah.PointKind.KNUCKLE
    level = np.full(len(x), DEPTH)
    deck = np.column_stack([x, breadth_at(x, level), level])
    lines = [
        LineSource.make(
            "boundary", "profile", corners, plane=((0, 1, 0), 0.0), boundary=end,
            kind=[0, knuckle, knuckle, 0],
        ),
        LineSource.make("boundary", "deck edge", deck, plane=((0, 0, 1), DEPTH), boundary=end),
    ]  # fmt: skip
    for i, place in enumerate(x[1:-1], 1):
        here = np.full(len(z), place)
        points = np.column_stack([here, breadth_at(here, z), z])
        lines.append(LineSource.make("sections", f"ST {i}", points))
    for height in z[2:-1]:
        there = np.full(len(x), height)
        points = np.column_stack([x, breadth_at(x, there), there])
        lines.append(LineSource.make("waterlines", f"WL {height:g}", points))
    links = [ah.Association("boundary", each) for each in ("sections", "waterlines", "buttocks")]
    links += [
        ah.Association("sections", "waterlines"),
        ah.Association("sections", "buttocks"),
        ah.Association("waterlines", "buttocks"),
    ]
    ship = ah.Particulars("valley", LENGTH, BREADTH, DEPTH, 0.75 * DEPTH)
    hull = ah.Hull.from_lines(lines, particulars=ship, associations=links)
    with hull.edit("cut a buttock") as edit:
        edit.add_line("buttocks", buttock, "BTK")
    return hull
