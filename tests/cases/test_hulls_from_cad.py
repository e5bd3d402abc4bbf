"""Hulls out of CAD files: the published Wigley hull, and one that went there and back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.io.surfaces.surface_file import write_surfaces


def test_the_published_wigley_surface_becomes_a_net(data_folder: Path) -> None:
    """At the scale of its file, without a word about it: volume, draught and length.

    The surface is a fit of the formula, trimmed by its own border; it holds .044 % too much. Its
    z = 0 is the waterline.
    """
    path = data_folder / "wigley" / "wavebem_wigley.iges"
    hull = ah.read(path, stations=21, waterlines=12, buttocks=3)
    ship = hull.particulars
    assert (ship.length, ship.draught) == pytest.approx((2.5, 0.15625), rel=1e-9)
    found = hull.hydrostatics(draught=ship.draught)
    exact = 4.0 * 2.5 * 0.25 * 0.15625 / 9.0
    assert found.volume == pytest.approx(exact, rel=5e-4)
    assert found.lcb == pytest.approx(1.25, abs=2.5e-5)
    assert found.kb == pytest.approx(5.0 / 8.0 * 0.15625, rel=5e-4)
    assert hull.check() == ()


def test_a_hull_comes_back_from_its_surface(tmp_path: Path) -> None:
    """A net, its surface in IGES in millimetres, and a net of that: volume and half-breadths."""
    hull = ah.examples.wigley()
    path = tmp_path / "wigley.igs"
    write_surfaces(hull.surface().patches, path)
    back = ah.read(path, stations=15, waterlines=9, buttocks=2)
    draught = hull.particulars.draught
    volume = hull.hydrostatics(draught=draught).volume
    assert back.hydrostatics(draught=draught).volume == pytest.approx(volume, rel=2e-4)
    x, z = np.meshgrid(np.linspace(10.0, 90.0, 9), np.linspace(1.0, 6.0, 6))
    off = [
        back.half_breadth(a, b) - hull.half_breadth(a, b)
        for a, b in zip(x.ravel().tolist(), z.ravel().tolist(), strict=True)
    ]
    assert np.abs(off).max() < 5e-3
