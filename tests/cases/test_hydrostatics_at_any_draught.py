"""The volume as a function of the draught: it rises, as fast as the waterplane is large, smoothly.

Draughts are drawn at random, and taken at every height at which something stands: all knots of
all lines (so all offsets), where other programs jump.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
import pytest
from numpy.typing import NDArray

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.shipped.wigley import wigley
from tests.nets import ellipsoid_net

STEP = 1e-4
"""For central differences, m: what V bends by over it is a thousandth of the bar, and rounding
of V is too."""

APART = 1e-9
"""Draughts that are told apart, m: heights that differ by rounding are one."""


@attrs.frozen
class Draughts:
    """A hull with its volume and waterplane at many draughts."""

    body: Flotation
    level: FloatArray
    found: ImmersedIntegrals
    knot: NDArray[np.bool_]

    def at(self, level: FloatArray) -> ImmersedIntegrals:
        """Measure at other draughts."""
        return measured(self.body, level)


def measured(body: Flotation, level: FloatArray) -> ImmersedIntegrals:
    """Measure at even keel, all draughts in one call."""
    return body.measure(FloatingPlanes(level.copy(), np.zeros(len(level)), np.zeros(len(level))))


def _shipped_wigley(_: ah.Hull) -> Flotation:
    return flotation(wigley())


def _ellipsoid(_: ah.Hull) -> Flotation:
    return flotation(ellipsoid_net(21, 11))


def _series60(hull: ah.Hull) -> Flotation:
    return flotation(hull.state)


HULLS: dict[str, tuple[Callable[[ah.Hull], Flotation], int]] = {
    "wigley": (_shipped_wigley, 10_000),
    "series 60": (_series60, 10_000),
    "ellipsoid": (_ellipsoid, 600),
}


@pytest.fixture(scope="module", params=HULLS)
def many(request: pytest.FixtureRequest, series60_70: ah.Hull) -> Draughts:
    """Draughts from just above the keel to just below the deck, ascending."""
    make, count = HULLS[request.param]
    body = make(series60_70)
    knots = body.net.batch.xyz[:, 2]
    low, high = float(knots.min()) + 0.06, float(knots.max()) - 0.06
    drawn = np.random.default_rng(20).uniform(low, high, count)
    level = np.unique(np.concatenate([drawn, knots[(knots >= low) & (knots <= high)]]))
    level = level[np.diff(level, prepend=-np.inf) > APART]
    return Draughts(body, level, measured(body, level), ~np.isin(level, drawn))


def test_the_volume_rises(many: Draughts) -> None:
    """From each draught to the next, however near, by what the waterplane makes of the step."""
    rise, step = np.diff(many.found.volume), np.diff(many.level)
    assert (rise > 0.0).all()
    area = many.found.area
    least = np.minimum(area[1:], area[:-1])
    rounding = 1e-14 * many.found.volume[1:] / step
    assert (rise / step >= 0.9 * least - rounding).all()


def test_the_volume_rises_as_fast_as_the_waterplane_is_large(many: Draughts) -> None:
    """|dV/dT - Aw| is at most 1e-6 Aw, by central differences, at knots and anywhere."""
    ahead, behind = many.at(many.level + STEP), many.at(many.level - STEP)
    slope = (ahead.volume - behind.volume) / (2.0 * STEP)
    off = np.abs(slope / many.found.area - 1.0)
    worst = int(off.argmax())
    print(f"\n{len(off)} draughts: dV/dT off by {off[worst]:.1e} at {many.level[worst]:.4f} m")
    assert off[worst] <= 1e-6


@pytest.mark.parametrize("part", [1.0 - 1e-14, 1.0 + 1e-14])
def test_rounding_of_the_draught_changes_no_volume(many: Draughts, part: float) -> None:
    """V(T) and V(T (1 +- 1e-14)) differ by 1e-11 V at most, at knots too.

    At all knots, and at every fourth of the other draughts.
    """
    chosen = many.knot | (np.arange(len(many.level)) % 4 == 0)
    near, found = many.at(many.level[chosen] * part), many.found
    off = np.abs(near.volume / found.volume[chosen] - 1.0)
    assert off.max() <= 1e-11
    assert np.abs(near.area / found.area[chosen] - 1.0).max() <= 1e-9


def test_the_waterplane_does_not_jump(many: Draughts) -> None:
    """A nanometre beside a knot it is what it is on it, to 1e-6."""
    for step in (1e-9, -1e-9):
        near = many.at(many.level[::4] + step)
        np.testing.assert_allclose(near.area, many.found.area[::4], rtol=1e-6)
