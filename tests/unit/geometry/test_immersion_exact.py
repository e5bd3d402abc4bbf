"""The immersion of hulls known by formulas, against values known independently."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from tests.analytic_hulls import CASES, Case
from tests.exact_hulls import box, ellipsoid, wigley

HULLS = {
    "wigley": prepare_strips(wigley()),
    "ellipsoid": prepare_strips(ellipsoid()),
    "box": prepare_strips(box()),
}
SIZES = {"wigley": (100.0, 10.0, 6.25), "ellipsoid": (100.0, 16.0, 6.0), "box": (100.0, 20.0, 6.0)}


def below(
    hull: PreparedStrips, height: float, trim: float = 0.0, heel: float = 0.0
) -> ImmersedIntegrals:
    """What lies below one plane."""
    return integrate_immersed(
        hull, FloatingPlanes(np.array([height]), np.array([trim]), np.array([heel]))
    )


def wet_ends(case: Case) -> float:
    """How much of both end faces of the box is wet, m2: polygons clipped by the plane."""
    return sum(_wet_rectangle(case.height + case.tan_trim * x, case.tan_heel) for x in (0.0, 100.0))


def _wet_rectangle(level: float, heel: float) -> float:
    corners = [(-10.0, 0.0), (10.0, 0.0), (10.0, 12.0), (-10.0, 12.0)]
    over = [z - level + heel * y for y, z in corners]
    kept: list[tuple[float, float]] = []
    for i, (y, z) in enumerate(corners):
        if over[i - 1] * over[i] < 0.0:
            t = over[i - 1] / (over[i - 1] - over[i])
            back_y, back_z = corners[i - 1]
            kept.append((back_y + t * (y - back_y), back_z + t * (z - back_z)))
        if over[i] <= 0.0:
            kept.append((y, z))
    crosses = [kept[i - 1][0] * z - y * kept[i - 1][1] for i, (y, z) in enumerate(kept)]
    return 0.5 * abs(sum(crosses))


@pytest.mark.parametrize("name", CASES)
def test_every_value_of_the_reference_table_is_met(name: str) -> None:
    """V, centres, plane and wetted surface: to 1e-8 of each value's scale."""
    case = CASES[name]
    length, breadth, draught = SIZES[case.hull]
    body = below(HULLS[case.hull], case.height, case.tan_trim, case.tan_heel)
    volume, area = body.volume[0], body.area[0]
    lcf, tcf = body.area_x[0] / area, body.area_y[0] / area
    faces = wet_ends(case) if case.hull == "box" else 0.0
    found = {
        "volume": (volume, case.volume),
        "lcb": (body.moment_x[0] / volume, length),
        "tcb": (body.moment_y[0] / volume, breadth),
        "kb": (body.moment_z[0] / volume, draught),
        "area": (area, case.area),
        "lcf": (lcf, length),
        "tcf": (tcf, breadth),
        "i_t": (body.area_yy[0] - area * tcf**2, breadth**3 * length),
        "i_l": (body.area_xx[0] - area * lcf**2, breadth * length**3),
        "i_lt": (body.area_xy[0] - area * lcf * tcf, breadth**2 * length**2),
        "wetted": (body.shell[0] + body.wet_deck[0] + faces, case.wetted),
    }
    wrong = {
        key: (float(value), getattr(case, key))
        for key, (value, scale) in found.items()
        if abs(value - getattr(case, key)) > 1e-8 * scale
    }
    assert wrong == {}
