"""Values of the method that were computed beforehand, held to all their digits."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import CUBIC, QUINTIC, Blend, BlendChain
from assoc_hull.variation.fields.field import (
    AffinePiece,
    Axis,
    StackedField,
    Tube,
    level_boundaries,
)
from assoc_hull.variation.fields.layers import CornerLayer, FieldLayer
from assoc_hull.variation.fields.space_map import VariationMap

BOTH = [pytest.param(CUBIC, 0, id="cubic"), pytest.param(QUINTIC, 1, id="quintic")]
PLATEAU = level_boundaries(["base", "h-r", "h+r", "T"], [0.0, 3.27, 4.73, 10.8])


def at(course: BlendChain, x: float) -> tuple[float, float, float]:
    """Value, slope and second derivative at one place."""
    one = np.array([x])
    return tuple(float(give(one)[0]) for give in (course.at, course.slope, course.second))  # type: ignore[return-value]


def plateau(blend: Blend, size: float = 1.0) -> VariationMap:
    """A shift of a plateau about a shaft, full at the stern, fading forward."""
    fade = BlendChain.through([4.37, 62.0], [1.0, 0.0], blend)
    pieces = tuple(AffinePiece.along(fade, 0.0, d * size) for d in (0.0, 1.0, 1.0, 0.0))
    return VariationMap((FieldLayer("S", (StackedField("S", "z", PLATEAU, pieces, blend),)),))


def ratios(axis: Axis, z: list[float], ratio: list[float], blend: Blend) -> StackedField:
    """A field of the paper: ratios of the coordinate itself, the same all along the ship."""
    pieces = tuple(AffinePiece.along(BlendChain.constant(1.0), r - 1.0, 0.0) for r in ratio)
    return StackedField(axis, axis, level_boundaries([f"{each:g}" for each in z], z), pieces, blend)


def paper(blend: Blend) -> VariationMap:
    """A boss end of 0.725 m at z = 5 m to 1 m at 6 m, by ratios of y and z."""
    z = [0.0, 4.275, 5.0, 5.725, 18.0]
    upward = ratios("z", z, [1.0, 5.0 / 4.275, 6.0 / 5.0, 7.0 / 5.725, 1.0], blend)
    across = ratios("y", [2.825, 5.0, 7.175], [1.0, 1.0 / 0.725, 1.0], blend)
    return VariationMap((FieldLayer("paper", (upward, across)),))


def similarity(blend: Blend = QUINTIC) -> VariationMap:
    """The same by one affine piece about the centre, in y and z."""
    a, full, none = (
        1.0 / 0.725 - 1.0,
        BlendChain.constant(1.0),
        AffinePiece.along(BlendChain.constant(1.0), 0, 0),
    )
    levels = level_boundaries(["base", "h-r", "h+r", "T"], [0.0, 4.275, 5.725, 18.0])
    up, out = AffinePiece.along(full, a, 1.0, 5.0), AffinePiece.along(full, a, 0.0)
    upward = StackedField("z", "z", levels, (none, up, up, none), blend)
    across = StackedField("y", "y", levels, (none, out, out, none), blend, Tube(0.725))
    return VariationMap((FieldLayer("boss", (upward, across)),))


def circle() -> FloatArray:
    """The boss end, a place every degree."""
    turn = np.deg2rad(np.arange(-180.0, 181.0))
    return np.column_stack([0.0 * turn, 0.725 * np.sin(turn), 5.0 + 0.725 * np.cos(turn)])


def least_slope(vmap: VariationMap, row: int = 2, x: float = 4.37) -> float:
    """Least derivative of a coordinate by itself, over heights at one x, polished."""
    low, high = -1.0, 19.0
    for _ in range(12):
        z = np.linspace(low, high, 4001)
        slope = vmap.jacobian(np.column_stack([x + 0.0 * z, 0.0 * z, z]))[:, row, row]
        best, step = z[slope.argmin()], z[1] - z[0]
        low, high = best - 2.0 * step, best + 2.0 * step
    return float(slope.min())


@pytest.mark.parametrize(
    ("blend", "value", "slope", "most"),
    [(CUBIC, 0.216, 1.26, 1.5), (QUINTIC, 0.16308, 1.323, 1.875)],
)
def test_a_blend_has_its_values(blend: Blend, value: float, slope: float, most: float) -> None:
    """At s = 0.3; both are exactly 1/2 in the middle, and steepest there."""
    s = np.array([0.3, 0.5])
    assert_allclose(blend.value(s), [value, 0.5], rtol=0, atol=5e-11)
    assert_allclose(blend.slope(s), [slope, most], rtol=0, atol=5e-11)
    assert blend.steepest == most
    assert blend.slope(np.linspace(0.0, 1.0, 200_001)).max() <= most


@pytest.mark.parametrize(("blend", "bend"), [(CUBIC, 6.0), (QUINTIC, 10.0 / 3.0**0.5)])
def test_the_bend_of_a_blend_is_bounded(blend: Blend, bend: float) -> None:
    """6 for the cubic, where it jumps at the ends; 10 / sqrt 3 for the quintic, inside."""
    s = np.linspace(0.0, 1.0, 200_001)
    assert_allclose(np.abs(blend.second(s)).max(), bend, rtol=1e-9)
    assert (blend.second(np.array([0.0]))[0] == 0.0) == (blend is QUINTIC)


@pytest.mark.parametrize(("blend", "half"), [(CUBIC, 0.09375), (QUINTIC, 0.078125)])
def test_a_ramp_has_its_values(blend: Blend, half: float) -> None:
    """Nil below, the integral of the blend, t - 1/2 above: to the last bit."""
    t = np.array([-1.0, 0.0, 0.5, 1.0, 3.0])
    assert blend.ramp(t).tolist() == [0.0, 0.0, half, 0.5, 2.5]


@pytest.mark.parametrize(
    ("blend", "first", "last"),
    [
        (CUBIC, (1.0648, 0.0378, 0.0072), (1.1, -0.02)),
        (QUINTIC, (1.048924, 0.03969, 0.01512), (1.1, -0.025)),
    ],
)
def test_a_chain_has_its_values(
    blend: Blend, first: tuple[float, float, float], last: tuple[float, float]
) -> None:
    """Value, slope and second derivative between the nodes, to ten digits."""
    chain = BlendChain.through([0, 10, 40], [1, 1.3, 0.9], blend)
    assert_allclose(at(chain, 3.0), first, rtol=0, atol=5e-11)
    assert_allclose(at(chain, 25.0)[:2], last, rtol=0, atol=5e-11)


PLACES = np.array([[10.0, 2, 4], [30, 1, 7], [20, 3, 1.5]])
RAISED = [[4.9732334188, 7.3990787467, 1.8589979762], [4.9919893543, 7.4379146274, 1.8691695654]]
BY_Z = [[1.0, 0.8651854623, 1.3732313761], [1.0, 0.8367105770, 1.4936916085]]
BY_X = [[-0.0091773465, -0.0176124787], [-0.0040448427, -0.0230623432]]


@pytest.mark.parametrize(("blend", "which"), BOTH)
def test_a_plateau_is_raised_by_its_values(blend: Blend, which: int) -> None:
    """Heights after, and both derivatives, to ten digits."""
    vmap = plateau(blend)
    slope = vmap.jacobian(PLACES)
    assert_allclose(vmap(PLACES)[:, 2], RAISED[which], rtol=0, atol=5.1e-11)
    assert_allclose(slope[:, 2, 2], BY_Z[which], rtol=0, atol=5.1e-11)
    assert_allclose(slope[:2, 2, 0], BY_X[which], rtol=0, atol=5.1e-11)
    assert (vmap(PLACES)[:, :2] == PLACES[:, :2]).all()


@pytest.mark.parametrize(("blend", "height"), [(CUBIC, 6.770699679629), (QUINTIC, 6.718671220422)])
def test_a_plateau_is_lowered_again_by_its_value(blend: Blend, height: float) -> None:
    """The inverse at one place, to twelve digits."""
    assert_allclose(plateau(blend).inverse([[30, 1, 7.2]]), [[30, 1, height]], rtol=0, atol=5e-13)


@pytest.mark.parametrize(
    ("blend", "size", "least"),
    [
        (CUBIC, 1.0, 0.7528830313),
        (QUINTIC, 1.0, 0.6911037891),
        (CUBIC, 3.2, 0.2092257002),
        (QUINTIC, 3.2, 0.0115321252),
        (CUBIC, 4.2, -0.0378912685),
        (QUINTIC, 4.2, -0.2973640857),
    ],
)
def test_the_least_slope_of_a_plateau(blend: Blend, size: float, least: float) -> None:
    """Of Z by z, at the stern where the field is full, to ten digits."""
    assert_allclose(least_slope(plateau(blend, size)), least, rtol=0, atol=5.1e-11)


@pytest.mark.parametrize(
    ("blend", "near", "high", "least"),
    # the least slopes are known from bounds as .7203869730 and .6598594214: 1e-9 below
    [
        (CUBIC, (0.66419512555, 6.69627076134), 13.29134770594, 0.7203869731),
        (QUINTIC, (0.67382891472, 6.702781039), 13.28013288496, 0.6598594218),
    ],
)
def test_the_stacks_of_the_paper_have_their_values(
    blend: Blend, near: tuple[float, float], high: float, least: float
) -> None:
    """Ratios of y and z about a boss end: two places, and the least slope of Z."""
    found = paper(blend)(np.array([[0.0, 0.5, 5.5], [0.0, 3.0, 12.0]]))
    assert_allclose(found[0, 1], near[0], rtol=0, atol=5.1e-12)
    assert_allclose(found[0, 2], near[1], rtol=0, atol=5.1e-10 if blend is QUINTIC else 5.1e-12)
    assert_allclose(found[1, 2], high, rtol=0, atol=5.1e-12)
    assert_allclose(least_slope(paper(blend)), least, rtol=0, atol=5.1e-11)


def test_a_similarity_of_a_boss_has_its_values() -> None:
    """Four heights through the stack, to ten digits."""
    z = np.array([2.0, 4.275, 5.3, 10.0])
    found = similarity()(np.column_stack([0.0 * z, 0.0 * z, z]))[:, 2]
    assert_allclose(found, [1.9393297733, 5.0, 6.4137931034, 12.2231394287], rtol=0, atol=5.1e-11)


@pytest.mark.parametrize("blend", [CUBIC, QUINTIC], ids=["cubic", "quintic"])
def test_a_similarity_makes_a_circle_a_circle(blend: Blend) -> None:
    """One affine piece in y and z about the centre: radius 1 to rounding."""
    found = similarity(blend)(circle())
    assert np.abs(np.hypot(found[:, 1], found[:, 2] - 6.0) - 1.0).max() <= 1.8e-15


@pytest.mark.parametrize(
    ("blend", "least", "most"), [(CUBIC, 0.9825, 1.0002), (QUINTIC, 0.9900, 1.0065)]
)
def test_ratios_make_a_circle_none(blend: Blend, least: float, most: float) -> None:
    """The paper's stacks leave the radius by up to 18 mm."""
    found = paper(blend)(circle())
    radius = np.hypot(found[:, 1], found[:, 2] - 6.0)
    assert_allclose([radius.min(), radius.max()], [least, most], rtol=0, atol=5.1e-5)


def test_a_tube_has_its_least_slope() -> None:
    """The identity to r, nil beyond n r; between them it falls by at most 1.087 for n = 6."""
    tube = Tube(0.725, 6.0, QUINTIC)
    y = np.linspace(0.0, 6.0 * 0.725, 400_001)
    assert_allclose(tube.slope(y).min(), -1.087, rtol=0, atol=5.1e-4)
    inside, beyond = np.array([-0.725, -0.3, 0.0, 0.725]), np.array([-9.0, 4.35, 5.0])
    assert tube.at(inside).tolist() == inside.tolist()
    assert (tube.at(beyond) == 0.0).all()


def test_a_corner_has_its_values() -> None:
    """A bilge of 2.4 to 3.0 m: on the arc, on the bottom, and above the arc."""
    fade = BlendChain.through([2.4, 12.0], [1.0, 0.0])
    bilge = CornerLayer("bilge", BlendChain.constant(1.0), 29.0, 0.0, 0.0, 1.25, 1.25, fade)
    y, z = 26.6 + 2.4 * np.sin(0.6), 2.4 - 2.4 * np.cos(0.6)
    assert_allclose([y, z], [27.9551419361, 0.4191945242], rtol=0, atol=5e-11)
    given = [[0.0, y, z], [0.0, 24.0, 0.0], [0.0, 27.0, 5.0]]
    asked = [[27.6939274202, 0.5239931553], [22.9083703653, 0.0], [26.5633481461, 6.0916296347]]
    found = VariationMap((bilge,))(np.array(given))
    assert_allclose(found[:, 1:], asked, rtol=0, atol=5.1e-11)


@pytest.mark.parametrize(("before", "after"), [(2.4, 3.0), (2.4, 2.0)])
def test_a_corner_makes_an_arc_an_arc(before: float, after: float) -> None:
    """A bilge arc of another radius between the same lines, to rounding."""
    turn = np.linspace(0.0, 0.5 * np.pi, 1001)
    arc = np.column_stack(
        [0.0 * turn, 29.0 - before * (1.0 - np.sin(turn)), before * (1.0 - np.cos(turn))]
    )
    ratio, fade = after / before, BlendChain.through([2.4, 19.2], [1.0, 0.0])
    bilge = CornerLayer("bilge", BlendChain.constant(1.0), 29.0, 0.0, 0.0, ratio, ratio, fade)
    found = VariationMap((bilge,))(arc)
    radius = np.hypot(found[:, 1] - (29.0 - after), found[:, 2] - after)
    assert np.abs(radius - after).max() <= 6e-15


def test_a_draught_has_its_values() -> None:
    """10.8 to 11.4 m: a ratio up to T, and a shift from 17.2 m up."""
    full = BlendChain.constant(1.0)
    pieces = (AffinePiece.along(full, 11.4 / 10.8 - 1.0, 0.0), AffinePiece.along(full, 0.0, 0.6))
    field = StackedField("T", "z", level_boundaries(["T", "1.6 T"], [10.8, 17.2]), pieces, QUINTIC)
    given = np.array([[0.0, 0, 5], [0, 0, 10.8], [0, 0, 14], [0, 0, 18]])
    found = given[:, 2] + field.displacement(given)
    assert_allclose(found, [5.2777777778, 11.4, 14.6888888889, 18.6], rtol=0, atol=5.1e-11)


def test_a_bulb_length_has_its_values() -> None:
    """One metre more: within the chain, on the rigid bulb, and above its top."""
    fade = BlendChain.through([207.0, 230.0], [0.0, 1.0])
    pieces = (AffinePiece.along(fade, 0.0, 1.0), AffinePiece.along(fade, 0.0, 0.0))
    field = StackedField(
        "bulb", "x", level_boundaries(["top", "T+2"], [9.08, 12.8]), pieces, QUINTIC
    )
    given = np.array([[220.0, 0, 5], [233, 0, 5], [225, 0, 10.5]])
    found = VariationMap((FieldLayer("bulb", (field,)),))(given)
    assert_allclose(found[:, 0], [220.6209027393, 234.0, 225.6621511129], rtol=0, atol=5.1e-11)
    assert (found[:, 1:] == given[:, 1:]).all()
