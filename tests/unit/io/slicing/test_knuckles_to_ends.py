"""A knuckle found on the stations ends at the corner of the transom, not at the last station."""

from pathlib import Path

import numpy as np
import pytest

from assoc_hull.io.slicing.boundary_curves import _stem_ahead, loft_source
from assoc_hull.io.slicing.features import FeatureRules
from assoc_hull.model.line_source import LineSource
from tests.drawn_hulls import DEPTH, HALF, LENGTH, box_barge, transom_boat


def test_the_knuckle_of_a_box_reaches_both_ends(tmp_path: Path) -> None:
    """The mesh of a box of 60 x 12 x 4 m holds 2880 m3: no bilge corner is cut off at the ends."""
    hull = box_barge(tmp_path)
    knuckle = hull.state.spline(hull.state.curves.key.data.index("boundary:knuckle 1/1"))
    assert knuckle.xyz[[0, -1]] == pytest.approx(
        np.array([[0.0, HALF, 0.0], [LENGTH, HALF, 0.0]]), abs=1e-3
    )
    assert hull.mesh().volume == pytest.approx(2.0 * LENGTH * HALF * DEPTH, rel=1e-4)


def test_the_chine_of_a_boat_reaches_her_transom(tmp_path: Path) -> None:
    """What the mesh displaces is what the sections displace, at the draught and below the deck."""
    hull = transom_boat(tmp_path)
    mesh = hull.mesh()
    for draught in (1.0, 2.5):
        found = hull.hydrostatics(draught=draught, on_error="report", estimate=False)
        assert mesh.below(draught).volume == pytest.approx(found.volume, rel=2e-3)


def test_a_chine_that_leads_to_the_stem_ends_on_it(tmp_path: Path) -> None:
    """The last station is 1.7 m before the stem, which the chine meets at (24, 0, 1.6)."""
    hull = transom_boat(tmp_path)
    chine = hull.state.spline(hull.state.curves.key.data.index("boundary:knuckle 1/1"))
    assert chine.xyz[-1] == pytest.approx([24.0, 0.0, 1.6], abs=2e-3)


def test_a_chine_that_leads_past_the_stem_is_not_drawn_to_it() -> None:
    """A parabola that comes to the centre plane 3 m ahead of the stem, or on it, of a long ship."""
    rise = np.array([[90.0, 0.0, 0.0], [100.0, 0.0, 8.0]])
    stem = loft_source(LineSource.make("boundary", "profile", rise))
    for beyond, found in ((3.0, None), (0.0, [97.5, 0.0, 6.0])):
        x = np.array([85.0, 90.0, 95.0])
        half = 0.04 * ((97.5 + beyond - 70.0) ** 2 - (x - 70.0) ** 2)
        places = np.column_stack([x, half, np.full(3, 6.0)])
        corner = _stem_ahead(places, (), [("profile", stem)], FeatureRules())
        if found is None:
            assert corner is None
        else:
            assert corner is not None
            assert corner.place == pytest.approx(np.array(found), abs=1e-6)
