"""Nets of hulls with a formula against the formula: errors, how they fall, how they are estimated.

Truth are the bodies of `tests.exact_hulls` below the same planes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import table_of
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.geometry.floating.immersed_strips import prepare_strips
from assoc_hull.model.tables import HullState
from assoc_hull.shipped.wigley import wigley as shipped_wigley
from tests import exact_hulls
from tests.floating_bodies import StripBody, head
from tests.long_forms import LONG
from tests.nets import ellipsoid_net, wigley_net

SIZES = ((21, 11), (41, 21), (81, 41))
BOUNDS = (2e-4, 3e-5, 4e-6)
FALL = 6.0

FIELDS = (
    "volume", "lcb", "tcb", "kb", "waterplane_area", "lcf", "tcf", "i_t", "i_l", "i_lt", "bmt",
    "bml", "wetted_surface", "wetted_surface_girth", "lwl", "bwl",
)  # fmt: skip
"""What the bodies of the formulas have: they have no stations."""

DRAUGHT = 5.0
SLOPE = 50.0 * float(np.tan(np.radians(1.0)))
POSITIONS = {
    "even keel": FloatingPosition(DRAUGHT, DRAUGHT),
    "trim 1 deg, heel 10 deg": FloatingPosition(DRAUGHT - SLOPE, DRAUGHT + SLOPE, 10.0),
}
"""Planes that pass amidships at the draught."""


def _shipped(stations: int, waterlines: int) -> HullState:
    """The example that ships: the ends of its lines are free."""
    return shipped_wigley(stations=stations, waterlines=waterlines)


FAMILIES: dict[str, tuple[Callable[[int, int], HullState], str, float]] = {
    "wigley net": (wigley_net, "wigley", 10.0),
    "shipped wigley": (_shipped, "wigley", 10.0),
    "ellipsoid net": (ellipsoid_net, "ellipsoid", 16.0),
}


FINE = tuple(FAMILIES) if LONG else ("wigley net",)
"""Families of which the finest net is tried too: it costs more than the two others together."""


@attrs.frozen
class Row:
    """One net at one position."""

    family: str
    size: tuple[int, int]
    position: str
    found: Hydrostatics
    truth: Hydrostatics

    def off(self, name: str) -> float:
        """By how much a value is off."""
        return abs(float(getattr(self.found, name)) - float(getattr(self.truth, name)))

    def stated(self, name: str) -> float:
        """By how much it may be off, as the record says."""
        amount = self.found.error[name]
        assert amount is not None, name
        return amount

    def scale(self, name: str) -> float:
        """What rounding of the value is measured by."""
        if name in ("lcb", "tcb", "kb", "lcf", "tcf"):
            return 100.0
        if name in ("lwl", "bwl"):
            return 1e6  # extents are read between curves: a micrometre is nothing
        return self.truth.i_l if name == "i_lt" else abs(float(getattr(self.truth, name)))


@pytest.fixture(scope="module")
def rows() -> list[Row]:
    """All families, sizes and positions, with their truth."""
    truth = {
        "wigley": StripBody.of(prepare_strips(exact_hulls.wigley(points=600)), 5.0, 12.5),
        "ellipsoid": StripBody.of(prepare_strips(exact_hulls.ellipsoid(points=200)), 0.0, 12.0),
    }
    return list(_rows(truth))


def _rows(truth: dict[str, StripBody]) -> Iterator[Row]:
    for family, (make, body, breadth) in FAMILIES.items():
        whole = table_of(
            truth[body], list(POSITIONS.values()), head(100.0, breadth, 6.25), estimate=False
        )
        for size in SIZES if family in FINE else SIZES[:-1]:
            hull = ah.Hull(make(*size))
            for i, (words, position) in enumerate(POSITIONS.items()):
                draughts = position.draught_aft, position.draught_fore
                found = hull.hydrostatics(draughts=draughts, heel_deg=position.heel_deg)
                yield Row(family, size, words, found, whole[i])


def _title(row: Row) -> str:
    return f"{row.family:15s} {row.size[0]:3d} x {row.size[1]:2d}  {row.position:23s}"


def test_volumes_of_nets_are_within_the_bounds_and_converge(rows: list[Row]) -> None:
    """Errors of V, at most 2e-4, 3e-5 and 4e-6 of it, fall at least 6-fold per step."""
    print("\nrelative errors                                    V        S       Aw     LCB/L")
    for row in rows:
        off = [row.off(name) / row.scale(name) for name in ("volume", "wetted_surface")]
        off += [row.off(name) / row.scale(name) for name in ("waterplane_area", "lcb")]
        print(_title(row), " ".join(f"{each:8.1e}" for each in off))
    for family in FAMILIES:
        for position in POSITIONS:
            same = [r for r in rows if (r.family, r.position) == (family, position)]
            off = [row.off("volume") / row.truth.volume for row in same]
            assert len(off) == (3 if family in FINE else 2)
            assert all(a <= b for a, b in zip(off, BOUNDS, strict=False)), (family, off)
            assert all(a >= FALL * b for a, b in pairwise(off)), (family, off)


def test_the_volume_is_off_by_no_more_than_is_stated_and_stated_closely(rows: list[Row]) -> None:
    """The estimate is at least the true error in all rows, and in the median at most 20 times."""
    print("\nvolume, m3                                        error    stated   ratio")
    ratios = []
    for row in rows:
        off, stated = row.off("volume"), row.stated("volume")
        ratios.append(stated / off)
        print(_title(row), f"{off:9.2e} {stated:9.2e} {ratios[-1]:7.2f}")
        assert stated >= off - 1e-12 * row.truth.volume, _title(row)
    print(f"median {np.median(ratios):.2f}")
    assert np.median(ratios) <= 20.0


@pytest.mark.parametrize("name", FIELDS)
def test_every_value_is_off_by_no_more_than_is_stated(rows: list[Row], name: str) -> None:
    """Centres, waterplane, inertias, surface and extents too, in all rows."""
    for row in rows:
        rounding = 1e-12 * row.scale(name)
        assert row.stated(name) >= row.off(name) - rounding, (_title(row), row.off(name))


def test_what_is_stated_is_not_wasteful(rows: list[Row]) -> None:
    """In the median no more than 20 times the true error, for what is integrated."""
    print("\nmedian of stated over true error")
    for name in ("volume", "kb", "waterplane_area", "i_t", "i_l", "bmt", "wetted_surface"):
        ratio = [row.stated(name) / row.off(name) for row in rows if row.off(name) > 0.0]
        print(f"{name:20s} {np.median(ratio):7.2f}   least {min(ratio):.2f}")
        assert np.median(ratio) <= 20.0, name
