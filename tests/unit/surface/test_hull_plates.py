"""Plates of hulls: areas between planes and girths, what is contested, what fits leave open."""

from __future__ import annotations

from itertools import pairwise

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.hull.results import HullPlates as WritablePlates
from assoc_hull.surface.plating.hull_plate import CurvatureDoubt, doubled_band
from assoc_hull.surface.plating.hull_plates import HullPlateTable, hull_plates
from assoc_hull.surface.plating.hull_seams import HullSeams
from assoc_hull.surface.plating.hull_shell import HullShell
from assoc_hull.surface.plating.rival_fits import every_second_waterline
from tests.formula_sides import BOWL, HYPAR, Side

X, Z = (-12.0, 12.0), (-5.0, 5.0)
SEAMS = HullSeams(x=(-7.3, 1.1, 6.0), z=(-1.7, 2.9))


def level_of(side: Side) -> float:
    """A K0 that lines of the side have: 0.7 of the curvature in its middle."""
    return 0.7 * abs(float(side.gauss(np.zeros(1), np.zeros(1))[0]))


def plates_of(side: Side, seams: HullSeams = SEAMS, k0: float | None = None) -> HullPlateTable:
    """The plates of a side."""
    surface = side.surface(X, Z, (3, 2), "body")
    return hull_plates((surface,), seams, zero="absolute", k0=k0 or level_of(side))


@pytest.fixture(scope="module")
def bowl() -> HullPlateTable:
    """The plates of a convex side."""
    return plates_of(BOWL)


@pytest.mark.parametrize("side", [BOWL, HYPAR], ids=["convex", "saddle"])
def test_the_sides_are_those_of_the_formula(side: Side) -> None:
    """The surfaces that tests rely on: points, and normals to y > 0."""
    surface = side.surface(X, Z, (5, 3), "body")
    shell = HullShell.of((surface,))
    x, y, z = np.moveaxis(shell.nodes.place, -1, 0)
    assert np.abs(y - side.y(x, z)).max() < 1e-12
    assert shell.nodes.normal[..., 1].min() > 0.0
    assert shell.nodes.gauss == pytest.approx(side.gauss(x, z), rel=1e-9)


@pytest.mark.parametrize("side", [BOWL, HYPAR], ids=["convex", "saddle"])
def test_areas_of_plates_and_their_regions_are_those_of_the_formula(side: Side) -> None:
    """To a millionth of the plate: seams run across patches, lines K = K0 across seams."""
    found, k0 = plates_of(side), level_of(side)
    assert len(found) == 12
    for plate in found:
        assert plate.range is not None
        x = max(plate.range.x[0], X[0]), min(plate.range.x[1], X[1])
        z = max(plate.range.z[0], Z[0]), min(plate.range.z[1], Z[1])
        whole = side.area(x, z)
        assert plate.area == pytest.approx(whole, rel=1e-6)
        bent = plate.shares.convex + plate.shares.saddle
        assert bent == pytest.approx(side.area(x, z, k0) / whole, abs=2e-6)
        near = side.area(x, z, 0.5 * k0) - side.area(x, z, 2.0 * k0)
        assert plate.contested == pytest.approx(near / whole, abs=2e-6)
        assert (plate.shares.saddle if side is BOWL else plate.shares.convex) < 1e-12
    assert sum(0.01 < plate.shares.developable < 0.99 for plate in found) > 5


def test_plates_make_up_the_hull(bowl: HullPlateTable) -> None:
    """Their areas, and those of their regions, add up to those of the whole surface."""
    assert bowl.area == pytest.approx(bowl.regions.total, rel=1e-9)
    convex = sum(plate.area * plate.shares.convex for plate in bowl)
    assert convex == pytest.approx(bowl.regions.positive, rel=1e-6)


def test_plates_are_named_from_aft_and_from_below(bowl: HullPlateTable) -> None:
    """The place along the ship, then up the girth; with what ends them."""
    assert [plate.name for plate in bowl][:4] == ["1.1", "1.2", "1.3", "2.1"]
    assert str(bowl["2.2"].range) == "x -7.3 to 1.1 m, z -1.7 to 2.9 m"
    assert bowl[0] is bowl["1.1"]
    inside = plates_of(BOWL, attrs.evolve(SEAMS, inside=True))
    assert [str(plate.range) for plate in inside] == [
        str(plate.range) for plate in (bowl["2.2"], bowl["3.2"])
    ]
    assert [plate.area for plate in inside] == [bowl[name].area for name in ("2.2", "3.2")]


def test_a_plate_of_a_hull_has_an_extent_and_no_surface(bowl: HullPlateTable) -> None:
    """What it has with other plates says the same: area of all regions, heat where it is bent."""
    for plate in bowl:
        assert plate.extent is not None
        assert plate.range is plate.extent.range
        assert plate.surface is None
        regions = plate.areas
        assert plate.area == pytest.approx(regions.positive + regions.negative + regions.zero)
        assert plate.shares.convex == regions.positive_share
        assert plate.heating == (plate.shares.convex + plate.shares.saddle > 1e-6)
    assert bowl.surfaces == ()


def test_a_plate_of_a_hull_is_not_laid_flat_and_says_what_to_cut(bowl: HullPlateTable) -> None:
    """Following the advice, the surface is cut along its parameters."""
    with pytest.raises(BadInputError, match="no surface of its own"):
        bowl[0].development()
    cut = ah.surface.plates(BOWL.surface(X, Z, (3, 2), "body"), ah.surface.Seams(u=(0.0,)))
    assert [plate.development((3, 3)).name for plate in cut] == ["body 1", "body 2"]


def test_extents_and_axes_are_those_of_the_plate() -> None:
    """Of a plate of 8.4 by 4.6 m that is bent little: its length runs along the ship."""
    plate = plates_of(Side(8.0, 0.0, -5e-3, 0.0), k0=1e-3)["2.2"]
    assert plate.length == pytest.approx(8.4, abs=0.02)
    assert plate.breadth == pytest.approx(4.6, abs=0.02)
    assert abs(plate.axes[0, 0]) > 0.999
    assert plate.axes[2, 1] < -0.99


def test_narrow_plates_are_found_and_slivers_told() -> None:
    """Between nodes of the usual rule, with its extents; of millimetres it is no plate."""
    side = Side(8.0, 0.0, -5e-3, 0.0)
    narrow = plates_of(side, HullSeams(x=(1.0, 1.15), inside=True), k0=1e-3)[0]
    assert narrow.area == pytest.approx(side.area((1.0, 1.15), Z), rel=1e-6)
    assert narrow.breadth == pytest.approx(0.15, abs=2e-3)
    assert narrow.kind == "cylinder"
    found = plates_of(side, HullSeams(x=(1.0, 1.004)), k0=1e-3)
    assert [plate.name for plate in found] == ["1", "3"]
    assert found.slivers == pytest.approx(side.area((1.0, 1.004), Z), rel=1e-4)
    assert "narrower than a few centimetres" in str(found)


def test_seams_of_girth_part_a_cylinder_by_its_arc() -> None:
    """A trough y = f(z): the breadth of a plate is the arc between its seams, to a millimetre."""
    side = Side(6.0, 0.0, -6e-2, 0.0)
    surface = side.surface((0.0, 30.0), (-5.0, 5.0), (4, 6), "body")
    places = (1.0, 2.5, 7.0)
    found = hull_plates((surface,), HullSeams(x=(10.0, 20.0), girth=places, inside=True))
    assert [plate.name for plate in found] == ["1.1", "1.2"]
    for plate, (low, high) in zip(found, pairwise(places), strict=True):
        assert plate.area == pytest.approx(10.0 * (high - low), abs=0.012)
        assert plate.kind == "cylinder"
        assert plate.roll_axis == pytest.approx(0.0, abs=1e-6)


def test_girth_goes_on_from_a_block_below() -> None:
    """A stem above a bulb, at the same sections: its girth counts on from that of the bulb."""
    side = Side(5.0, 0.0, 0.0, 0.0)
    bulb = side.surface((0.0, 6.0), (0.0, 3.0), (2, 2), "bow bulb")
    stem = side.surface((0.0, 6.0), (4.0, 9.0), (2, 2), "bow stem")
    shell = HullShell.of((bulb, stem), girth=True)
    z, girth = shell.nodes.place[..., 2], shell.at("girth", np.arange(8))
    assert np.where(z < 3.5, z, z - 1.0) == pytest.approx(girth, abs=1e-9)


def test_what_lies_beside_a_border_of_blocks_is_unresolved() -> None:
    """One span on either side of the border, and at no other side of a block."""
    side = Side(8.0, 0.0, -1e-2, 0.0)
    aft = side.surface((0.0, 12.0), Z, (6, 2), "body")
    fore = side.surface((12.0, 20.0), Z, (2, 4), "bow")
    (plate,) = hull_plates((aft, fore), HullSeams(z=(-4.0, 4.0), inside=True))
    assert plate.blocks == ("body", "bow")
    assert plate.shares.unresolved == pytest.approx((2.0 + 4.0) / 20.0, abs=1e-6)
    assert plate.kind is None
    assert plate.order is None
    assert "30 % of it lies within a span of a border" in plate.notes[0]
    (alone,) = hull_plates((aft,), HullSeams(z=(-4.0, 4.0), inside=True))
    assert (alone.shares.unresolved, alone.kind) == (0.0, "cylinder")


def test_corners_with_tangent_sides_are_unresolved() -> None:
    """The span in such a corner, which the fit names."""
    surface = Side(8.0, 0.0, -1e-2, 0.0).surface((0.0, 12.0), Z, (6, 2), "body")
    shell = HullShell.of((surface,), (((0.0, -5.0),),))
    assert np.flatnonzero(shell.margin).tolist() == [0]


def test_a_plate_about_the_limit_has_the_class_of_the_surface_in_doubt() -> None:
    """With K between K0/2 and 2 K0 nearly everywhere, on any net: the best known, and its doubt."""
    found = plates_of(BOWL, HullSeams(x=(-2.0, 2.0), z=(-1.0, 1.0), inside=True), k0=7.5e-3)
    (plate,) = found
    assert plate.contested == pytest.approx(1.0, abs=1e-6)
    assert plate.is_doubtful
    assert plate.doubt == plate.contested + plate.changed
    clear = plates_of(BOWL, HullSeams(x=(-2.0, 2.0), z=(-1.0, 1.0), inside=True), k0=1e-4)[0]
    assert (clear.is_doubtful, clear.kind) == (False, "convex")
    assert plate.kind is not None
    assert plate.order is not None
    assert plate.suggestion.endswith("(in doubt on 100 % of it)")
    assert "class is that of the fitted surface, in doubt: 100 %" in plate.notes[0]
    assert f"{plate.kind} (in doubt on 100 %)" in str(plate)
    assert f" {plate.kind}? " in str(found)


def test_fits_that_disagree_widen_the_band() -> None:
    """K0 doubles until 95 % of the change is no more; without other fits it stays."""
    gauss, area = np.zeros(100), np.ones(100)
    change = np.linspace(0.0, 9.9e-3, 100)
    doubt = CurvatureDoubt.of(gauss, (gauss + change, gauss - 0.5 * change), area)
    assert doubt.dk == pytest.approx(9.4e-3)
    assert doubled_band(1e-3, doubt.dk) == 16e-3
    assert doubled_band(1e-3, 1e-3) == doubled_band(1e-3, None) == 1e-3
    assert doubt.changed(gauss, area, 5e-3, 2.0, 1.0) == pytest.approx(0.49)
    assert doubt.changed(gauss, area, 1.0, 2.0, 5e-3) == pytest.approx(0.49)
    lost = CurvatureDoubt.of(gauss, (np.where(change < 5e-3, np.nan, change),), area)
    assert lost.part == pytest.approx(0.5)


def test_a_patch_that_stays_is_taken_over_with_its_bits() -> None:
    """After a control point moves, 9 patches are computed again, and all is as from scratch."""
    surface = BOWL.surface(X, Z, (8, 5), "body")
    net = surface.net.copy()
    net[4, 3, 1] += 0.02
    moved = SplineSurface("body", surface.degrees, surface.knots_u, surface.knots_v, net)
    old, fresh = (hull_plates((each,), SEAMS) for each in (surface, moved))
    again = hull_plates((moved,), SEAMS, previous=old)
    assert (old.computed, again.computed) == (40, 9)
    assert again.table() == fresh.table()
    assert again.table() != old.table()


@pytest.mark.parametrize(
    ("values", "error"),
    [
        pytest.param({"x": (2.0, 1.0)}, BadInputError, id="falling"),
        pytest.param({"x": (1.0, 1.0002)}, BadInputError, id="a tenth of a millimetre"),
        pytest.param({"z": object()}, BadInputError, id="no number"),
        pytest.param({"girth": float("nan")}, BadInputError, id="nan"),
        pytest.param({"inside": 1}, WrongTypeError, id="no truth"),
    ],
)
def test_seams_are_checked(values: dict[str, object], error: type[Exception]) -> None:
    """Places in m that rise by a millimetre."""
    with pytest.raises(error, match="in HullSeams"):
        HullSeams(**values)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        pytest.param({"zero": "exact"}, "zero is 'exact'", id="no band"),
        pytest.param({"breadth": None}, "share one band", id="own breadths"),
        pytest.param({"others": [1]}, "others", id="no fits"),
        pytest.param({"previous": 1}, "previous", id="no plates"),
        pytest.param(
            {"seams": HullSeams(x=(500.0, 510.0), inside=True)}, "no plate lies", id="off"
        ),
        pytest.param({"surface": ()}, "surface is empty", id="no surface"),
    ],
)
def test_what_is_no_hull_with_seams_is_refused(options: dict[str, object], told: str) -> None:
    """By name."""
    given: dict[str, object] = {"surface": (BOWL.surface(X, Z, (1, 1), "body"),), "seams": SEAMS}
    given |= options
    with pytest.raises((BadInputError, WrongTypeError), match=told):
        hull_plates(**given)  # type: ignore[arg-type]


def test_a_plate_that_is_not_there_is_told(bowl: HullPlateTable) -> None:
    """By name, number or column."""
    for bad, error in (("9.9", UnknownNameError), (99, BadInputError), (None, WrongTypeError)):
        with pytest.raises(error):
            bowl[bad]  # type: ignore[index]
    with pytest.raises(UnknownNameError):
        bowl.column("weight")


def wigley_truth(low: float, high: float, top: float, k0: float) -> tuple[float, float, float]:
    """Area, convex and saddle share of the Wigley hull between two stations, below a waterline."""
    i, j = (np.arange(count) + 0.5 for count in (800, 800))
    x, z = low + (high - low) * i[:, None] / 800, top * j[None, :] / 800
    p, q = (x - 50.0) / 50.0, (z - 6.25) / 6.25
    a, b = 1.0 - p * p, 1.0 - q * q
    fx, fz = -10.0 * b * p / 50.0, -10.0 * a * q / 6.25
    fxx, fzz, fxz = -10.0 * b / 2500.0, -10.0 * a / 6.25**2, 20.0 * p * q / (50.0 * 6.25)
    element = np.sqrt(1.0 + fx**2 + fz**2)
    gauss = (fxx * fzz - fxz**2) / element**4
    convex, saddle = (float(element[where].sum()) for where in (gauss > k0, gauss < -k0))
    whole = float(element.sum())
    return whole * (high - low) * top / 800**2, convex / whole, saddle / whole


def test_plates_of_a_fitted_hull_are_those_of_its_formula() -> None:
    """The Wigley hull from its lines: shares within 2 points of those of the formula, and another
    fit, without every second waterline, tells how sure that is.
    """
    hull = ah.examples.wigley()
    seams = ah.surface.HullSeams(x=(20.0, 40.0), z=2.0)
    thinner = hull.surface(leave_out=every_second_waterline(hull.state))
    found = ah.surface.plates(hull.surface(), seams, zero="absolute", k0=5e-4, others=(thinner,))
    assert found.fits == 1
    assert isinstance(found, WritablePlates)
    for name, ends in (("1.1", (0.0, 20.0)), ("2.1", (20.0, 40.0)), ("3.1", (40.0, 100.0))):
        plate = found[name]
        area, convex, saddle = wigley_truth(*ends, 2.0, plate.k0)
        assert plate.area == pytest.approx(area, rel=2e-3)
        assert plate.shares.convex == pytest.approx(convex, abs=0.02)
        assert plate.shares.saddle == pytest.approx(saddle, abs=0.02)
        assert plate.dk is not None
        assert 1e-6 < plate.dk <= plate.k0
    assert found["1.1"].shares.saddle > 0.5
