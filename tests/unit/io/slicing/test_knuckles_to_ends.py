"""A knuckle found on the stations ends at the corner of the transom, not at the last station."""

from pathlib import Path

import numpy as np
import pytest

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
