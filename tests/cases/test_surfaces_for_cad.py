"""The surfaces of ships as CAD programs get them: whole hulls of one shell, to the micrometre.

Series 60 always; the DTC, with bulb and stern bulb, and the carrier with ``ASSOC_HULL_LONG=1``.
"""

from __future__ import annotations

import os

import pytest

from assoc_hull.hull import Hull
from assoc_hull.io.cad.check_file import area_of
from assoc_hull.io.cad.write import cad_bytes

LONG = os.environ.get("ASSOC_HULL_LONG") == "1"
SHIPS = {
    # Edges that join two faces, and free ones: deck edge, rim of the transom.
    "series60_70": (7, 4),
    **({"dtc": (19, 8), "bulk_carrier": (13, 10)} if LONG else {}),
}


@pytest.mark.parametrize("name", SHIPS)
def test_the_whole_hull_is_one_shell(name: str, request: pytest.FixtureRequest) -> None:
    """Both sides of all blocks are joined, also where three of them meet on the centre plane.

    Seams that are open, units, names and normals: the file would be refused.
    """
    hull: Hull = request.getfixturevalue(name)
    patches = hull.surface().patches
    _, found = cad_bytes(patches, "step", unit="mm")
    assert (found.faces, found.shells) == (2 * len(patches), 1)
    assert (found.joined_edges, found.free_edges) == SHIPS[name]
    assert found.control_point_error < 1e-8
    assert found.area == pytest.approx(2.0 * sum(map(area_of, patches)), rel=1e-6)
