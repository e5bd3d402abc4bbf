"""Outputs by name: their values, and derivatives against differences and known relations."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.analysis.derivatives.curve_tangents import curve_tangents
from assoc_hull.analysis.derivatives.hydrostatic_derivatives import hydrostatic_derivatives
from assoc_hull.analysis.derivatives.parameters import DRAUGHT, HEEL, TRIM, Moves, PointMove, Rates
from assoc_hull.analysis.derivatives.reused_layout import flotation_at_points
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.hull import Hull
from assoc_hull.variation.aiming.outputs import Outputs

NAMES = (
    "volume", "lcb", "kmt", "cb", "cm", "cp", "cw", "a_midship", "waterplane_area", "i_l",
    "V", "LCB", "Cb", "Cwa", "LCBf", "V_f", "LCFa", "V_st5", "M", "C_S", "B'",
)  # fmt: skip
"""Fields, and form parameters whose derivatives hang on no differences."""

MORE = {
    "wigley": ("A ST 7", "A x=37.3", "Cp", "Cpa", "Cpf", "As", "Amax"),
    "series60_70": ("A ST 14", "A x=38.9"),
}
"""Sections; and what has a kink where many sections are nearly the largest."""


@pytest.fixture(scope="module")
def hulls(shipped: Callable[[str], Hull]) -> dict[str, Hull]:
    """A hull with a formula, and one of a series."""
    return {name: shipped(name) for name in MORE}


def smooth_moves(hull: Hull) -> list[Moves]:
    """Broader, fore sections forward, fuller in the after body, longer: dimensions go along."""
    ship = hull.particulars
    xyz = np.nan_to_num(hull.state.rows.xyz.data)
    x = xyz[:, :1] / ship.length
    fore, aft = (np.clip((x - begin) / 0.27, 0.0, 1.0) for begin in (0.7, 0.03))
    hump = [64.0 * (part * (1.0 - part)) ** 3 for part in (fore, aft)]
    return [
        Moves("breadth", xyz * [0.0, 1.0 / ship.breadth, 0.0], rates=Rates(breadth=1.0)),
        Moves("shift", hump[0] * [1.0, 0.0, 0.0]),
        Moves("fuller", 0.02 * hump[1] * xyz * [0.0, 1.0, 0.0]),
        Moves("length", xyz * [1.0 / ship.length, 0.0, 0.0], rates=Rates(length=1.0)),
    ]


def differences(hull: Hull, outputs: Outputs, way: Moves, step: float) -> FloatArray:
    """Central differences of re-lofted hulls, extrapolated; their dimensions change as well."""
    body, ship = flotation(hull.state), hull.particulars
    gone, _ = curve_tangents(body, [way])

    def at(amount: float) -> FloatArray:
        rates = attrs.asdict(way.rates)
        sizes = {each: getattr(ship, each) + amount * rate for each, rate in rates.items()}
        resized = attrs.evolve(ship, **sizes)
        return outputs.values_of(flotation_at_points(body, *gone.stepped(0, amount)), resized)

    one, two = (at(k * step) - at(-k * step) for k in (1, 2))
    return (8.0 * one - two) / (12.0 * step)


def together(moves: list[Moves], part: FloatArray) -> Moves:
    """All of them at once, each by its part."""
    rates = part @ [attrs.astuple(each.rates) for each in moves]
    whole = np.einsum("k,knj->nj", part, [each.displacement for each in moves])
    return Moves("together", whole, rates=Rates(*rates.tolist()))


@pytest.mark.parametrize("name", MORE)
def test_derivatives_are_those_of_central_differences(name: str, hulls: dict[str, Hull]) -> None:
    """Each to 1e-7 of itself, or of its value (0.1 for one of nil) over Lpp if that is more.

    Along a mixture of all parameters, which takes a part of the time.
    """
    hull, part = hulls[name], np.array([0.7, -0.9, 1.1, 1.3])
    outputs, moves = Outputs.of(hull.state, (*NAMES, *MORE[name])), smooth_moves(hull)
    values, jacobian = outputs.derivatives(hull.state, moves)
    assert np.array_equal(values, outputs.values(hull.state))
    wanted = differences(hull, outputs, together(moves, part), 4e-3)
    sizes = np.abs(jacobian).max(axis=1), np.maximum(np.abs(values), 0.1) / hull.particulars.length
    off = np.abs(jacobian @ part - wanted) / np.maximum(*sizes)
    assert off.max() <= 1e-7, outputs.names[int(off.argmax())]


def test_the_section_amidships_changes_as_stations_pass(hulls: dict[str, Hull]) -> None:
    """A station there leaves it to either side, by other neighbours: the mean of both counts."""
    state = hulls["series60_70"].state
    forward = Moves("forward", np.ones((state.rows.count, 3)) * [1.0, 0.0, 0.0])
    outputs = Outputs.of(state, ["a_midship", "cm", "lcb", "volume"])
    jacobian = outputs.derivatives(state, [forward])[1][:, 0]
    wanted = differences(hulls["series60_70"], outputs, forward, 4e-3)
    assert_allclose(jacobian, wanted, rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize("name", MORE)
def test_a_hull_that_grows_with_its_dimensions_keeps_its_coefficients(
    name: str, hulls: dict[str, Hull]
) -> None:
    """All by 1 + e: volumes by 3 e, areas by 2 e, lengths by e, ratios not at all.

    To 1e-7 of the values, as the plane goes through the knots of the design waterline, where
    the sums have a slight kink; what is searched for, to what differences can.
    """
    hull = hulls[name]
    ship = hull.particulars
    sizes = Rates(ship.length, ship.breadth, ship.depth, ship.draught)
    xyz = np.nan_to_num(hull.state.rows.xyz.data)
    unit = np.tile(np.eye(3), (len(xyz), 1, 1))
    power = {
        "volume": 3, "V_a": 3, "Aw_f": 2, "A_st5": 2, MORE[name][0]: 2, "i_l": 4,
        "lcb": 1, "kmt": 1, "LCBa": 1, "B'": 1, "LCB": 0, "Cw": 0, "cm": 0, "M": 0, "C_S": 0,
        "L_E": 1,
    }  # fmt: skip
    if name == "wigley":
        power |= {"Amax": 2, "Cpa": 0, "Cpf": 0, "As": 0}
    outputs = Outputs.of(hull.state, power)
    found = outputs.differentiated(hull.state, [Moves("all", xyz, unit, sizes)])
    wanted = np.array(list(power.values())) * found.values
    sure = found.exact
    assert [name for name, each in zip(power, sure, strict=True) if not each] == ["L_E"]
    off = np.abs(found.jacobian[:, 0] - wanted) / np.maximum(np.abs(found.values), 0.1)
    assert off[sure].max() <= 1e-7
    assert_allclose(found.jacobian[~sure, 0], wanted[~sure], rtol=2e-2)


def test_the_floating_position_changes_form_parameters(hulls: dict[str, Hull]) -> None:
    """Those of the after body with the draught and the trim, as form parameters taken anew."""
    hull, h = hulls["series60_70"], 1e-3
    names = ["V_a", "LCBa", "V_st4", "Cb4"]
    outputs = Outputs.of(hull.state, names)
    jacobian = outputs.derivatives(hull.state, [DRAUGHT, TRIM])[1]
    draught = hull.particulars.draught
    for k, (aft, fore) in enumerate(((1.0, 1.0), (0.5, -0.5))):
        ends = []
        for step in (h, -h):
            at = draught + step * aft, draught + step * fore
            found = hull.form_parameters(draughts=at, only=names)
            ends.append(np.array([found[each].number for each in names]))
        wanted = (ends[0] - ends[1]) / (2.0 * h)
        assert_allclose(jacobian[:, k], wanted, rtol=1e-6)


def test_fields_are_those_of_hydrostatics(hulls: dict[str, Hull]) -> None:
    """Values to the bit, and derivatives by a point."""
    hull = hulls["series60_70"]
    outputs = Outputs.of(hull.state, ["volume", "lcb", "gmt"], kg=5.0)
    record = hull.hydrostatics(kg=5.0, estimate=False)
    found = outputs.differentiated(hull.state, [PointMove("WL 0.66 x ST 14"), DRAUGHT])
    assert found.values.tolist() == [record.volume, record.lcb, record.gmt]
    wanted = hydrostatic_derivatives(hull, [PointMove("WL 0.66 x ST 14"), DRAUGHT], kg=5.0)
    assert np.array_equal(found.jacobian, wanted.matrix(outputs.names))


def test_a_hull_of_other_places_is_measured_by_the_layout_of_the_old_one(
    hulls: dict[str, Hull], shipped: Callable[[str], Hull]
) -> None:
    """Values and derivatives are those of a full layout, to rounding."""
    hull, other = hulls["wigley"], shipped("wigley")
    with other.edit("fuller") as edit:
        edit.move("WL 2.5 x ST 7", y=other.points["WL 2.5 x ST 7"].y + 0.02)
    outputs = Outputs.of(hull.state, ["volume", "Cpa", "A ST 7"])
    wrt = smooth_moves(other)
    found = outputs.derivatives(other.state, wrt, like=hull.state)
    wanted = outputs.derivatives(other.state, wrt)
    assert_allclose(found[0], wanted[0], rtol=1e-13)
    assert_allclose(found[1], wanted[1], rtol=1e-9, atol=1e-12)
    assert np.array_equal(outputs.values(other.state, like=hull.state), found[0])


def test_sections_are_those_of_the_hull(hulls: dict[str, Hull]) -> None:
    """A section by its name, and the surface at its place; in the middle 2/3 B T."""
    hull = hulls["wigley"]
    found = Outputs.of(hull.state, ["A ST 10", "A x=50", "A x=42.5"]).values(hull.state)
    assert_allclose(found[:2], 2.0 / 3.0 * 10.0 * 6.25, rtol=1e-4)
    assert_allclose(found[2], 2.0 / 3.0 * 10.0 * 6.25 * (1.0 - 0.15**2), rtol=1e-4)


@pytest.mark.parametrize(
    ("names", "error", "words"),
    [
        (["volum"], UnknownNameError, "'volume'"),
        (["A ST 77"], UnknownNameError, "ST 7"),
        (["A x=here"], BadInputError, "finite number"),
        (["A x=250"], BadInputError, "nothing is immersed"),
        (["BL"], BadInputError, "no 'BL'"),
        (["gmt"], BadInputError, "centre of gravity"),
        (["volume", "volume"], BadInputError, "twice"),
        ("volume", WrongTypeError, "list of names"),
        ([3], WrongTypeError, "give text"),
    ],
)
def test_what_is_no_output_is_told(
    names: list[str], error: type[Exception], words: str, hulls: dict[str, Hull]
) -> None:
    """With what is nearest, or why the hull has none."""
    with pytest.raises(error, match=words):
        Outputs.of(hulls["wigley"].state, names)


def test_parameters_that_cannot_be_used_are_refused(hulls: dict[str, Hull]) -> None:
    """Heel, as form parameters are of an upright hull; moves of another hull; no parameter."""
    state = hulls["wigley"].state
    outputs = Outputs.of(state, ["volume"])
    with pytest.raises(BadInputError, match="heels the hull"):
        outputs.derivatives(state, [HEEL])
    with pytest.raises(BadInputError, match="take the moves from this hull"):
        outputs.derivatives(state, [Moves("short", np.zeros((3, 3)))])
    with pytest.raises(WrongTypeError, match="give a Parameter"):
        outputs.derivatives(state, ["breadth"])  # type: ignore[list-item]


@pytest.mark.parametrize(
    ("displacement", "gradient", "rates"),
    [
        (np.zeros((3, 2)), None, Rates()),
        (np.full((3, 3), np.nan), None, Rates()),
        (np.zeros((3, 3)), np.zeros((2, 3, 3)), Rates()),
        (np.zeros((3, 3)), None, 1.0),
        ("moves", None, Rates()),
    ],
)
def test_bad_moves_cannot_be_made(displacement: object, gradient: object, rates: object) -> None:
    """Arrays of another shape, numbers that are none, rates that are no rates."""
    with pytest.raises(BadInputError):
        Moves("bad", displacement, gradient, rates)  # type: ignore[arg-type]
