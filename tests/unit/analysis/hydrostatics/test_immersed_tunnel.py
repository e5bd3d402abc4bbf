"""Tunnels that a hull holds, in its hydrostatics: immersed in part, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import body_of, flotation
from assoc_hull.analysis.hydrostatics.immersed_tunnel import ImmersedTunnel
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from tests.cases.test_box_with_bilges import HALF, LENGTH, round_box
from tests.long_forms import draws

X, Z, RADIUS = 60.0, 4.5, 1.5


def plane(height: float, trim: float = 0.0, heel: float = 0.0) -> FloatingPlanes:
    """One plane, by its height at AP and the tangents of trim and heel."""
    return FloatingPlanes(np.array([height]), np.array([trim]), np.array([heel]))


def segment(depth: float) -> float:
    """The area of a circle below a level that stands so far over its centre."""
    d = min(max(depth, -RADIUS), RADIUS)
    return float(RADIUS**2 * np.arccos(-d / RADIUS) + d * np.sqrt(RADIUS**2 - d * d))


@pytest.fixture(scope="module")
def bare() -> ah.Hull:
    """A box with bilges."""
    return round_box()


@pytest.fixture(scope="module")
def box() -> ah.Hull:
    """The same with a tunnel, kept."""
    hull = round_box()
    with hull.edit("thruster") as edit:
        edit.tunnel("thruster", x=X, z=Z, radius=RADIUS)
    return hull


@settings(max_examples=draws(25), deadline=None)
@given(level=st.floats(2.5, 6.5))
def test_a_level_waterplane_leaves_a_segment_of_a_cylinder(box: ah.Hull, level: float) -> None:
    """Volume, its centre, waterplane with its moments, mouths less wall: closed forms."""
    found = ImmersedTunnel(box.tunnels["thruster"].shape).measure(plane(level))
    depth = min(max(level - Z, -RADIUS), RADIUS)
    area, chord = segment(depth), 2.0 * np.sqrt(RADIUS**2 - depth**2)
    expected = {
        "volume": 2.0 * HALF * area, "moment_x": 2.0 * HALF * area * X, "moment_y": 0.0,
        "moment_z": 2.0 * HALF * (area * Z - chord**3 / 12.0),
        "area": 2.0 * HALF * chord, "area_y": 0.0, "area_xy": 0.0,
        "area_xx": 2.0 * HALF * (chord * X**2 + chord**3 / 12.0),
        "area_yy": 2.0 / 3.0 * HALF**3 * chord,
        "shell": 2.0 * area - 4.0 * HALF * RADIUS * np.arccos(-depth / RADIUS),
    }  # fmt: skip
    for name, value in expected.items():
        assert float(found[name][0]) == pytest.approx(value, rel=1e-10, abs=1e-8), name


@settings(max_examples=draws(40), deadline=None)
@given(
    level=st.floats(2.0, 7.0), heel=st.floats(-60.0, 60.0), trim=st.floats(-0.05, 0.05),
)  # fmt: skip
def test_hydrostatics_are_those_of_the_box_less_the_immersed_part(
    bare: ah.Hull, box: ah.Hull, level: float, heel: float, trim: float
) -> None:
    """Slice by slice across the ship each is a segment of a disc: an integral over y alone."""
    slope = float(np.tan(np.radians(heel)))
    water = plane(level - trim * X, trim, slope)
    without, with_ = (body_of(each).measure(water) for each in (bare, box))
    # Turned by the trim, the water of a slice is a straight line at this distance of the centre.
    turn = 1.0 / np.sqrt(1.0 + trim * trim)

    def slice_(y: float, power: int) -> float:
        return float(y**power * segment((level - slope * y - Z) * turn))

    bends = [] if abs(slope) < 1e-9 else [
        y for s in (-1.0, 1.0) if abs(y := (level - Z - s * RADIUS / turn) / slope) < HALF
    ]  # fmt: skip
    exact = [
        quad(slice_, -HALF, HALF, (n,), points=bends or None, epsabs=1e-10, limit=200)[0]
        for n in (0, 1)
    ]
    assert without.volume[0] - with_.volume[0] == pytest.approx(exact[0], rel=1e-8, abs=1e-7)
    assert without.moment_y[0] - with_.moment_y[0] == pytest.approx(exact[1], rel=1e-8, abs=1e-6)


@settings(max_examples=draws(25), deadline=None)
@given(
    level=st.floats(1.8, 4.2), heel=st.floats(-0.8, 0.8), trim=st.floats(-0.03, 0.03),
)  # fmt: skip
def test_the_waterplane_is_how_the_volume_changes(
    wigley: ah.Hull, level: float, heel: float, trim: float
) -> None:
    """d volume / d height is the area in plan, d moment_y / d height its moment."""
    cut, step = ImmersedTunnel(wigley.tunnels["thruster"].shape), 1e-4
    at = level - 70.0 * trim
    low, mid, high = (cut.measure(plane(at + way, trim, heel)) for way in (-step, 0.0, step))
    for name, moved in (("area", "volume"), ("area_y", "moment_y"), ("area_x", "moment_x")):
        slope = float(high[moved][0] - low[moved][0]) / (2.0 * step)
        scale = 70.0 if name == "area_x" else 1.0
        # Where the water leaves the disc the area goes as the root of the way: 0.08 m2 over 0.1 mm.
        assert float(mid[name][0]) == pytest.approx(slope, rel=1e-2, abs=0.1 * scale)


@pytest.fixture(scope="module")
def wigley() -> ah.Hull:
    """A hull whose sides are nowhere upright at the tunnel."""
    hull = ah.examples.wigley()
    with hull.edit("thruster") as edit:
        edit.tunnel("thruster", x=70.0, z=3.0, radius=1.0)
    return hull


@pytest.mark.parametrize(
    ("height", "trim", "heel"),
    [(3.2, 0.0, 0.0), (1.0, 0.03, 0.0), (3.0, 0.0, 0.2), (3.5, 0.001, -0.35), (2.0, 0.01, 1.5)],
    ids=["level", "trimmed", "heeled", "trimmed and heeled to port", "steeply heeled"],
)
def test_a_tunnel_in_a_wigley_hull_is_cut_as_its_formula(
    wigley: ah.Hull, height: float, trim: float, heel: float
) -> None:
    """Against a sum over small squares of the formula of the hull, 2 mm each way."""
    count = 1000
    at = (np.arange(count) + 0.5) * 2.0 / count - 1.0
    x, z = np.meshgrid(70.0 + at, 3.0 + at)
    y = 5.0 * (1.0 - ((x - 50.0) / 50.0) ** 2) * (1.0 - ((z - 6.25) / 6.25) ** 2)
    over = height + trim * x - z
    wet = np.clip(over / abs(heel) if heel else np.where(over > 0.0, np.inf, -np.inf), -y, y)
    part = ((x - 70.0) ** 2 + (z - 3.0) ** 2 < 1.0) * (2.0 / count) ** 2
    found = ImmersedTunnel(wigley.tunnels["thruster"].shape).measure(plane(height, trim, heel))
    assert float(found["volume"][0]) == pytest.approx(float(((wet + y) * part).sum()), rel=1e-4)
    turned = np.copysign(1.0, heel) * float((0.5 * (wet * wet - y * y) * part).sum())
    assert float(found["moment_y"][0]) == pytest.approx(turned, abs=1e-3)


def test_both_sides_of_a_heel_are_mirror_images(wigley: ah.Hull) -> None:
    """And a heel of next to nothing is none."""
    cut = ImmersedTunnel(wigley.tunnels["thruster"].shape)
    one, other, none, least = (
        cut.measure(plane(2.5, 0.01, heel)) for heel in (0.3, -0.3, 0.0, 1e-9)
    )
    for name, value in one.items():
        sign = -1.0 if name in ("moment_y", "area_y", "area_xy") else 1.0
        assert float(other[name][0]) == pytest.approx(sign * float(value[0]), rel=1e-12, abs=1e-12)
        assert float(least[name][0]) == pytest.approx(float(none[name][0]), rel=1e-6, abs=1e-5)


def test_a_tunnel_that_is_kept_counts_as_its_appendage_where_it_is_all_wet(
    bare: ah.Hull, box: ah.Hull
) -> None:
    """And stations are less by the hole; asked for both it is refused."""
    tunnel = bare.tunnel("thruster", x=X, z=Z, radius=RADIUS)
    less = bare.hydrostatics(draught=6.5, appendages=[tunnel.appendage])
    found = box.hydrostatics(draught=6.5)
    for name in ("volume", "lcb", "kb", "wetted_surface", "waterplane_area"):
        assert getattr(found, name) == pytest.approx(getattr(less, name), rel=1e-11), name
    areas = [body_of(each).stations(plane(6.5)).area[0] for each in (bare, box)]
    assert (areas[0] == areas[1]).all()  # no station stands within it
    with box.edit("under a station") as edit:
        edit.set_tunnel("thruster", x=51.0)
    half = np.sqrt(RADIUS**2 - 1.0)
    for level, depth in ((6.5, 2.0 * half), (Z, half), (2.5, 0.0)):
        area = [body_of(each).stations(plane(level)).area[0, 1] for each in (bare, box)]
        assert area[0] - area[1] == pytest.approx(2.0 * HALF * depth, abs=1e-9)
    box.undo()
    with pytest.raises(BadInputError, match="'thruster' is a tunnel that the hull holds"):
        box.hydrostatics(draught=6.5, appendages=[tunnel.appendage])


def test_tables_stability_and_bonjean_curves_take_it_off_as_well(
    bare: ah.Hull, box: ah.Hull
) -> None:
    """All ask one floating body; two demihulls have a tunnel each."""
    draughts = [2.5, 4.5, 6.5]
    less = 2.0 * HALF * np.array([segment(t - Z) for t in draughts])
    tables = [each.hydrostatic_table(draughts) for each in (bare, box)]
    gone = tables[0].columns["volume"] - tables[1].columns["volume"]
    assert gone == pytest.approx(less, abs=1e-9)
    assert "thruster" in str(dict(tables[1].header.lines()))
    twins = [
        each.hydrostatics(draught=4.5, demihulls=2, separation=30.0).volume for each in (bare, box)
    ]
    assert twins[0] - twins[1] == pytest.approx(2.0 * less[1], abs=1e-8)
    weight = float(tables[1].columns["displacement"][2])
    assert box.immersion(weight).draught_aft == pytest.approx(6.5, abs=1e-8)
    with box.edit("under a station") as edit:
        edit.set_tunnel("thruster", x=50.0)
    curves = [each.bonjean(5) for each in (bare, box)]
    box.undo()
    gone = (curves[0].stations.area - curves[1].stations.area)[:, 1]
    wet = np.clip(curves[0].z - Z + RADIUS, 0.0, 2.0 * RADIUS)
    assert gone == pytest.approx(2.0 * HALF * wet, abs=1e-9)
    turned = (curves[0].moment - curves[1].moment)[:, 1]
    assert turned == pytest.approx(2.0 * HALF * wet * (Z - RADIUS + 0.5 * wet), abs=1e-8)


def test_what_is_told_of_the_form_is_that_of_the_bare_hull(bare: ah.Hull, box: ah.Hull) -> None:
    """The moulded surface is the same object to every measure of the form."""
    level = plane(6.0)
    one, other = (flotation(each.state).measure(level).volume[0] for each in (bare, box))
    assert one == other
    assert one < LENGTH * 2.0 * HALF * 6.0
