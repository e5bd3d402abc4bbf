"""The closed mesh of every shipped hull, written as STL with nothing asked for, comes in right."""

from __future__ import annotations

from pathlib import Path

import pytest

import assoc_hull as ah
from tests.long_forms import long_form

pytestmark = long_form

HULLS = (
    "bulk_carrier_180m", "bulk_carrier_207k", "container_ship_225m", "plain_ship",
    "prelikon_ship", "seaking_ship", "series60", "sfolds_ship", "wigley",
)  # fmt: skip


@pytest.mark.parametrize("name", HULLS)
def test_an_exported_mesh_is_the_hull_again(name: str, tmp_path: Path) -> None:
    """V within .05 %, S within .5 %, whatever its flats look like between facets."""
    hull: ah.Hull = getattr(ah.examples, name)()
    hull.export(tmp_path / "hull.stl")
    ship = hull.particulars
    back = ah.read(tmp_path / "hull.stl", length=ship.length, draught=ship.draught)
    found, truth = back.hydrostatics(on_error="report"), hull.hydrostatics(on_error="report")
    assert found.volume == pytest.approx(truth.volume, rel=5e-4)
    assert found.wetted_surface == pytest.approx(truth.wetted_surface, rel=5e-3)
