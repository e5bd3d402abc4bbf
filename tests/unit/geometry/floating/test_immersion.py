"""Properties of the immersion of any body below any plane."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, Strips
from assoc_hull.geometry.floating.immersed_strips import PreparedStrips, prepare_strips
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from tests.exact_hulls import FormStrips, box, ellipsoid
from tests.long_forms import draws

NAMES = [field.name for field in attrs.fields(ImmersedIntegrals)]
EXTENTS = [name for name in NAMES if name.startswith(("x_", "y_"))]
SUMS = [name for name in NAMES if name not in EXTENTS]
Turn = tuple[float, float]
SOLID = ["volume", "moment_x", "moment_y", "moment_z"]


def planes(height: object, trim: float = 0.0, heel: float = 0.0) -> FloatingPlanes:
    """Planes of one inclination."""
    heights = np.atleast_1d(np.asarray(height, np.float64))
    return FloatingPlanes(heights, np.full(len(heights), trim), np.full(len(heights), heel))


def rows(body: ImmersedIntegrals, names: list[str] = SUMS) -> FloatArray:
    """The integrals as rows, (names, d)."""
    return np.stack([getattr(body, name) for name in names])


def scales(body: PreparedStrips, names: list[str] = SUMS) -> FloatArray:
    """How great each integral is for the whole body or its largest waterplane, (names, 1)."""
    sizes = np.abs(rows(integrate_immersed(body, planes(np.linspace(0.0, 16.0, 33))), names)).max(
        axis=1
    )
    length, breadth = 100.0, 16.0
    odd = {"moment_y": sizes[0] * breadth, "area_y": length * breadth**2}
    odd["area_xy"] = length**2 * breadth**2
    return np.array([[odd.get(n, s)] for n, s in zip(names, sizes, strict=True)])


def ship(
    rocker: float = 8.0, rake: float = 3.0, points: int = 6, closed: bool = True
) -> FormStrips:
    """A body with sheer, a keel that rises to both ends, a transom and a raked stem."""
    return FormStrips(
        breadth=16.0 * Polynomial([0.5, 1.0]) * Polynomial([1.0, -1.0]),
        keel=Polynomial([0.25 * rocker, -rocker, rocker]),
        height=Polynomial([10.0, 1.0, 2.0]),
        rake=Polynomial([0.0, 0.0, rake]),
        points=points,
    )


SHIP = prepare_strips(ship())
INCLINATIONS = [(0.0, 0.0), (0.02, 0.0), (0.0, 0.2), (0.02, 0.2), (-0.03, -0.6)]


@st.composite
def bodies(draw: st.DrawFn) -> PreparedStrips:
    """Bodies of random form, all of whose ends are flat or pointed."""
    fullness = draw(st.floats(0.2, 1.0))
    form = FormStrips(
        breadth=14.0 * Polynomial([fullness, 1.0]) * Polynomial([1.0, -1.0]),
        keel=Polynomial([draw(st.floats(-1.0, 3.0)), draw(st.floats(-6.0, 3.0)), 3.0]),
        height=Polynomial([10.0, draw(st.floats(-2.0, 2.0)), 1.0]),
        rake=Polynomial([0.0, 0.0, draw(st.floats(-3.0, 3.0))]),
        strips=6,
        closed=draw(st.booleans()),
    )
    return prepare_strips(form)


inclined = st.tuples(st.floats(-0.03, 0.03), st.floats(-0.5, 0.5))
levels = st.floats(1.0, 9.0)
few = settings(max_examples=draws(25), deadline=None)


@few
@given(bodies(), levels, inclined)
def test_volume_grows_by_the_waterplane(body: PreparedStrips, level: float, turn: Turn) -> None:
    """The derivative of V and its moments by the height are the plane's area and moments."""
    step = 1e-4
    above, at, below = (
        integrate_immersed(body, planes(level + each, *turn)) for each in (step, 0.0, -step)
    )
    # Where the surface is level just there the area has no derivative: no difference shows it.
    assume(abs(above.area - below.area).max() <= 1e-4 * scales(body, ["area"])[0, 0])
    slope = (rows(above, SOLID) - rows(below, SOLID)) / (2.0 * step)
    area_z = level * at.area + turn[0] * at.area_x - turn[1] * at.area_y
    plane = np.stack([at.area, at.area_x, at.area_y, area_z])
    size = scales(body, ["area"])[0] * np.array([1.0, 100.0, 16.0, 10.0])
    assert np.all(np.abs(slope - plane)[:, 0] <= 1e-6 * size)


@few
@given(bodies(), levels, inclined)
def test_heel_to_the_other_side_mirrors(body: PreparedStrips, level: float, turn: Turn) -> None:
    """Both ways the same, but for what is odd in y."""
    one, other = (
        integrate_immersed(body, planes(level, turn[0], sign * turn[1])) for sign in (1.0, -1.0)
    )
    for name in SUMS:
        sign = -1.0 if name in ("moment_y", "area_y", "area_xy") else 1.0
        assert getattr(one, name)[0] == sign * getattr(other, name)[0], name
    assert np.array_equal(one.y_most, -other.y_least, equal_nan=True)


@few
@given(bodies(), inclined)
def test_planes_of_a_batch_are_those_alone(body: PreparedStrips, turn: Turn) -> None:
    """A plane among others has its own integrals, to the last bits, in any order."""
    heights = np.array([7.0, 2.5, 4.0, 2.5, 30.0, -30.0])
    trim = np.array([turn[0], turn[0], 0.0, 0.0, turn[0], turn[0]])
    heel = np.array([turn[1], turn[1], 0.0, turn[1], turn[1], turn[1]])
    together = integrate_immersed(body, FloatingPlanes(heights, trim, heel))
    size = scales(body)[:, 0]
    for place in range(len(heights)):
        alone = integrate_immersed(body, planes(heights[place], trim[place], heel[place]))
        assert (np.abs(rows(alone)[:, 0] - rows(together)[:, place]) <= 1e-14 * size).all()
        for name in EXTENTS:
            one, among = getattr(alone, name)[0], getattr(together, name)[place]
            assert abs(one - among) <= 1e-12 * 100.0 or np.isnan([one, among]).all()


@few
@given(bodies(), inclined)
def test_more_water_wets_more(body: PreparedStrips, turn: Turn) -> None:
    """V, shell and girth rise with the height of the plane, from nil to the whole."""
    found = integrate_immersed(body, planes(np.linspace(-12.0, 25.0, 150), *turn))
    for name in ("volume", "shell", "girth"):
        values = getattr(found, name)
        assert (np.diff(values) >= -1e-12 * values[-1]).all()
        assert values[0] == 0.0 < values[-1]


@pytest.mark.parametrize(("trim", "heel"), INCLINATIONS)
def test_a_plane_through_knots_counts_them_once(trim: float, heel: float) -> None:
    """At the height of every knot of the strips' ends V is that of the neighbouring heights."""
    x, y, z = SHIP.ends[1].coefficients[:3, 0]
    heights = np.unique(z - trim * x + heel * y)
    heights = heights[np.abs(heights) > 1e-9]
    volume = integrate_immersed(SHIP, planes(heights, trim, heel)).volume
    for change in (1e-14, -1e-14):
        moved = integrate_immersed(SHIP, planes(heights * (1.0 + change), trim, heel)).volume
        assert np.abs(moved - volume).max() <= 1e-11 * volume.max()


def test_a_row_of_vertices_costs_nothing() -> None:
    """The block of 100 x 20 x 12 with knots at every metre: V is area by draught, exactly."""

    @attrs.frozen
    class Block:
        """The box, its sides cut into twelve tiles."""

        count: int = 1
        order: IntArray = attrs.field(factory=lambda: np.array([4]))

        def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
            point, across = np.zeros((2, len(v), 13, 4, 3))
            point[:, :, 0, 0], across[:, :, 0, 0] = 100.0 * v[:, None], 100.0
            point[:, 0, 1, 1], point[:, 1:, 0, 1] = 10.0, 10.0
            point[:, 1:, 0, 2], point[:, 1:, 1, 2] = np.arange(12.0), 1.0
            deck = np.zeros(len(v) * 13, bool)
            tiles = np.arange(len(v) + 1) * 13
            return IsoCurves(tiles, point.reshape(-1, 4, 3), across.reshape(-1, 4, 3), deck)

    draughts = np.concatenate([np.arange(12.0), np.arange(12.0) + 0.5])
    found = integrate_immersed(prepare_strips(Block()), planes(draughts))
    assert np.abs(found.volume - 2000.0 * draughts).max() <= 1e-11
    assert np.abs(found.area - 2000.0).max() <= 1e-11


@pytest.mark.parametrize("height", [0.0, 12.0])
def test_a_plane_in_the_bottom_or_the_deck_is_a_limit(height: float) -> None:
    """Everything is what it is just above that plane."""
    body = prepare_strips(box())
    found = rows(integrate_immersed(body, planes([height, height + 1e-9])))
    assert np.abs(found[:, 0] - found[:, 1]).max() <= 1e-2 * np.abs(found[:, 0]).max() * 1e-6


def test_a_plane_touching_the_keel_of_an_ellipsoid_wets_nothing() -> None:
    """A plane tangent to the body at its lowest point."""
    found = integrate_immersed(prepare_strips(ellipsoid()), planes([0.0, 1e-6]))
    assert found.volume[0] <= 1e-9
    assert 0.0 < found.volume[1] < 1e-2


@pytest.mark.parametrize(("trim", "heel"), INCLINATIONS)
def test_planes_that_miss(trim: float, heel: float) -> None:
    """High above, the whole body and no plane; far below, nothing; extents are not known."""
    found = integrate_immersed(SHIP, planes([-80.0, 80.0, 90.0], trim, heel))
    assert not rows(found)[:, 0].any()
    whole = rows(found)[:, 1]
    assert np.abs(whole - rows(found)[:, 2]).max() <= 1e-12 * np.abs(whole).max()
    assert found.volume[1] > 0.0
    assert not found.area.any()
    assert np.isnan(rows(found, EXTENTS)).all()


@pytest.mark.parametrize(("trim", "heel"), INCLINATIONS)
@pytest.mark.parametrize("rake", [0.0, 3.0])
def test_complex_steps_are_the_derivatives(trim: float, heel: float, rake: float) -> None:
    """By height, trim and heel, against central differences.

    Not for moments of the plane where curves lean: a piece may appear on them at a tangency,
    at which their integrands have no derivative.
    """
    body = prepare_strips(ship(rake=rake))
    names = SUMS if rake == 0.0 else [*SOLID, "shell", "girth"]
    size = scales(body, names)[:, 0]
    at = np.array([5.3, trim, heel])
    for which, arm in enumerate((10.0, 0.1, 1.0)):
        step = np.zeros(3)
        step[which] = 1e-5 * arm
        imaginary = _at(body, at + 1e-25j * step, names).imag / 1e-25
        real = 0.5 * (_at(body, at + step, names) - _at(body, at - step, names)).real
        assert (np.abs(imaginary - real) <= 1e-8 * size / arm).all()


def _at(body: PreparedStrips, place: FloatArray, names: list[str]) -> FloatArray:
    height, trim, heel = (place[i : i + 1] for i in range(3))
    return rows(integrate_immersed(body, FloatingPlanes(height, trim, heel)), names)[:, 0]


@attrs.frozen
class Some:
    """Some strips of a body."""

    whole: FormStrips
    kept: tuple[int, ...]

    @property
    def count(self) -> int:
        return len(self.kept)

    @property
    def order(self) -> IntArray:
        return self.whole.order[list(self.kept)]

    def curves(self, strip: IntArray, v: FloatArray) -> IsoCurves:
        """The whole's curves."""
        return self.whole.curves(np.array(self.kept)[strip], v)


@pytest.mark.parametrize(("trim", "heel"), INCLINATIONS)
def test_parts_add_up(trim: float, heel: float) -> None:
    """What the fore and the after body have together is what the whole has."""
    parts: list[Strips] = [Some(ship(), (0, 1, 2)), Some(ship(), tuple(range(3, 10)))]
    heights = planes([1.0, 4.0, 7.0, 13.0], trim, heel)
    summed = sum(rows(integrate_immersed(prepare_strips(part), heights)) for part in parts)
    whole = rows(integrate_immersed(SHIP, heights))
    assert np.abs(summed - whole).max() <= 1e-12 * np.abs(whole).max()


@pytest.mark.parametrize(("trim", "heel"), INCLINATIONS)
def test_places_where_pieces_appear_cost_no_accuracy(trim: float, heel: float) -> None:
    """Six curves a strip and thrice as many: V to 1e-10 also where keel and deck cross."""
    heights = planes(np.linspace(-2.0, 14.0, 41), trim, heel)
    coarse, fine = (integrate_immersed(prepare_strips(ship(points=n)), heights) for n in (6, 18))
    assert np.abs(coarse.volume - fine.volume).max() <= 1e-10 * fine.volume.max()
    assert np.abs(coarse.area - fine.area).max() <= 2e-8 * fine.area.max()
    assert np.abs(coarse.shell - fine.shell).max() <= 1e-7 * fine.shell.max()


def test_a_factor_raises_the_order() -> None:
    """Twice the order is what the same body of twice the order has."""
    double, known = prepare_strips(ship(points=3), 2), prepare_strips(ship(points=6))
    heights = planes([3.0, 6.0])
    assert np.array_equal(
        rows(integrate_immersed(double, heights)), rows(integrate_immersed(known, heights))
    )
    with pytest.raises(BadInputError):
        prepare_strips(ship(), 0)


def test_extents_end_where_the_keel_comes_out() -> None:
    """The waterplane of a hull with a rising keel begins and ends at known places."""
    body = prepare_strips(ship(rocker=24.0, rake=0.0))
    found = integrate_immersed(body, planes([3.0]))
    # keel = 6 - 24 t + 24 t^2 = 3
    half = np.sqrt(0.125)
    assert abs(found.x_least[0] - 100.0 * (0.5 - half)) < 1e-9
    assert abs(found.x_most[0] - 100.0 * (0.5 + half)) < 1e-9
    assert found.y_most[0] == -found.y_least[0]


def test_no_planes_have_no_integrals() -> None:
    """An empty batch is a batch."""
    assert rows(integrate_immersed(SHIP, planes([])), NAMES).shape == (len(NAMES), 0)


@pytest.mark.parametrize(("points", "tolerance"), [(6, 2e-7), (12, 1e-8)])
def test_the_breadth_between_curves_is_found(points: int, tolerance: float) -> None:
    """The waterplane of a body is as broad as its greatest waterline breadth, to 1e-7 or so."""
    form = ship(rocker=0.0, rake=0.0, points=points)
    found = integrate_immersed(prepare_strips(form), planes([4.0, 7.0]))
    dense = integrate_immersed(
        prepare_strips(ship(rocker=0.0, rake=0.0, points=100)), planes([4.0, 7.0])
    )
    assert np.abs(found.y_most - dense.y_most).max() <= tolerance * 8.0


def test_a_level_keel_brings_no_share_of_another_rule() -> None:
    """Just above a keel that is level along the strips V grows by the area, to rounding."""
    form = FormStrips(
        breadth=16.0 * Polynomial([0.5, 1.0]) * Polynomial([1.0, -1.0]),
        keel=Polynomial([0.0]),
        height=Polynomial([10.0, 1.0, 2.0]),
        rake=Polynomial([0.0]),
        points=3,
    )
    body, heights, step = prepare_strips(form), np.linspace(0.02, 0.6, 30), 1e-5
    at, above, below = (
        integrate_immersed(body, planes(heights + each)) for each in (0.0, step, -step)
    )
    slope = (above.volume - below.volume) / (2.0 * step)
    # Half breadths go like the root of the height here: so much is the difference's own error.
    own = 0.1 * (step / heights) ** 2
    assert (np.abs(slope - at.area) <= (1e-8 + own) * at.area).all()


def test_waterplanes_under_heel_end_where_the_section_touches_the_plane() -> None:
    """A rising keel, heeled: both ends of the waterplane, from many more strips."""
    coarse, fine = (
        FormStrips(
            breadth=16.0 * Polynomial([0.5, 1.0]) * Polynomial([1.0, -1.0]),
            keel=Polynomial([6.0, -24.0, 24.0]),
            height=Polynomial([10.0, 1.0, 2.0]),
            rake=Polynomial([0.0]),
            strips=strips,
        )
        for strips in (10, 33)
    )
    found, known = (
        integrate_immersed(prepare_strips(form), planes([3.0], 0.01, 0.3))
        for form in (coarse, fine)
    )
    for name in ("x_least", "x_most"):
        assert abs(getattr(found, name)[0] - getattr(known, name)[0]) <= 1e-8


def test_an_edge_that_is_level_but_for_rounding_is_no_event() -> None:
    """A deck at 12 m but for the last bits of a sum: V does not notice on which side it lies."""
    form = FormStrips(
        breadth=16.0 * Polynomial([0.5, 1.0]) * Polynomial([1.0, -1.0]),
        keel=Polynomial([0.1, -1.7, 2.3]),
        height=Polynomial([12.0 - 0.1, 1.7, -2.3]),
        rake=Polynomial([0.0]),
        strips=3,
        points=2,
    )
    deck = 12.0 * (1.0 + np.array([-1e-14, 0.0, 1e-14]))
    volume = integrate_immersed(prepare_strips(form), planes(deck)).volume
    assert np.ptp(volume) <= 1e-11 * volume[1]
