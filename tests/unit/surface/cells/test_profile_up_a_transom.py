"""A profile that runs up a flat end, where the plate of that end stands."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.errors import OpenNetError
from assoc_hull.geometry.curves import PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from tests.cases.test_hydrostatics_of_a_box import DEPTH, LENGTH, box_lines, box_of_lines


def test_a_profile_drawn_up_a_transom_is_told_to_end_at_its_foot() -> None:
    """Done so the mesh closes, with the volume of the box."""
    ends = np.array([[0.0, 0, DEPTH], [0, 0, 0], [LENGTH, 0, 0], [LENGTH, 0, DEPTH]])
    corner = int(PointKind.KNUCKLE)
    up = LineSource.make(
        "boundary", "profile", ends, plane=((0, 1, 0), 0.0), kind=[0, corner, corner, 0],
        boundary=BoundaryKind.END,
    )  # fmt: skip
    lines = [up if each.name == "profile" else each for each in box_lines(5)]
    with pytest.raises(OpenNetError, match="end the profile at its foot"):
        box_of_lines(lines).mesh()
    closed = box_of_lines(box_lines(5)).mesh()
    assert closed.volume == pytest.approx(LENGTH * 20.0 * DEPTH, rel=1e-9)
