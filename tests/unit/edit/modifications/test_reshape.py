"""Re-shapes: several at once."""

from __future__ import annotations

import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray

NAMES = ("WL 2.5", "WL 3.125")


def _goals(hull: ah.Hull) -> list[FloatArray]:
    """Give the crossings of two neighbouring waterlines with station 6, 5 and 8 mm farther out."""
    return [
        hull.points[f"{name} x ST 6"].position + np.array([0.0, out, 0.0])
        for name, out in zip(NAMES, (0.005, 0.008), strict=True)
    ]


def test_of_two_curves_re_shaped_at_once_each_takes_its_own_shape() -> None:
    """The field of each reaches the other, and still all given points are met, to the bit."""
    hull = ah.examples.wigley()
    goals = _goals(hull)
    with hull.edit("both") as edit:
        for name, goal in zip(NAMES, goals, strict=True):
            edit.reshape(name, [goal], span=(15.0, 45.0), fade=(20.0, 3.0))
    for name, goal in zip(NAMES, goals, strict=True):
        assert np.array_equal(hull.points[f"{name} x ST 6"].position, goal)
    assert hull.check() == ()


def test_the_order_of_two_re_shapes_plays_no_part() -> None:
    """The same bits come out."""
    found = []
    for turn in (1, -1):
        hull = ah.examples.wigley()
        goals = dict(zip(NAMES, _goals(hull), strict=True))
        with hull.edit("both") as edit:
            for name in NAMES[::turn]:
                edit.reshape(name, [goals[name]], span=(15.0, 45.0), fade=(20.0, 3.0))
        found.append(hull.fingerprint)
    assert found[0] == found[1]
