"""A hull that was taken with a fault may be edited; only an edit that makes it worse is refused."""

from __future__ import annotations

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.errors import RefusedEditError
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Particulars

BEYOND = [[0, 0], [-0.02, 1], [0.5, 2], [4, 2.5], [5, 6]]
"""A section with a point 20 mm beyond the centre plane."""

BACK = [[0, 0], [3, 0.4], [2.5, 0.45], [4.5, 3], [5, 6]]
"""A section that turns back by half a metre."""


def hull_of(points: list[list[float]]) -> ah.Hull:
    """Three sections, all of these points."""
    lines = [
        LineSource.make("sections", f"ST {i}", np.insert(np.array(points), 0, 10.0 * i, axis=1))
        for i in range(3)
    ]
    return ah.Hull(adopt(lines, Particulars("ship", 100.0, 10.0, 6.0, 3.0), ())[0])


def move(hull: ah.Hull, place: tuple[float, float], to: tuple[float, float]) -> None:
    """Move the point of ST 0 that lies at (y, z), m."""
    [point] = [
        each
        for name, each in hull.points.items()
        if name.startswith("ST 0") and (each.y, each.z) == place
    ]
    with hull.edit("move") as edit:
        edit.move(point, y=to[0], z=to[1], lead=False)


@pytest.mark.parametrize(
    ("points", "place", "less", "worse", "words"),
    [
        (BEYOND, (-0.02, 1.0), (-0.01, 1.0), (-0.03, 1.0), "passes the centre plane by 0.03 m"),
        (BACK, (2.5, 0.45), (2.6, 0.45), (-1.0, 0.45), "passes the centre plane"),
        (BACK, (4.5, 3.0), (4.6, 3.0), (8.0, 9.0), "folds back on itself"),
    ],
)
def test_only_what_makes_a_fault_worse_is_refused(
    points: list[list[float]], place: tuple[float, float], less: tuple[float, float],
    worse: tuple[float, float], words: str,
) -> None:  # fmt: skip
    """A point elsewhere on the same curve moves, the faulty one moves back, but not farther."""
    hull = hull_of(points)
    move(hull, (5.0, 6.0), (5.1, 6.0))
    move(hull, place, less)
    before = hull.fingerprint
    with pytest.raises(RefusedEditError, match=words):
        move(hull, less, worse)
    assert hull.fingerprint == before
