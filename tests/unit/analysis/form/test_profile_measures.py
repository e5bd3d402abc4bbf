"""The bulb's tip on profiles drawn in one curve or in several."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

import attrs
import numpy as np
import pytest

from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.parameter import Absent
from assoc_hull.analysis.form.profile import area_before_fp, bulb_tip
from assoc_hull.geometry.curves import CurveData, PointKind, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from tests.floating_bodies import head

LENGTH = 100.0
BULB = ((90.0, 0.0), (102.0, 1.0), (104.0, 4.0), (101.0, 6.0), (100.0, 8.0), (103.0, 12.0))
"""x and z of a profile with corners, from the keel up; the tip stands at (104, 4)."""


def line(places: tuple[tuple[float, float], ...]) -> SplineBatch:
    """Straight from place to place."""
    xyz = np.array([(x, 0.0, z) for x, z in places])
    return loft(CurveData.single(xyz, np.full(len(xyz), int(PointKind.KNUCKLE), np.int8)))


@attrs.frozen
class Drawn:
    """A ship of which only the profile is known."""

    curves: SplineBatch | None
    draught: float = 8.0
    length: float = LENGTH

    @property
    def header(self) -> object:
        return head(LENGTH, 20.0, self.draught)

    def take(self, measure: Callable[[FloatingShape], object]) -> object:
        return self.curves


def shape(*curves: tuple[tuple[float, float], ...], draught: float = 8.0) -> FloatingShape:
    """Of a profile in curves."""
    batch = SplineBatch.join([line(each) for each in curves]) if curves else None
    return cast(FloatingShape, Drawn(batch, draught))


@pytest.mark.parametrize(
    "curves",
    [
        pytest.param((BULB,), id="one curve"),
        pytest.param((BULB[::-1],), id="downward"),
        pytest.param((BULB[:3], BULB[2:]), id="parted at the tip"),
        pytest.param((BULB[2:], BULB[2::-1]), id="parted at the tip, out of order, away from it"),
        pytest.param((BULB[:2], BULB[1:4], BULB[3:]), id="three curves"),
    ],
)
def test_the_tip_does_not_depend_on_how_the_profile_is_drawn(
    curves: tuple[tuple[tuple[float, float], ...], ...],
) -> None:
    """One curve or several, up or down; the area before FP neither."""
    ship = shape(*curves)
    tip = bulb_tip(ship)
    assert not isinstance(tip, Absent)
    assert tip.tolist() == [104.0, 0.0, 4.0]
    # Triangles and trapezia between FP and the profile, from (100, 5/6) up to (100, 8).
    area = 2.0 / 12.0 + 3.0 * 3.0 + 2.0 * 2.5 + 1.0
    assert area_before_fp(ship, 8.0, 0.0) == pytest.approx(area, rel=1e-12)


@pytest.mark.parametrize(
    "curves",
    [
        pytest.param((((90.0, 0.0), (100.0, 3.0), (105.0, 12.0)),), id="raked stem"),
        pytest.param((((90.0, 0.0), (101.0, 6.0)), ((101.0, 6.0), (105.0, 12.0))), id="in two"),
        pytest.param((((90.0, 0.0), (100.0005, 4.0), (99.0, 12.0)),), id="half a millimetre"),
        pytest.param((((90.0, 0.0), (98.0, 4.0), (96.0, 6.0), (100.0, 9.0)),), id="abaft FP"),
        pytest.param((((90.0, 0.0), (100.0, 9.0), (104.0, 11.0), (101.0, 13.0)),), id="above T"),
    ],
)
def test_what_is_no_bulb(curves: tuple[tuple[tuple[float, float], ...], ...]) -> None:
    """A bulb reaches before FP below the design draught, and the profile goes back above it."""
    assert bulb_tip(shape(*curves)) == Absent("no bulb")


def test_without_a_profile_nothing_is_told() -> None:
    """There is a reason, and no area."""
    assert bulb_tip(shape()) == Absent("no profile drawn")
    assert area_before_fp(shape(), 8.0, 0.0) == 0.0
