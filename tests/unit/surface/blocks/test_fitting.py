"""A surface through the lines of a small hull by formula, and what is told of it."""

import json
from collections.abc import Callable

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.hull import Hull
from assoc_hull.hull.results import HullSurface
from assoc_hull.surface.blocks.fitted_surface import FORMAT


@pytest.fixture(scope="module")
def small() -> Hull:
    """Wigley's hull with few lines."""
    return ah.examples.wigley(stations=11, waterlines=6)


@pytest.fixture(scope="module")
def found(small: Hull) -> HullSurface:
    """Its surface."""
    return small.surface()


def test_it_follows_the_formula_between_the_lines(shipped: Callable[[str], Hull]) -> None:
    """Up to the highest waterline the half-breadth is that of the formula to 5 mm of 5 m."""
    (side,) = shipped("wigley").surface().patches
    (u0, u1), (v0, v1) = side.domain
    u, v = np.meshgrid(np.linspace(u0, u1, 80), np.linspace(v0, v1, 40))
    x, y, z = side.at(u, v).reshape(-1, 3).T
    truth = 5.0 * (1.0 - (x / 50.0 - 1.0) ** 2) * (1.0 - (z / 6.25 - 1.0) ** 2)
    assert np.abs(y - truth)[z < 6.25].max() < 0.005


def test_normals_point_out_of_the_hull(found: HullSurface) -> None:
    """S_u x S_v points to starboard of the centre plane's port side: to y > 0."""
    (side,) = found.patches
    (u0, u1), (v0, v1) = side.domain
    u, v, step = 0.5 * (u0 + u1), 0.5 * (v0 + v1), 1e-4
    along = side.at(u + step, v) - side.at(u, v)
    down = side.at(u, v + step) - side.at(u, v)
    assert np.cross(along, down)[1] > 0.9 * step**2


def test_the_keel_lies_in_the_centre_plane(found: HullSurface) -> None:
    """The border on the profile has y = 0 to the last bit."""
    (side,) = found.patches
    assert not side.net[:, -1, 1].any()


def test_the_same_lines_give_the_same_bits(small: Hull, found: HullSurface) -> None:
    """The surface is a pure function of the lines."""
    again = small.surface()
    assert again.patches[0].net.tobytes() == found.patches[0].net.tobytes()
    assert str(again) == str(found)


def test_residuals_are_those_of_the_points(found: HullSurface) -> None:
    """The table sums up distances that anyone can measure: to the nearest place of the surface."""
    (block,) = found.blocks
    assert block.distance.max() == block.fitted.largest
    worst = block.samples.point[int(block.distance.argmax())]
    assert block.fitted.place.tolist() == worst.tolist()
    u, v = block.samples.uv.T
    away = np.linalg.norm(block.surface.at(u, v) - block.samples.point, axis=1)
    assert np.allclose(away, block.distance, atol=1e-12)
    assert f"{1e3 * block.fitted.p95:9.2f}" in str(found.residuals)
    assert len(found.residuals) == 1


def test_the_report_is_plain_values(found: HullSurface) -> None:
    """What programs get can be written as JSON as it stands."""
    document = found.document()
    assert document["format"] == FORMAT
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["blocks"][0]["residuals"][0]["count"] == len(found.blocks[0].samples)


def test_a_line_left_out_is_measured_only(small: Hull) -> None:
    """It has no point in the fit, and its distances stand in a row of their own."""
    found = small.surface(leave_out=["WL 2.5"])
    (block,) = found.blocks
    used = {found.net.name[line] for line in block.samples.line.tolist()}
    assert "WL 2.5" not in used
    assert block.left_out is not None
    assert (block.left_out.kind, block.left_out.line) == ("left out", "WL 2.5")
    assert 0.0 < block.left_out.p95 < 0.01


def test_an_unknown_line_cannot_be_left_out(small: Hull) -> None:
    """The nearest names are told."""
    with pytest.raises(ah.errors.UnknownNameError, match=r"'WL 2\.51'.*WL 2\.5"):
        small.surface(leave_out=["WL 2.51"])


def test_a_line_at_which_the_hull_ends_cannot_be_left_out(small: Hull) -> None:
    """Without its profile a half hull has no border."""
    with pytest.raises(ah.errors.BadInputError, match="profile is to be left out"):
        small.surface(leave_out=["profile"])


def test_it_is_stiffer_with_a_larger_penalty(small: Hull, found: HullSurface) -> None:
    """The penalty asked for is the one used, and moves the surface away from the lines."""
    stiff = small.surface(smoothing=100.0 * found.blocks[0].smoothing)
    assert stiff.blocks[0].smoothing == 100.0 * found.blocks[0].smoothing
    assert stiff.blocks[0].fitted.p95 > 2.0 * found.blocks[0].fitted.p95


def test_a_tolerance_that_is_not_kept_is_told(small: Hull) -> None:
    """A surface that keeps off its lines says by how much, and where."""
    found = small.surface(tolerance=1e-5, smoothing=1.0)
    (note,) = (each for each in found.blocks[0].notes if each.startswith("95 %"))
    assert "over the limit of 0.0 mm; the largest is" in note
    assert f"on {found.blocks[0].fitted.line}" in note


def test_a_hull_that_was_scaled_goes_by_the_length_of_its_lines() -> None:
    """Its particulars stay; tolerances and penalty do not, and a note says so."""
    model = ah.examples.wigley(stations=11, waterlines=6)
    with model.edit("model scale") as edit:
        edit.transform(scale=(0.04, 0.04, 0.04), planes="follow", drivers=["sections", "boundary"])
    found = model.surface()
    assert found.options.length == pytest.approx(4.0, abs=1e-9)
    assert found.notes == (
        "tolerances go by 4 m, the length of the lines: the particulars have 100 m",
    )
    assert found.whole[0].p95 < 0.01 * 0.008
