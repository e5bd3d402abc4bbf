"""Surfaces joined to their masters: no gap, one normal, corners of three."""

import attrs
import numpy as np
import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.fit_surface import SurfaceFit, even_breaks, fit_surface
from assoc_hull.geometry.fitting.surface_joints import (
    Extent,
    Strip,
    SurfaceJoint,
    cut_out_part,
    join_to_masters,
    measure_joint,
    strip_of,
)
from assoc_hull.geometry.patches.spline_surface import SplineSurface

BODY: Extent = ((0.0, 10.0), (0.0, 6.0))
STEM: Extent = ((10.0, 14.0), (0.0, 3.5))
BULB: Extent = ((10.0, 14.0), (3.5, 6.0))


def shape(u: FloatArray, v: FloatArray) -> FloatArray:
    """A surface that no bicubic spline is, with y = 0 at v = 6."""
    return np.column_stack(
        [u + 0.1 * np.sin(v), np.sin(0.5 * (6.0 - v)) * (1.4 - 0.05 * u), np.cos(0.3 * v + 0.1 * u)]
    )


def fitted(name: str, extent: Extent, past: float, spans: tuple[int, int]) -> SurfaceFit:
    """A fit to points of the shape, with overlap over neighbours; borders keep both parameters."""
    (u0, u1), (v0, v1) = extent
    low, high = np.array([max(u0 - past, 0.0), max(v0 - past, 0.0)]), np.array([u1, v1])
    high = np.where([name == "body", name == "stem"], high + past, high)
    u, v = (np.linspace(a, b, 60) for a, b in zip(low, high, strict=True))
    lines = np.stack(np.meshgrid(np.append(u, u0), np.append(v, v0), indexing="ij"), axis=-1)
    uv = lines.reshape(-1, 2)
    held = np.repeat((uv == [u0, v0]).any(axis=1)[:, None], 2, axis=1)
    samples = Samples.of(uv, shape(*uv.T), 0.3, held=held)
    breaks = even_breaks(low[0], high[0], spans[0]), even_breaks(low[1], high[1], spans[1])
    return fit_surface(name, samples, *breaks, 1e-7, held=centre(*breaks), rounds=2)


def centre(u: FloatArray, v: FloatArray) -> HeldControls:
    """The last row in v stays at y = 0, where v ends at the centre plane."""
    holds = HeldControls.none((len(u) + 2, len(v) + 2))
    return holds.on("v1", 0.0, axes=(1,)) if v[-1] == 6.0 else holds


@attrs.frozen
class Three:
    """A body, and two blocks that meet a part of its side each, and one another."""

    body: SurfaceFit
    alone: dict[str, SurfaceFit]
    strips: dict[str, dict[str, Strip]]
    found: dict[str, SurfaceFit]

    def joint(self, name: str, side: str) -> SurfaceJoint:
        """How a block meets its master."""
        before, after = self.alone[name].surface, self.found[name].surface
        return measure_joint(side, self.strips[name][side], before, after)


@pytest.fixture(scope="module")
def three() -> Three:
    """All of them fitted with overlap, and joined: the stem to the body, the bulb to both."""
    body = cut_out_part(fitted("body", BODY, 1.0, (11, 9)), BODY)
    alone = {"stem": fitted("stem", STEM, 1.0, (5, 5)), "bulb": fitted("bulb", BULB, 1.0, (6, 4))}
    strips = {"stem": {"u0": strip_of(body.surface, "u1", STEM[1])}}
    found = {"stem": join_to_masters(alone["stem"], STEM, strips["stem"], centre)}
    strips["bulb"] = {
        "v0": strip_of(found["stem"].surface, "v1"),
        "u0": strip_of(body.surface, "u1", BULB[1]),
    }
    found["bulb"] = join_to_masters(alone["bulb"], BULB, strips["bulb"], centre)
    return Three(body, alone, strips, found)


BORDERS = [("stem", "u0"), ("bulb", "u0"), ("bulb", "v0")]


@pytest.mark.parametrize(("name", "side"), BORDERS)
def test_joined_surfaces_have_no_gap_and_one_normal(three: Three, name: str, side: str) -> None:
    """Borders agree to rounding, normals to a thousandth of a degree, corners among them."""
    found = three.joint(name, side)
    assert 1e-9 < found.gap[2] < 5e-4
    assert found.joined_gap < 1e-13
    assert found.angle[2] < 1e-3


def test_three_surfaces_meet_in_one_corner(three: Three) -> None:
    """Where body, stem and bulb meet all have one point; both slaves one derivative there."""
    stem, bulb = three.found["stem"].surface, three.found["bulb"].surface
    corner = three.body.surface.at(10.0, 3.5)
    assert np.abs(stem.net[0, -1] - corner).max() < 1e-13
    assert np.abs(bulb.net[0, 0] - corner).max() < 1e-13
    above = strip_of(stem, "u0").at(np.array([3.5]))[2]
    below = strip_of(bulb, "u0").at(np.array([3.5]))[2]
    assert above == pytest.approx(below, abs=1e-12)


@pytest.mark.parametrize("name", ["stem", "bulb"])
def test_a_joint_leaves_the_fit_as_good_as_it_was(three: Three, name: str) -> None:
    """What is given at borders costs the points no more than the gap; y = 0 stays to the bit."""
    alone, found = three.alone[name], three.found[name]
    inside = cut_out_part(alone, {"stem": STEM, "bulb": BULB}[name])
    assert len(found.residual) == len(inside.residual) < len(alone.residual)
    gap = max(three.joint(name, side).gap[2] for side in three.strips[name])
    assert found.residual.max() < inside.residual.max() + 1.2 * gap
    if name == "bulb":
        assert (found.surface.net[:, -1, 1] == 0.0).all()


def test_a_fit_without_masters_is_cut_only(three: Three) -> None:
    """The part of a fit has its points and is the surface of the fit, to rounding."""
    whole = fitted("body", BODY, 1.0, (11, 9))
    uv = three.body.samples.uv
    assert (uv <= [10.0, 6.0]).all()
    assert len(uv) < len(whole.samples)
    assert three.body.surface.at(*uv.T) == pytest.approx(whole.surface.at(*uv.T), abs=1e-13)
    assert (
        join_to_masters(whole, BODY, {}).surface.net.tobytes() == three.body.surface.net.tobytes()
    )


def test_a_strip_on_more_knots_is_the_same_curve(three: Three) -> None:
    """Knot insertion, a part of a border and another parameter leave curves where they are."""
    strip = three.strips["stem"]["u0"]
    more = strip.on(np.sort(np.append(strip.breaks, [0.2, 1.234, 1.234])))
    assert len(more.row) == len(more.breaks) + 2 == len(strip.row) + 3
    t = np.linspace(0.0, 3.5, 41)
    for one, other in zip(strip.at(t), more.at(t), strict=True):
        assert one == pytest.approx(other, abs=1e-13)
    u = np.full(41, 10.0)
    assert strip.at(t)[0] == pytest.approx(three.body.surface.at(u, t), abs=1e-13)
    assert strip.over(0.0, 7.0).at(2.0 * t)[0] == pytest.approx(strip.at(t)[0], abs=1e-13)


def test_the_speed_across_a_border_may_differ(three: Three) -> None:
    """A slave whose parameter runs half as fast takes the derivative of its master doubled."""
    alone = three.alone["stem"]
    slow = attrs.evolve(alone.samples, uv=alone.samples.uv * [0.5, 1.0])
    knots = alone.surface.knots_u
    breaks = 0.5 * knots[3:-3], alone.surface.knots_v[3:-3]
    fit = fit_surface("slow", slow, *breaks, 1e-8, rounds=1)
    found = join_to_masters(fit, ((5.0, 7.0), STEM[1]), three.strips["stem"])
    joint = measure_joint("u0", three.strips["stem"]["u0"], fit.surface, found.surface)
    assert joint.joined_gap < 1e-13
    assert joint.angle[2] < 1e-3
    across = strip_of(found.surface, "u0").across
    assert across[0] == pytest.approx(2.0 * three.strips["stem"]["u0"].across[0], rel=1e-2)


def test_a_strip_of_another_part_is_refused(three: Three) -> None:
    """A border that does not end where the side does is no border of it."""
    with pytest.raises(BadInputError, match="that of its master from"):
        join_to_masters(three.alone["stem"], STEM, {"u0": three.strips["bulb"]["u0"]})
    with pytest.raises(BadInputError, match="has a knot at"):
        three.strips["stem"]["u0"].on(np.array([0.0, 3.5]))


def test_the_angle_leaves_singular_corners_out(three: Three) -> None:
    """Where the normal of a joined surface goes to nil its direction counts for nothing."""
    strip, after = three.strips["stem"]["u0"], three.found["stem"].surface
    net = after.net.copy()
    # The derivative across the border goes back on itself at the end: no normal, then the opposite.
    net[1, -1] = net[0, -1] - 1e-3 * (net[1, -1] - net[0, -1])
    bent = SplineSurface("bent", (3, 3), after.knots_u, after.knots_v, net)
    found = measure_joint("u0", strip, three.alone["stem"].surface, bent)
    assert found.angle[2] < 0.1
    net[1, -1] = net[0, -1] - 0.2 * (after.net[1, -1] - net[0, -1])
    folded = SplineSurface("folded", (3, 3), after.knots_u, after.knots_v, net)
    assert measure_joint("u0", strip, three.alone["stem"].surface, folded).angle[2] > 90.0
