"""Hulls given by sections alone get profile, deck edge and waterlines through their sections."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.geometry.curves import PointKind
from assoc_hull.io.slicing.loft_sections import loft_sections
from assoc_hull.model.line_source import LineSource

LENGTH, HALF, DRAUGHT, DEPTH = 100.0, 5.0, 6.25, 8.0


def _wigley(x: float) -> np.ndarray:
    """Give a section of the Wigley hull with upright sides above the water, (n, 3), m."""
    z = np.linspace(0.0, DEPTH, 33)
    up = np.minimum(z / DRAUGHT, 1.0)
    along = 1.0 - (2.0 * x / LENGTH - 1.0) ** 2
    return np.column_stack([np.full(33, x), HALF * along * (1.0 - (1.0 - up) ** 2), z])


def _britfair(places: np.ndarray) -> str:
    rows = ["WIGLEY", "1"]
    for k, x in enumerate(places.tolist(), 1):
        points = _wigley(x)
        rows.append(f"{len(points)} {k} {x:.4f}")
        rows += [f"{y:.6f} {z:.6f}" for _, y, z in points.tolist()] + ["0"]
    return "\n".join([*rows, "0 0 0", ""])


def _sections(places: np.ndarray) -> list[LineSource]:
    return [LineSource.make("sections", f"ST {x:g}", _wigley(x)) for x in places.tolist()]


def test_sections_in_the_centre_plane_are_plumb_ends(tmp_path: Path) -> None:
    """The Wigley hull by 21 sections: V as its formula, profile and waterlines, surface, mesh."""
    path = tmp_path / "wigley.bri"
    path.write_text(_britfair(np.linspace(0.0, LENGTH, 21)))
    hull = ah.read(path, length=LENGTH, draught=DRAUGHT, origin="ap")
    assert hull.adoption is not None
    (told,) = [note for note in hull.adoption.notes if "sections alone" in note]
    assert "ST 0 and ST 100, in the centre plane, part of the profile" in told
    truth = 4.0 / 9.0 * LENGTH * 2.0 * HALF * DRAUGHT
    found = hull.hydrostatics()
    assert found.volume == pytest.approx(truth, rel=5e-4)
    assert found.lcb == pytest.approx(0.5 * LENGTH, abs=0.01)
    assert hull.mesh().volume == pytest.approx(
        truth + 4.0 / 3.0 * LENGTH * HALF * (DEPTH - DRAUGHT), rel=2e-3
    )
    assert len(hull.surface().patches) > 0


def test_a_dry_end_is_a_transom_and_all_that_is_asked_for_runs(
    shipped: Callable[[str], ah.Hull], tmp_path: Path
) -> None:
    """A cargo ship by GHS sections: V and S as hers; perpendiculars where the bow is."""
    ship = shipped("plain_ship")
    path = tmp_path / "plain.gf"
    ship.export(path, "gf")
    hull = ah.read(path, length=120.0, draught=7.2, deck="closed")
    truth, found = ship.hydrostatics(), hull.hydrostatics()
    assert found.volume == pytest.approx(truth.volume, rel=5e-4)
    assert found.wetted_surface == pytest.approx(truth.wetted_surface, rel=5e-3)
    assert found.lcb == pytest.approx(truth.lcb, abs=0.0005 * 120.0)
    assert "transom" in hull.groups["boundary"].lines
    assert hull.check() == ()


def test_an_immersed_end_forward_of_the_ap_is_no_transom() -> None:
    """Sections from 5 to 95 m: the hull goes on beyond them, so no line ends it."""
    lofted = loft_sections(_sections(np.linspace(5.0, 95.0, 19)), 4.0, 0.005)
    assert lofted is not None
    assert lofted.transom is None
    assert lofted.posts == ()
    waterline = next(line for line in lofted.lines if line.group == "waterlines")
    assert waterline.points[[0, -1], 0].tolist() == [5.0, 95.0]


def test_what_sections_do_not_tell_is_not_lofted() -> None:
    """Few sections, two curves in one plane, sections that begin off the centre plane."""
    every = _sections(np.linspace(0.0, LENGTH, 11))
    assert loft_sections(every[:5], 4.0, 0.005) is None
    assert loft_sections([*every, every[4]], 4.0, 0.005) is None
    off = LineSource.make("sections", "ST 50.5", _wigley(50.5)[3:])
    assert loft_sections([*every, off], 4.0, 0.005) is None


def test_lofted_waterlines_pass_through_their_sections() -> None:
    """Each point of a waterline lies on its section, or on the profile in the centre plane."""
    lofted = loft_sections(_sections(np.linspace(0.0, LENGTH, 21)), 4.0, 0.005)
    assert lofted is not None
    lines = [line for line in lofted.lines if line.group == "waterlines"]
    assert len(lines) == 13
    for line in lines:
        for point in line.points:
            section = _wigley(float(point[0]))
            y = np.interp(point[2], section[:, 2], section[:, 1])
            # A chord of the formula's parabola lies within 4 mm of it.
            assert point[1] == pytest.approx(y, abs=4e-3)


def _profile(aft: float) -> LineSource:
    """The keel from a place to the stem, and up it; from 0 up the stern post, too."""
    up = [[LENGTH, 0.0, 0.5 * DEPTH], [LENGTH, 0.0, DEPTH]]
    keel = [[x, 0.0, 0.0] for x in np.linspace(aft, LENGTH, 9)]
    down = [] if aft else [[0.0, 0.0, DEPTH], [0.0, 0.0, 0.5 * DEPTH]]
    kind = np.full(len(down) + 11, int(PointKind.SMOOTH))
    kind[[len(down), len(down) + 8]] = PointKind.KNUCKLE
    points = np.array([*down, *keel, *up])
    return LineSource.make("boundary", "profile", points, kind=kind.tolist())


def test_a_drawn_profile_ends_deck_edge_and_waterlines() -> None:
    """Sections from 5 to 95 m between stem and stern: without these V was .26 % short."""
    sections = _sections(np.linspace(5.0, 95.0, 19))
    lofted = loft_sections([*sections, _profile(0.0)], 4.0, 0.005)
    assert lofted is not None
    assert [line.name for line in lofted.lines][:1] == ["deck edge"]
    for line in lofted.lines:
        assert line.points[[0, -1], 0] == pytest.approx([0.0, LENGTH])
        assert line.points[[0, -1], 1] == pytest.approx([0.0, 0.0])


def test_a_drawn_profile_that_ends_at_a_foot_ends_at_a_transom() -> None:
    """The aftmost section is its edge then, though she is immersed there."""
    lofted = loft_sections([*_sections(np.linspace(20.0, 95.0, 16)), _profile(20.0)], 4.0, 0.005)
    assert lofted is not None
    assert lofted.transom == "ST 20"
    # One that ends in the open tells nothing of a deck.
    assert loft_sections([*_sections(np.linspace(20.0, 95.0, 16)), _profile(10.0)], 4.0, 0.005) is (
        None
    )


def test_sections_and_a_profile_hold_the_volume_between_them(tmp_path: Path) -> None:
    """Digitised lines without a deck edge: V as the formula, by 10 sections and the profile."""
    rows = ["line,x,y,z"]
    for x in np.linspace(5.0, 95.0, 10):
        rows += [f"ST {x:g},{x:g},{y:.5f},{z:.5f}" for _, y, z in _wigley(x)[::2].tolist()]
    rows += [f"profile,{x:g},{y:g},{z:g}" for x, y, z in _profile(0.0).points.tolist()]
    path = tmp_path / "lines.csv"
    path.write_text("\n".join(rows) + "\n")
    hull = ah.read(path, length=LENGTH, draught=DRAUGHT, strict=True)
    truth = 4.0 / 9.0 * LENGTH * 2.0 * HALF * DRAUGHT
    assert hull.hydrostatics().volume == pytest.approx(truth, rel=5e-4)
