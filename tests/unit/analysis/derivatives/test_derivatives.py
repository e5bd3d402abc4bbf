"""Derivatives of hydrostatics: against complex steps, central differences and known relations."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.derivatives.hydrostatic_derivatives import (
    Derivatives,
    hydrostatic_derivatives,
)
from assoc_hull.analysis.derivatives.parameters import (
    DRAUGHT,
    DRAUGHT_AFT,
    DRAUGHT_FORE,
    HEEL,
    TRIM,
    Deformation,
    Parameter,
    PointMove,
    Position,
)
from assoc_hull.analysis.hydrostatics.floating_body import Appendage, planes_of
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import values_at
from assoc_hull.analysis.hydrostatics.record import FIELDS
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    FreedomError,
    PointRoleError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.quadrature import gauss
from assoc_hull.hull import Hull
from tests.long_forms import LONG
from tests.stepped import Floats

HULLS = {
    "wigley": "wigley", "series 60, 0.60": "series60_60", "series 60, 0.70": "series60_70",
    "carrier": "bulk_carrier",
}  # fmt: skip
POINTS = {
    "wigley": ["WL 2.5 x ST 7", "ST 6 x profile", "WL 5 x ST 19"],
    "series 60, 0.60": ["BTK 0.52 x ST 12", "WL 0.92 x ST 16.5", "ST 16 x deck edge"],
    "series 60, 0.70": ["WL 0.66 x ST 14", "WL 1 x ST 4", "ST 18.75 x flat of bottom"],
    "carrier": ["WL 6 x profile #2", "WL 15 x ST 19", "ST 10 x flat of bottom"],
}
"""Bilge, stern and bow, keel and stem."""

WHERE = {"even": (0.873, 0.873, 0.0), "inclined": (0.951, 0.813, 7.0)}
"""Draughts at the perpendiculars over the design draught, and heel."""


@pytest.fixture(scope="module")
def hulls(shipped: Callable[[str], Hull]) -> dict[str, Hull]:
    """All hulls that ship."""
    return {name: shipped(fixture) for name, fixture in HULLS.items()}


def stretch(hull: Hull) -> Deformation:
    """Longer, from midship on."""
    middle = 0.5 * hull.particulars.length
    axis = np.array([1.0, 0.0, 0.0])
    return Deformation("stretch", lambda xyz: (xyz - [middle, 0.0, 0.0]) * axis)


def bump(hull: Hull) -> Deformation:
    """Broader and deeper around one place of the afterbody, metres."""
    ship = hull.particulars
    centre = np.array([0.3 * ship.length, 0.4 * ship.breadth, 0.5 * ship.draught])
    reach = np.array([0.1 * ship.length, 0.5 * ship.breadth, 0.5 * ship.draught])

    def field(xyz: FloatArray) -> FloatArray:
        hump = np.exp(-(((xyz - centre) / reach) ** 2).sum(axis=1))[:, None]
        return np.asarray(np.array([0.0, 1.0, -0.3]) * hump * np.tanh(xyz / reach))

    return Deformation("bump", field, unit="m")


def shift(name: str, axis: int) -> Deformation:
    """All along an axis, metres."""
    return Deformation(name, lambda xyz: np.tile(np.eye(3)[axis], (len(xyz), 1)), unit="m")


def parameters(name: str, hull: Hull) -> list[Parameter]:
    """Of each kind."""
    points = [PointMove(each) for each in POINTS[name]]
    return [DRAUGHT, TRIM, DRAUGHT_AFT, HEEL, stretch(hull), bump(hull), *points]


def at(hull: Hull, where: str) -> tuple[Floats, dict[str, object]]:
    """The hull at a position, and what to call `hydrostatic_derivatives` with."""
    aft, fore, heel = WHERE[where]
    draught = hull.particulars.draught
    floats = Floats.of(hull, aft * draught, fore * draught, heel, 0.6 * draught)
    terms = {"draughts": (aft * draught, fore * draught), "heel_deg": heel, "kg": 0.6 * draught}
    return floats, terms


def derivatives(hull: Hull, wrt: list[Parameter], where: str) -> Derivatives:
    """What is tested."""
    return hydrostatic_derivatives(hull, wrt, **at(hull, where)[1])  # type: ignore[arg-type]


def scales(hull: Hull, found: Derivatives, parameter: Parameter) -> dict[str, float]:
    """How much a derivative may sensibly be: values and their sizes over that of the parameter."""
    ship = hull.particulars
    size = {"heel": 10.0, "stretch": 1.0}.get(parameter.title, ship.draught)
    least = {
        "lcb": ship.length, "lcf": ship.length, "lcb_percent": 100.0, "x_a_max": ship.length,
        "tcb": ship.breadth, "tcf": ship.breadth, "trim_by_stern": ship.draught,
        "i_lt": found.value.i_t, "i_lt_proj": found.value.i_t,
        "gmt": ship.draught, "gml": ship.length, "transom_area": 1e-3 * found.value.a_max,
    }  # fmt: skip
    return {
        name: max(abs(getattr(found.value, name) or 0.0), least.get(name, 0.0)) / size
        for name in FIELDS
    }


def agree(
    hull: Hull,
    found: Derivatives,
    k: int,
    parameter: Parameter,
    wanted: dict[str, float],
    tolerance: float,
) -> None:
    """Each field for itself; what is not a number in `wanted` has a kink."""
    sizes = scales(hull, found, parameter)
    for name in FIELDS:
        if getattr(found.value, name) is None:
            assert np.isnan(found.of(name)[k])
        elif not np.isnan(wanted[name]):
            off = abs(found.of(name)[k] - wanted[name])
            # The greatest of many breadths is not that of the same curve all the way.
            width = 10.0 if name in {"bwl", "cb_lwl"} else 1.0
            limit = width * tolerance * max(abs(wanted[name]), sizes[name])
            assert off <= limit, (parameter, name)


@pytest.mark.parametrize("where", WHERE)
@pytest.mark.parametrize("name", HULLS)
def test_they_are_those_of_a_complex_step(name: str, where: str, hulls: dict[str, Hull]) -> None:
    """Of every field by every kind of parameter, through a loft that is independent."""
    hull = hulls[name]
    wrt = parameters(name, hull)
    if name != "wigley":  # a complex step through many lines takes its time
        wrt = [HEEL, wrt[4 if where == "even" else 6]]
    floats, _ = at(hull, where)
    found = derivatives(hull, wrt, where)
    for k, parameter in enumerate(wrt):
        agree(hull, found, k, parameter, floats.stepped(parameter), 1e-12)


@pytest.mark.parametrize("where", WHERE)
@pytest.mark.parametrize("name", HULLS)
def test_they_are_those_of_central_differences(
    name: str, where: str, hulls: dict[str, Hull]
) -> None:
    """Of plain numbers: points are moved, lines lofted anew, cells put together as they were."""
    hull = hulls[name]
    wrt = parameters(name, hull)
    floats, _ = at(hull, where)
    found = derivatives(hull, wrt, where)
    of = {"wigley": range(len(wrt)), "carrier": (3, 4, 8)}.get(name, (0, 3, 5, 6))
    for k in of if LONG else of[-2:]:
        step = {"heel": 3e-4, "stretch": 3e-6}.get(wrt[k].title, 1e-5 * hull.particulars.draught)
        agree(hull, found, k, wrt[k], floats.central(wrt[k], step), 1e-7)


@pytest.mark.parametrize("name", HULLS)
@pytest.mark.parametrize("where", WHERE)
def test_volume_grows_by_the_waterplane(name: str, where: str, hulls: dict[str, Hull]) -> None:
    """By the mean draught its area, by the trim its moment about midship; centroids follow.

    As far as the rules along the ship are exact: both are sums, and these are differentiated.
    """
    hull = hulls[name]
    found = derivatives(hull, [DRAUGHT, TRIM, DRAUGHT_AFT, DRAUGHT_FORE], where)
    ship, value = hull.particulars, found.value
    area, volume = value.waterplane_area_proj, found.of("volume")
    assert_allclose(volume[0], area, rtol=1e-6)
    assert_allclose(volume[1], area * (0.5 - value.lcf / ship.length), atol=1e-6 * area)
    assert_allclose(volume[2] + volume[3], volume[0], rtol=1e-12)
    assert_allclose(0.5 * (volume[2] - volume[3]), volume[1], atol=1e-12 * area)
    moved = area * (value.lcf - value.lcb) / value.volume
    assert_allclose(found.of("lcb")[0], moved, atol=1e-6 * ship.length)
    assert_allclose(found.of("displacement"), 1.025 * volume, rtol=1e-12)


@pytest.mark.parametrize("name", HULLS)
def test_a_hull_that_grows_keeps_its_shape(name: str, hulls: dict[str, Hull]) -> None:
    """Everything by 1 + e from midship, with the draught: V by 3 e, areas by 2 e, lengths by e."""
    hull = hulls[name]
    middle = np.array([0.5 * hull.particulars.length, 0.0, 0.0])
    whole = Deformation(
        "size", lambda xyz: xyz - middle, lambda xyz: np.tile(np.eye(3), (len(xyz), 1, 1))
    )
    found = derivatives(hull, [whole, DRAUGHT], "even")
    draught = found.value.draught_mean
    powers = {
        "volume": 3, "wetted_surface": 2, "waterplane_area": 2, "a_midship": 2, "a_max": 2,
        "i_t": 4, "i_l": 4, "lcb_percent": 1, "kb": 1, "bmt": 1, "bml": 1, "lwl": 1, "bwl": 1,
        "cb": 2, "cw": 2, "cm": 1, "cp": 1, "cvp": 0, "cb_lwl": 0, "cp_lwl": 0,
    }  # fmt: skip
    for field, power in powers.items():
        grown = found.of(field)[0] + draught * found.of(field)[1]
        value = getattr(found.value, field)
        size = max(abs(value), 1e-3)
        assert_allclose(grown, power * value, rtol=0.0, atol=1e-9 * size, err_msg=field)


@pytest.mark.parametrize("where", WHERE)
def test_a_hull_that_is_shifted_floats_as_it_did(where: str, hulls: dict[str, Hull]) -> None:
    """Forward, or upward with the water: centroids go along, all else stays."""
    hull = hulls["series 60, 0.60"]
    forward, upward = shift("forward", 0), shift("upward", 2)
    found = derivatives(hull, [forward, upward, DRAUGHT, TRIM], where)
    value, ship = found.value, hull.particulars
    # The plane goes forward with the hull where it has trim: by this much it falls at midship.
    back = value.trim_by_stern / ship.length
    for field, along, up in (
        ("volume", 0, 0), ("i_t", 0, 0), ("wetted_surface", 0, 0), ("tcb", 0, 0),
        ("lcb", 1, 0), ("lcf", 1, 0), ("kb", 0, 1), ("lwl", 0, 0),
    ):  # fmt: skip
        size = abs(getattr(value, field)) + ship.length
        forth, high, deeper, _ = found.of(field)
        assert_allclose(forth + back * deeper, along, atol=1e-9 * size, err_msg=field)
        assert_allclose(high + deeper, up, atol=1e-9 * size, err_msg=field)


@pytest.mark.parametrize("name", HULLS)
def test_a_longer_hull_holds_more(name: str, hulls: dict[str, Hull]) -> None:
    """In proportion; nearly, as the chord lengths of curves do not all grow alike."""
    hull = hulls[name]
    found = derivatives(hull, [stretch(hull)], "even")
    assert_allclose(found.of("volume")[0], found.value.volume, rtol=1e-3)
    assert_allclose(found.of("waterplane_area")[0], found.value.waterplane_area, rtol=1e-3)


@pytest.mark.parametrize("name", ["wigley", "series 60, 0.60"])
def test_the_volume_changes_by_what_the_surface_sweeps(name: str, hulls: dict[str, Hull]) -> None:
    """Hadamard: the integral of the field's normal component over the wetted surface; nearly."""
    hull = hulls[name]
    field = bump(hull)
    found = derivatives(hull, [field], "even")
    strips = at(hull, "even")[0].body.strips
    nodes, weights = gauss(20)
    strip, v = np.repeat(np.arange(strips.count), 20), np.tile(nodes, strips.count)
    curves = strips.curves(strip, v)
    u = (np.arange(60) + 0.5) / 60.0
    power, slope = (u[:, None] ** np.arange(4), np.arange(4) * u[:, None] ** [0, 0, 1, 2])
    place, rise = power @ curves.point, slope @ curves.point
    normal = np.cross(rise, power @ curves.across)
    flux = (field.field(place.reshape(-1, 3)).reshape(place.shape) * normal).sum(axis=2)
    share = np.tile(weights, strips.count)[
        np.repeat(np.arange(curves.count), np.diff(curves.start))
    ]
    wet = place[..., 2] <= found.value.draught_mean
    swept = 2.0 * ((flux * wet).mean(axis=1) * share).sum()
    assert_allclose(found.of("volume")[0], swept, rtol=5e-3)


def test_they_are_those_of_a_whole_edit(shipped: Callable[[str], Hull]) -> None:
    """The points that an edit moves, as it moves them; or one point, and the others follow."""
    hull, point, step = shipped("series60_60"), "WL 0.75 x ST 2", 2e-5
    floats, terms = at(hull, "inclined")
    place = hull.points[point].y
    values, places = [], []
    for sign in (1.0, -1.0):
        with hull.edit("a move") as edit:
            edit.move(point, y=place + sign * step)
        plane = planes_of([floats.position], hull.particulars.length)
        values.append(values_at(flotation(hull.state), plane, floats.header))
        places.append(hull.state.rows.xyz[: hull.state.rows.count])
        hull.undo()
    moved = Deformation("edit", lambda _: (places[0] - places[1]) / (2.0 * step), unit="m")
    wrt = [moved, PointMove(point, follow=True)]
    found = hydrostatic_derivatives(hull, wrt, **terms)  # type: ignore[arg-type]
    assert (places[0] != places[1]).any(axis=1).sum() > 100
    differences = {
        name: float((values[0][name] - values[1][name])[0]) / (2.0 * step) for name in FIELDS
    }
    for k, parameter in enumerate(wrt):
        agree(hull, found, k, parameter, differences, 1e-6)


def test_a_plane_through_knots_has_derivatives(hulls: dict[str, Hull]) -> None:
    """On a waterline all cuts are ends of tiles; there the wetted surface grows as elsewhere."""
    rates = [
        hydrostatic_derivatives(hulls["wigley"], [DRAUGHT], draught=draught).of("wetted_surface")[0]
        for draught in (5.0 - 1e-4, 5.0, 5.0 + 1e-4)
    ]
    assert_allclose(rates[1], 0.5 * (rates[0] + rates[2]), rtol=1e-5)


def test_a_parameter_alone_is_as_among_others(hulls: dict[str, Hull]) -> None:
    """In any order, of any number."""
    hull = hulls["wigley"]
    points = [PointMove(f"WL {z} x ST {x}") for z in (2.5, 5) for x in (3, 5, 7, 9, 11)]
    wrt = [points[0], HEEL, *points[1:], DRAUGHT]
    found = derivatives(hull, wrt, "inclined")
    assert found.names == tuple(each.title for each in wrt)
    assert found.units == ("m", "deg", *["m"] * 10)
    for k in (0, 1, 5, 11):
        alone = derivatives(hull, [wrt[k]], "inclined")
        for name in FIELDS:
            one, among = alone.of(name)[0], found.of(name)[k]
            assert one == among or abs(one - among) <= 1e-12 * abs(one) + 1e-15 or np.isnan(one)


def test_options_count(hulls: dict[str, Hull]) -> None:
    """Water, appendages and the transom enter as they enter the record; Lpp and B are held."""
    hull, fin = hulls["wigley"], Appendage("fin", 5.0, (50.0, 0.0, 1.0), 3.0)
    bare = hydrostatic_derivatives(hull, [DRAUGHT], draught=5.0)
    found = hydrostatic_derivatives(
        hull, [DRAUGHT], draught=5.1, rho=1.0, appendages=[fin], keel_thickness=0.1,
        draught_to="keel", transom=True,
    )  # fmt: skip
    assert found.value.draught_mean == pytest.approx(5.0)
    assert_allclose(found.of("volume"), bare.of("volume"), rtol=1e-12)
    assert_allclose(found.of("tpc") * 1.025, bare.of("tpc"), rtol=1e-12)
    assert found.of("kb")[0] != bare.of("kb")[0]
    assert np.isnan(found.of("gmt")[0])
    assert found.value.gmt is None


def test_given_directions_turn_if_the_gradient_is_given(hulls: dict[str, Hull]) -> None:
    """Else they stay: the carrier has some."""
    hull = hulls["carrier"]
    sheared = np.zeros((3, 3))
    sheared[1, 0] = 0.01
    field = lambda xyz: xyz @ sheared.T  # noqa: E731
    stiff = Deformation("stiff", field)
    turned = Deformation("turned", field, lambda xyz: np.tile(sheared, (len(xyz), 1, 1)))
    found = derivatives(hull, [stiff, turned], "even")
    assert found.of("volume")[0] != found.of("volume")[1]


def test_the_result_cannot_be_written_to(hulls: dict[str, Hull]) -> None:
    """It is a value; rows of a matrix are fields."""
    found = hydrostatic_derivatives(hulls["wigley"], [DRAUGHT, TRIM], draught=5.0)
    with pytest.raises(ValueError, match="read-only"):
        found.of("volume")[0] = 1.0
    matrix = found.matrix(["volume", "lcb"])
    assert np.array_equal(matrix, [found.of("volume"), found.of("lcb")])
    assert hydrostatic_derivatives(hulls["wigley"], [], draught=5.0).of("kb").shape == (0,)


@pytest.mark.parametrize(
    ("wrt", "error"),
    [
        ("draught", WrongTypeError),
        (["draught"], WrongTypeError),
        ([PointMove("nothing")], UnknownNameError),
        ([PointMove("WL 2.5")], BadInputError),
        ([PointMove("WL 2.5 x ST 7", "x")], FreedomError),
        ([PointMove("WL 2.5 x ST 7", "q")], BadInputError),
        ([Deformation("none", None)], WrongTypeError),  # type: ignore[arg-type]
        ([Deformation("flat", lambda xyz: xyz[:, 0])], BadInputError),
        ([Deformation("odd", lambda xyz: xyz * np.nan)], BadInputError),
    ],
)
def test_what_cannot_be_used_is_refused(
    wrt: list[Parameter], error: type[AssocHullError], hulls: dict[str, Hull]
) -> None:
    """With an error that says what to give."""
    with pytest.raises(error):
        hydrostatic_derivatives(hulls["wigley"], wrt)


def test_a_computed_point_moves_alone_or_not_at_all(hulls: dict[str, Hull]) -> None:
    """Partial derivatives are by any defining point; an edit moves its driver."""
    hull = hulls["series 60, 0.60"]
    points = hull.points.items()
    driven = next(name for name, each in points if each.driver is not None and len(each.free) == 1)
    found = hydrostatic_derivatives(hull, [PointMove(driven)])
    assert np.isfinite(found.of("volume")).all()
    with pytest.raises(PointRoleError, match="driven"):
        hydrostatic_derivatives(hull, [PointMove(driven, follow=True)])


def test_bad_parameters_cannot_be_made() -> None:
    """A position has three rates, a point an address."""
    with pytest.raises(BadInputError):
        Position("odd", (1.0, 2.0))
    with pytest.raises(WrongTypeError):
        PointMove(3)  # type: ignore[arg-type]


def test_an_unknown_field_is_named(hulls: dict[str, Hull]) -> None:
    """Fields are those of the record."""
    found = hydrostatic_derivatives(hulls["wigley"], [DRAUGHT], draught=5.0)
    with pytest.raises(BadInputError, match="the field"):
        found.of("weight")
