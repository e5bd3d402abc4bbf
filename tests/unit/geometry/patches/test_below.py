"""Volume below a level, from the surface of one side alone."""

import numpy as np
import pytest

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.geometry.patches.volume_below import integrate_below

LENGTH, BREADTH, DRAUGHT = 100.0, 10.0, 6.25
# Bezier points of 1 - t**2 for t from -1 to 1, and of 1 - (1 - t)**2 for t from 0 to 1.
ALONG = np.array([0.0, 2.0, 0.0])
UP = np.array([0.0, 1.0, 1.0])


def wigley(turned: bool = False) -> SplineSurface:
    """One side of Wigley's hull to its draught, exactly; or with u along the girth."""
    net = np.zeros((3, 3, 3))
    net[..., 0] = np.linspace(0.0, LENGTH, 3)[:, None]
    net[..., 1] = 0.5 * BREADTH * ALONG[:, None] * UP
    net[..., 2] = np.linspace(0.0, DRAUGHT, 3)
    # Downward, or turned, so that u x v points out.
    net = np.swapaxes(net, 0, 1) if turned else net[:, ::-1]
    return SplineSurface.bezier(np.ascontiguousarray(net), "side")


def enclosed(level: float) -> tuple[float, float]:
    """Volume of one side below a level, and its moment in z, by closed form."""
    t = level / DRAUGHT
    area, moment = t**2 - t**3 / 3.0, 2.0 * t**3 / 3.0 - t**4 / 4.0
    half = 0.5 * BREADTH * LENGTH * 2.0 / 3.0
    return half * DRAUGHT * area, half * DRAUGHT**2 * moment


@pytest.mark.parametrize("turned", [False, True], ids=["v along the girth", "u along the girth"])
@pytest.mark.parametrize("level", [0.4, 3.0, 6.25, 9.0], ids=["low", "half", "full", "above"])
def test_a_hull_by_formula_has_the_volume_of_its_formula(level: float, turned: bool) -> None:
    """Volume and moments are exact to rounding, wherever the level cuts, whichever way u runs."""
    found = integrate_below([wigley(turned)], level)
    volume, moment = enclosed(min(level, DRAUGHT))
    assert found.volume == pytest.approx(volume, rel=1e-12)
    assert found.moment.tolist() == pytest.approx([50.0 * volume, moment], rel=1e-12)


def test_parts_have_together_what_the_whole_has() -> None:
    """Cut by knot insertion into four, a surface encloses the same."""
    whole = wigley()
    parts = [
        whole.restricted(u, v) for u in ((0.0, 0.3), (0.3, 1.0)) for v in ((0.0, 0.6), (0.6, 1.0))
    ]
    one, four = integrate_below([whole], 4.0), integrate_below(parts, 4.0)
    assert four.volume == pytest.approx(one.volume, rel=1e-12)
    assert four.area == pytest.approx(one.area, rel=1e-6)


def test_a_wall_with_a_sloping_border_is_cut_across_corners() -> None:
    """Where the level runs through borders across the lines, one patch is off by a thousandth."""
    net = np.zeros((2, 2, 3))
    net[..., 0], net[..., 1] = [[0.0, 0.0], [10.0, 10.0]], 2.0
    net[..., 2] = [[4.0, 0.0], [9.0, 5.0]]  # top edge and bottom edge rise from 0 to 5
    found = integrate_below([SplineSurface.bezier(net)], 3.0)
    area = 0.5 * 6.0 * 3.0  # the triangle below the level: 6 m long, 3 m high
    assert found.area == pytest.approx(area, rel=1e-3)
    assert found.volume == pytest.approx(2.0 * area, rel=1e-3)


def test_nothing_lies_below_a_level_under_the_surface() -> None:
    """A surface above the level adds nothing at all."""
    found = integrate_below([wigley()], -1.0)
    assert (found.volume, found.area, found.moment.tolist()) == (0.0, 0.0, [0.0, 0.0])
