"""Tunnels on the lines plan: their mouths in all views, and lines that end at them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.lines_plan.drawing import PlotMouth, drawing, outside_mouths
from assoc_hull.plot.lines_plan.plan import lines_plan

Lines = Callable[[Figure, str], list[FloatArray]]


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A Wigley hull with a tunnel that one section, one waterline and one buttock pass."""
    found = ah.examples.wigley()
    with found.edit("thruster") as edit:
        edit.tunnel("bow thruster", x=86.0, z=2.8, radius=0.8)
    return found


def test_each_view_shows_the_mouth_once(hull: ah.Hull, lines_of: Lines) -> None:
    """In the body plan on the fore body; in the profile it is a circle."""
    figure = lines_plan(hull)
    for view in ("profile", "half-breadth", "body"):
        (mouth,) = lines_of(figure, f"{view}/tunnels/bow thruster$")
        assert (mouth[0] == mouth[-1]).all()
        if view == "profile":
            away = np.hypot(*(mouth[:-1] - mouth[:-1].mean(axis=0)).T)
            assert away == pytest.approx(away.mean(), rel=1e-9)
    without = lines_plan(ah.examples.wigley())
    assert not lines_of(without, "profile/tunnels/bow thruster$")


def test_lines_end_at_the_mouth(hull: ah.Hull, lines_of: Lines) -> None:
    """A waterline that passes it is in two pieces, whose inner ends lie on the cylinder."""
    shown = drawing(hull)
    crossed = set()
    for line in shown.lines:
        if line is shown.profile:
            continue
        for points in line.polylines:
            parts = list(outside_mouths(points, shown.mouths))
            away = [np.hypot(part[:, 0] - 86.0, part[:, 2] - 2.8) for part in parts]
            assert all(each.min() >= 0.8 - 1e-9 for each in away)
            if len(parts) == 2:
                crossed.add(line.family)
                # A chord of a polyline that is cut lies a little inside of its curve.
                assert away[0][-1] == pytest.approx(0.8, abs=1e-9)
                assert away[1][0] == pytest.approx(0.8, abs=1e-9)
    assert "waterlines" in crossed
    figures = lines_plan(hull), lines_plan(ah.examples.wigley())
    counts = [len(lines_of(each, "half-breadth/waterlines/WL 2.5$")) for each in figures]
    assert counts[0] == counts[1] + 1


def test_a_stretch_cuts_a_mouth_off_with_the_lines(hull: ah.Hull, lines_of: Lines) -> None:
    """Half of it lies in the stretch."""
    (mouth,) = lines_of(lines_plan(hull, x=(60.0, 86.0)), "profile/tunnels/bow thruster$")
    whole = lines_of(lines_plan(hull, x=(60.0, 99.0)), "profile/tunnels/bow thruster$")[0]
    assert not (mouth[0] == mouth[-1]).all()
    assert (whole[0] == whole[-1]).all()


@pytest.mark.parametrize(
    ("points", "count"),
    [
        ([[-3.0, 1.0, 0.0], [3.0, 1.0, 0.0]], 2),
        ([[-3.0, 1.0, 2.0], [3.0, 1.0, 2.0]], 1),
        ([[-0.5, 1.0, 0.0], [0.5, 1.0, 0.0]], 0),
        ([[0.0, 1.0, 0.0], [3.0, 1.0, 0.0]], 1),
        ([[-3.0, 1.0, 1.0], [3.0, 1.0, 1.0]], 1),
        ([[-3.0, 1.0, 0.0], [0.0, 1.0, 0.5], [0.1, 1.0, 0.5], [0.0, 1.0, 3.0]], 2),
    ],
    ids=["through it", "beside it", "within it", "out of it", "along its edge", "round a corner"],
)
def test_a_polyline_is_cut_where_it_passes_the_cylinder(
    points: list[list[float]], count: int
) -> None:
    """Its pieces lie outside."""
    mouth = PlotMouth("t", 0.0, 0.0, 1.0, np.zeros((1, 3)))
    parts = list(outside_mouths(np.array(points), [mouth]))
    assert len(parts) == count
    assert all(np.hypot(part[:, 0], part[:, 2]).min() >= 1.0 - 1e-12 for part in parts)
