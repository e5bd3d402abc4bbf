"""Series of the curves of hulls: closed forms, other routes to the same numbers, refusals."""

from __future__ import annotations

import contextlib
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import chebyshev as powers
from numpy.testing import assert_allclose

from assoc_hull.analysis.form.curve_transform import curve_transform
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.analysis.hydrostatics.section_areas import (
    area_curve,
    between_stations,
    sectional_areas,
    wet_extent,
)
from assoc_hull.errors import AssocHullError, BadInputError, ForeignPointError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.integrals.series import composite_rule, rule_on_pieces
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import examples
from tests.unit.test_bad_arguments import BAD

AREAS = "sectional areas"


@pytest.fixture(scope="module")
def wigley() -> Hull:
    """A hull whose waterlines and areas are parabolas over x; nothing here edits it."""
    return examples.wigley()


def by_nodes(hull: Hull, name: str, terms: int) -> FloatArray:
    """Chebyshev coefficients of a waterline by 256 classical nodes, each a cut of the line."""
    line = hull.lines[name]
    low, high = line.curves[0].ends[:, 0]
    theta = (np.arange(256) + 0.5) * np.pi / 256
    x = low + 0.5 * (high - low) * (np.cos(theta) + 1.0)
    y = np.array([line.meet(((1, 0, 0), each))[0, 1] for each in x.tolist()])
    k = np.arange(terms)
    found: FloatArray = (2.0 - (k == 0)) / 256 * (np.cos(np.outer(k, theta)) * y).sum(axis=1)
    return found


def test_a_waterline_of_the_wigley_hull_is_a_parabola() -> None:
    """c = (1/2, 0, -1/2) and b_1 = 32 / pi^3 times the half breadth; its splines are that near.

    What their free ends are off falls with the square of the distance of the stations.
    """
    off = []
    for stations in (21, 41):
        dense = examples.wigley(stations=stations)
        found = curve_transform(dense, "WL 2.5", terms=6, relative=True)
        off.append(np.abs(found.coefficients - np.array([0.5, 0, -0.5, 0, 0, 0])).max())
    assert off[1] < 1e-4
    assert off[0] > 3.5 * off[1]
    assert found.unit == pytest.approx(5.0 * (1.0 - 0.6**2), rel=1e-4)
    sine = curve_transform(dense, "WL 2.5", "sine", 3)
    assert_allclose(sine.coefficients / found.unit, [32 / np.pi**3, 0, 0.0382240408], atol=1e-4)
    assert (found.low, found.high) == pytest.approx((0.0, 100.0))
    assert (found.along, found.across) == ("x", "y")
    assert (found.orders, sine.orders) == ((0, 1, 2, 3, 4, 5), (1, 2, 3))


@pytest.mark.parametrize("name", ["WL 0.5", "WL 1", "WL 1.25"])
def test_classical_nodes_agree_on_a_ship(series60_70: Hull, name: str) -> None:
    """256 nodes see a ship's waterline, kinks and all, to four decimals; so do the pieces."""
    found = curve_transform(series60_70, name, terms=12)
    assert_allclose(found.coefficients, by_nodes(series60_70, name, 12), atol=2e-4)
    assert_allclose(found.places[[0, -1], 0], [found.low, found.high], atol=1e-3)


@pytest.mark.parametrize(
    ("draughts", "heel"), [((6.25, 6.25), 0.0), ((7.5, 6.5), 0.0), ((7.0, 7.0), 8.0)]
)
def test_the_series_of_areas_holds_the_volume(
    series60_70: Hull, draughts: tuple[float, float], heel: float
) -> None:
    """The integral of many terms over the wetted length is the volume of the surface."""
    found = curve_transform(
        series60_70, AREAS, terms=120, draughts=draughts, heel_deg=heel, relative=False
    )
    k = np.arange(0, 120, 2)
    integral = (found.coefficients[k] * 2.0 / (1.0 - k**2)).sum()
    record = hydrostatics(series60_70, draughts=draughts, heel_deg=heel, estimate=False)
    volume = 0.5 * (found.high - found.low) * integral
    assert volume == pytest.approx(record.volume, rel=2e-6)
    relative = curve_transform(
        series60_70, AREAS, terms=4, draughts=draughts, heel_deg=heel, relative=None
    )
    assert relative.unit == pytest.approx(record.a_max, rel=1e-12)
    assert_allclose(relative.coefficients, found.coefficients[:4] / record.a_max, atol=1e-9)


def test_areas_of_a_ship_with_bulb_and_transom(bulk_carrier: Hull) -> None:
    """The wetted length ends at the bulb's tip, ahead of the waterline; the volume is all there."""
    found = curve_transform(bulk_carrier, AREAS, terms=200, relative=False)
    record = hydrostatics(bulk_carrier, estimate=False)
    assert found.high == pytest.approx(306.4, abs=1e-3)
    k = np.arange(0, 200, 2)
    volume = 0.5 * (found.high - found.low) * (found.coefficients[k] * 2.0 / (1.0 - k**2)).sum()
    assert volume == pytest.approx(record.volume, rel=1e-5)


def test_between_perpendiculars_the_range_is_that(series60_70: Hull) -> None:
    """What lies aft of AP is left out: the series is that of the part, end to end."""
    whole = curve_transform(series60_70, AREAS, terms=200)
    part = curve_transform(series60_70, AREAS, terms=200, span="perpendiculars")
    assert (part.low, part.high) == (0.0, series60_70.particulars.length)
    x = np.linspace(5.0, 115.0, 40)
    assert_allclose(part.evaluate(x), whole.evaluate(x), atol=1e-3)


def test_wet_reach_follows_the_plane(wigley: Hull) -> None:
    """The upright stem of the Wigley hull is wet at any draught; trimmed dry, it is not."""
    body, length = flotation(wigley.state), wigley.particulars.length
    level = planes_of([FloatingPosition(3.0, 3.0)], length)
    assert wet_extent(body, level) == pytest.approx((0.0, 100.0))
    with pytest.raises(BadInputError, match="nothing is under water"):
        wet_extent(body, planes_of([FloatingPosition(-1.0, -1.0)], length))
    out = planes_of([FloatingPosition(4.0, -1.0)], length)
    assert wet_extent(body, out) == pytest.approx((0.0, 80.0))


def test_a_curve_is_nil_beyond_its_ends(wigley: Hull) -> None:
    """A range longer than the line: the same curve, and nothing on both sides of it."""
    found = curve_transform(wigley, "WL 2.5", terms=60, span=(-50.0, 150.0))
    line = curve_transform(wigley, "WL 2.5", terms=60)
    x = np.linspace(0.0, 100.0, 21)
    assert_allclose(found.evaluate(x), line.evaluate(x), atol=found.truncation.largest[-1])
    assert_allclose(found.evaluate([-40.0, 130.0]), 0.0, atol=found.truncation.largest[-1])
    assert found.truncation.largest[-1] < 0.03 * line.evaluate(50.0)[0]
    part = curve_transform(wigley, "WL 2.5", terms=12, span=(20.0, 60.0))
    assert_allclose(part.evaluate([20.0, 40.0]), line.evaluate([20.0, 40.0]), atol=1e-4)


def test_a_section_over_its_height_and_around(series60_70: Hull) -> None:
    """Half breadth over z up to the draught; around, the area inside is that of the station."""
    name, draught = "ST 3", series60_70.particulars.draught
    up = curve_transform(series60_70, name, terms=200, span=(0.0, draught))
    assert (up.along, up.across) == ("z", "y")
    areas = sectional_areas(series60_70, FloatingPosition(draught, draught))
    wanted = float(areas.area[0, areas.names.index(name)])
    k = np.arange(0, 200, 2)
    assert draught * (up.coefficients[k] * 2.0 / (1.0 - k**2)).sum() == pytest.approx(
        wanted, rel=1e-5
    )
    around = curve_transform(series60_70, name, "fourier", 200, span=(0.0, draught))
    order = np.array(around.orders)
    area = np.pi * (order * np.abs(around.coefficients) ** 2).sum()
    assert area == pytest.approx(wanted, rel=2e-3)
    assert np.abs(np.real(around.coefficients)).max() <= 1e-9
    assert (around.along, around.across, around.low) == ("y", "z", 0.0)


def test_what_is_left_falls_and_is_what_is_left(wigley: Hull) -> None:
    """Of a sine series the rms never grows; the largest difference is met on the curve."""
    found = curve_transform(wigley, "WL 2.5", "sine", 20)
    assert (np.diff(found.truncation.rms) <= 1e-12).all()
    x, y = found.places.T
    for terms in (1, 7, 20):
        off = np.abs(found.evaluate(x, terms) - y).max()
        assert found.truncation.largest[terms - 1] == pytest.approx(off, rel=1e-6)
    around = curve_transform(wigley, "ST 5", "fourier", 20)
    begin, end = around.evaluate([0.0, around.high], 5)
    assert_allclose(begin, end, atol=1e-12)


def test_a_line_a_curve_and_an_address_are_one(wigley: Hull) -> None:
    """Handles and names lead to the same numbers; frozen."""
    line = wigley.lines["WL 2.5"]
    found = [curve_transform(wigley, each).coefficients for each in
             (line, line.curves[0], "WL 2.5", "waterlines/WL 2.5")]  # fmt: skip
    for each in found[1:]:
        assert_allclose(each, found[0], atol=0.0)
    assert not found[0].flags.writeable


def test_axes_may_be_chosen(wigley: Hull) -> None:
    """One given, the other is the one that is left of the usual two; z over y, say."""
    found = curve_transform(wigley, "ST 5", terms=5, along="y")
    assert (found.along, found.across) == ("y", "z")
    assert curve_transform(wigley, "ST 5", terms=5, across="z").along == "y"
    c = np.asarray(found.coefficients)
    whole = curve_transform(wigley, "ST 5", terms=80, along="y", across="z")
    assert_allclose(powers.chebval(0.0, np.asarray(whole.coefficients)), found.evaluate(
        0.5 * (found.low + found.high))[0], atol=0.2)  # fmt: skip
    assert_allclose(whole.coefficients[:5], c, atol=1e-12)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"curve": "profile"}, r"it runs back by 6.6 m near x 299.8.* m, in .* of profile; it is"),
        ({"curve": "ST 20.04"}, r"no curve from z 14.6.* to 19.3.* m, .*; take one of its curves"),
        ({"curve": "ST 20.04", "kind": "fourier"}, r"its curves lie 4.76 m apart"),
        ({"curve": "BTK 6", "kind": "fourier"}, r"BTK 6 has no mirror image in x and z"),
        ({"curve": AREAS, "kind": "fourier"}, r"sectional areas, .*'chebyshev' or 'sine'"),
        ({"curve": AREAS, "along": "x"}, r"sectional areas, .*no axes"),
        ({"curve": "WL 10", "draught": 5.0}, r"a floating position is given with a line"),
        ({"curve": "WL 10", "span": (60.0, 20.0)}, r"span is \(60.0, 20.0\)"),
        ({"curve": "WL 10", "span": (900.0, 920.0)}, r"no extent along x in the span"),
        ({"curve": "WL 10", "along": "z"}, r"no extent along z"),
        ({"curve": "WL 10", "along": "x", "across": "x"}, r"along and across are both x"),
        ({"curve": "WL 10", "kind": "fourier", "relative": True}, r"relative to the largest"),
        ({"curve": "profile", "span": (20.0, 200.0), "across": "y", "relative": True}, r"y is nil"),
        ({"curve": "waterlines"}, r"give a Line, a Curve"),
        ({"curve": "WL 10", "terms": 0}, r"terms is 0"),
    ],
)
def test_what_is_no_series_is_refused(
    bulk_carrier: Hull, given: dict[str, Any], message: str
) -> None:
    """With what is wrong, where, and what to do."""
    with pytest.raises(BadInputError, match=message):
        curve_transform(bulk_carrier, **given)


def test_other_hulls_and_positions_are_refused(wigley: Hull, series60_70: Hull) -> None:
    """A line of another hull; a draught at which she does not float; a place off the range."""
    with pytest.raises(ForeignPointError):
        curve_transform(wigley, series60_70.lines["WL 1"])
    with pytest.raises(OutOfRangeError):
        curve_transform(wigley, AREAS, draught=99.0)
    found = curve_transform(wigley, "WL 2.5")
    with pytest.raises(BadInputError, match="outside 0 to 100 m"):
        found.evaluate(101.0)
    with pytest.raises(BadInputError, match="terms is 13"):
        found.evaluate(10.0, 13)


@pytest.mark.parametrize(
    "name",
    ["curve", "kind", "terms", "along", "across", "span", "relative", "draught", "draughts",
     "heel_deg"],
)  # fmt: skip
@pytest.mark.parametrize("value", BAD.values(), ids=BAD)
def test_nothing_is_taken_amiss(wigley: Hull, name: str, value: object) -> None:
    """An error of the family, or a result."""
    given: dict[str, Any] = {"curve": AREAS, "terms": 2, name: value}
    for each in (given, {"curve": "WL 2.5", **given} if name != "curve" else given):
        with contextlib.suppress(AssocHullError):
            curve_transform(wigley, **each)


def test_a_heeled_ship_is_wet_as_far_to_either_side(bulk_carrier: Hull) -> None:
    """At 35 degrees a corner of the transom, at x = -5, is wet, which upright is dry."""
    body, length = flotation(bulk_carrier.state), bulk_carrier.particulars.length
    reach = [
        wet_extent(body, planes_of([FloatingPosition(18.2, 18.2, heel)], length))
        for heel in (0.0, 35.0, -35.0)
    ]
    assert reach[1] == reach[2]
    assert reach[1][0] == pytest.approx(-5.0, abs=1e-9)
    assert reach[0][0] > -4.9


def test_a_part_that_begins_between_stations_does_so(bulk_carrier: Hull) -> None:
    """The skeg of the bulk carrier begins upright at x = 6: aft of it a section has none of it.

    With the place as a break, the areas between the two stations there hold their volume.
    """
    body = flotation(bulk_carrier.state)
    draught = bulk_carrier.particulars.draught
    planes = planes_of([FloatingPosition(draught, draught)], bulk_carrier.particulars.length)
    curve = area_curve(body, planes)
    edges = np.array([4.2, 6.0, 6.75])
    assert np.abs(curve.breaks[:, None] - edges).min(axis=0) == pytest.approx([0, 0, 0], abs=1e-9)
    x, weights = rule_on_pieces(edges, *composite_rule(1))
    found = (weights * curve.at(x)).sum()
    whole = between_stations(body, 4.2, 6.75, planes).volume[0]
    assert found == pytest.approx(float(whole), rel=1e-6)
    before, after = curve.at(np.array([6.0 - 1e-9, 6.0 + 1e-9]))
    assert after - before > 1.0
