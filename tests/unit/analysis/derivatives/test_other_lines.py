"""Hulls that are measured by lines alone, on the layout of another hull of the same structure."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assoc_hull.analysis.derivatives.reused_layout import (
    flotation_at_points,
    flotation_on_lines,
    flotation_with_layout,
)
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.flotation import Flotation, flotation
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.splines.backend import backend, set_backend
from assoc_hull.geometry.surfaces.coons import CoonsStrips
from assoc_hull.hull import Hull
from assoc_hull.model.network import curve_data

SHIPS = ("wigley", "series60_60", "seaking_ship", "prelikon_ship", "container_ship_225m")
"""Plain; with knuckles and borders of flats; with a bulb; with a transom; with raked edges."""

FIELDS = [field.name for field in attrs.fields(ImmersedIntegrals)]


@pytest.fixture
def compiled() -> Iterator[None]:
    """Compiled code serves."""
    pytest.importorskip("numba")
    before = backend()
    set_backend("numba")
    yield
    set_backend(before)


def planes(body: Flotation) -> list[FloatingPlanes]:
    """Upright; with trim; heeled and trimmed; lower, heeled far."""
    ship = body.particulars
    d = ship.draught
    positions = (
        FloatingPosition(d, d),
        FloatingPosition(0.9 * d, d),
        FloatingPosition(0.95 * d, d, 10.0),
        FloatingPosition(0.6 * d, 0.5 * d, -35.0),
    )
    return [planes_of([each], ship.length) for each in positions]


def on_lines_of(base: Flotation, other: Flotation) -> Flotation | None:
    """Put the layout of a hull on the lines of another one, which are all that is known of it."""
    net = other.net
    return flotation_on_lines(base, net.batch, net.x, net.place, net.normal, other.particulars)


def edited(hull: Hull, point: int, step: float) -> bool:
    """Move a point along what it is free for; tell whether that can be done."""
    names = [name for name in hull.points if hull.points[name].free]
    name = names[point % len(names)]
    place, axes = hull.points[name], hull.points[name].free
    with suppress(AssocHullError):
        with hull.edit("a move") as edit:
            edit.move(name, lead=False, **{axis: getattr(place, axis) + step for axis in axes})
        return True
    return False


def decided_alike(one: Flotation, other: Flotation) -> bool:
    """The same lines run along the same strips."""
    mine, others = one.layout.cells, other.layout.cells
    numbers = ("anchor_start", "anchor", "plane")
    return all(
        np.array_equal(getattr(mine, name), getattr(others, name)) for name in numbers
    ) and np.array_equal(mine.paths.segment, others.paths.segment)


def nearly_agree(found: Flotation, wanted: Flotation) -> None:
    """Where a new layout takes other lines along a strip, numbers differ as the surface does."""
    for some in planes(wanted):
        one, other = found.measure(some).volume[0], wanted.measure(some).volume[0]
        assert abs(one - other) <= 1e-5 * other


def agree(found: Flotation, wanted: Flotation) -> None:
    """All that is measured has the same bits."""
    for some in planes(wanted):
        one, other = found.measure(some), wanted.measure(some)
        for name in FIELDS:
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)
        np.testing.assert_array_equal(found.stations(some).area, wanted.stations(some).area)
        np.testing.assert_array_equal(found.transom(some), wanted.transom(some))
        assert found.doubts(some, numbers=False) == wanted.doubts(some, numbers=False)
    np.testing.assert_array_equal(found.stations(some).x, wanted.stations(some).x)
    np.testing.assert_allclose(found.limits.deck, wanted.limits.deck, rtol=0.0, atol=1e-9)
    for some in planes(wanted):
        np.testing.assert_allclose(
            found.limits.mean_draughts(some, wanted.particulars.length),
            wanted.limits.mean_draughts(some, wanted.particulars.length), rtol=1e-12,
        )  # fmt: skip


POINTS = {
    "wigley": "WL 5 x ST 17",
    "series60_60": "WL 1.16 x ST 18.25",
    "seaking_ship": "WL 8.2 x FR 60",
    "prelikon_ship": "WL 8.5 x ST 57",
}


@pytest.mark.parametrize("name", list(POINTS))
def test_lines_alone_give_the_bits_of_a_hull_laid_out_anew(
    shipped: Callable[[str], Hull], name: str
) -> None:
    """Whatever point has moved, if that would take the same lines along the same strips."""
    hull, point = shipped(name), POINTS[name]
    base = flotation(hull.state)

    def compare(must: bool) -> None:
        try:
            wanted, tables = flotation(hull.state), flotation_with_layout(base, hull.state)
            assert tables is not None or not must
            if tables is None:
                return
            found = on_lines_of(base, wanted)
            assert found is not None
            if must or decided_alike(base, wanted):
                agree(found, wanted)
                agree(tables, wanted)
            else:
                nearly_agree(found, wanted)
        finally:
            hull.undo()

    with hull.edit("a move") as edit:
        edit.move(point, y=0.998 * hull.points[point].y)
    compare(must=True)

    @settings(max_examples=3, deadline=None)
    @given(which=st.integers(0, 500), step=st.floats(1e-4, 0.02), back=st.booleans())
    def moved(which: int, step: float, back: bool) -> None:
        if edited(hull, which, -step if back else step):
            compare(must=False)

    moved()


def test_raked_edges_and_a_transom_keep_their_numbers(shipped: Callable[[str], Hull]) -> None:
    """A boundary is cut at stations by a search, whose last bits a crossing does not tell."""
    base = flotation(shipped("container_ship_225m").state)
    found = on_lines_of(base, base)
    assert found is not None
    for some in planes(base):
        one, other = found.measure(some), base.measure(some)
        for name in FIELDS:
            size = max(1.0, float(np.abs(other.volume[0])))
            assert abs(getattr(one, name)[0] - getattr(other, name)[0]) <= 1e-13 * size * 100.0
        np.testing.assert_array_equal(found.transom(some), base.transom(some))


def test_errors_are_those_of_the_new_lines(shipped: Callable[[str], Hull]) -> None:
    """Though the tables are those of the hull as it was."""
    hull = shipped("series60_60")
    base = flotation(hull.state)
    with hull.edit("fuller") as edit:
        edit.move("WL 0.75 x ST 2", y=hull.points["WL 0.75 x ST 2"].y + 0.01)
    wanted = flotation(hull.state)
    found = on_lines_of(base, wanted)
    lines = curve_data(hull.state, wanted.net.curve)
    points = flotation_at_points(base, lines, hull.state.rows.xyz.data.copy())
    hull.undo()
    assert found is not None
    some = planes(wanted)[1]
    # Of points alone places of crossings are known nearly.
    for body, rounding in ((found, 1e-9), (points, 1e-2)):
        for one, other in zip(body.changes(some), wanted.changes(some), strict=True):
            for name in ("volume", "moment_x", "area", "shell"):
                np.testing.assert_allclose(
                    getattr(one.immersed, name), getattr(other.immersed, name), rtol=rounding,
                    atol=1e-9 * float(wanted.measure(some).volume[0]),
                )  # fmt: skip
    assert found.doubts(some) == wanted.doubts(some)


def test_the_lines_say_what_they_are_made_of(shipped: Callable[[str], Hull]) -> None:
    """Lofted again from what is read off them, directions and curvatures of ends included."""
    from assoc_hull.analysis.hydrostatics.flotation import data_of_lines
    from assoc_hull.geometry.splines.loft import loft

    for name in ("series60_60", "seaking_ship", "prelikon_ship"):
        body = flotation(shipped(name).state)
        again = loft(data_of_lines(curve_data(body.state, body.net.curve), body.net.batch))
        np.testing.assert_allclose(again.leave, body.net.batch.leave, atol=1e-9)
        np.testing.assert_allclose(again.arrive, body.net.batch.arrive, atol=1e-9)


def test_lines_of_another_order_are_refused(shipped: Callable[[str], Hull]) -> None:
    """Sections that pass one another, a crossing that passes a point, a deck that is closed."""
    base = flotation(shipped("wigley").state)
    net, x = base.net, base.net.x.copy()
    some = np.flatnonzero(np.isfinite(x) & ~net.end)
    x[some[0]], x[some[1]] = x[some[1]], x[some[0]]
    assert flotation_on_lines(base, net.batch, x, net.place, net.normal) is None
    far = net.place + 0.2 * net.batch.knot.max()
    assert flotation_on_lines(base, net.batch, net.x, far, net.normal) is None
    deck = "open" if base.closed else "closed"
    ship = attrs.evolve(base.particulars, deck=deck)
    assert flotation_on_lines(base, net.batch, net.x, net.place, net.normal, ship) is None


def test_the_lowest_point_is_that_of_all_samples(shipped: Callable[[str], Hull]) -> None:
    """Few segments are looked at, and none that could hold it is left out."""
    for name in ("seaking_ship", "container_ship_225m"):
        body = flotation(shipped(name).state)
        limits = body.limits
        all_of_them = attrs.evolve(limits, bottom=limits.bottom)
        for some in planes(body):
            np.testing.assert_array_equal(
                limits.mean_draughts(some, 1.0), all_of_them.mean_draughts(some, 1.0)
            )


# --------------------------------------------------------------------------------------
# Compiled code.


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("name", SHIPS)
def test_compiled_code_puts_cells_on_lines_to_the_bit(
    shipped: Callable[[str], Hull], name: str
) -> None:
    """Lines that have become longer and broader here and there."""
    from assoc_hull.geometry.surfaces.compiled_cells import put_cells

    body = flotation(shipped(name).state)
    net, rng = body.net, np.random.default_rng(5)
    for size in (0.0, 1e-3, 0.05):
        grown = 1.0 + size * rng.standard_normal((len(net.batch.xyz), 1))
        batch = attrs.evolve(net.batch, leave=net.batch.leave * grown, knot=1.01 * net.batch.knot)
        other = attrs.evolve(net, batch=batch, place=1.01 * net.place)
        found, wanted = put_cells(body.kept.structure, batch, other.place), body.kept.laid(other)
        assert found is not None
        assert wanted is not None
        layout, walked = wanted
        strips = CoonsStrips.on(layout.cells, batch, walked)
        for each in ("aft", "span", "blend"):
            np.testing.assert_array_equal(getattr(found.strips, each), getattr(strips, each))
        for each in ("tile_start", "first", "blend", "aft", "fore", "low", "high", "deck"):
            np.testing.assert_array_equal(getattr(found.cells, each), getattr(layout.cells, each))
        np.testing.assert_array_equal(found.cell, layout.cell)


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("name", SHIPS)
def test_compiled_code_measures_what_numpy_does(shipped: Callable[[str], Hull], name: str) -> None:
    """To 1e-13 of the whole: of volume times length to a power, of the waterplane, of the shell."""
    body = flotation(shipped(name).state)
    fast, slow = (Flotation(body.state, body.net, body.surface, body.kinds) for _ in range(2))
    length, top = body.particulars.length, body.particulars.draught
    levels = [planes_of([FloatingPosition(top * f, top * f)], length) for f in (0.05, 0.4, 1.3)]
    for some in [*planes(body), *levels]:
        set_backend("numba")
        one, area, moment, transom = measured(fast, some)
        set_backend("numpy")
        other, own_area, own_moment, own_transom = measured(slow, some)
        volume = float(other.volume[0])
        for each in FIELDS:
            scale = volume * length ** (2.0 if each.startswith("area_") else 1.0)
            scale = 1e3 * length if each[1:2] == "_" else scale
            got, wanted = getattr(one, each)[0], getattr(other, each)[0]
            assert np.isnan(got) == np.isnan(wanted)
            assert np.isnan(got) or abs(got - wanted) <= 1e-13 * scale, each
        most = own_area.max()
        np.testing.assert_allclose(area, own_area, rtol=0.0, atol=1e-13 * most)
        np.testing.assert_allclose(moment, own_moment, rtol=0.0, atol=1e-13 * most * top)
        np.testing.assert_allclose(transom, own_transom, rtol=0.0, atol=1e-13 * most)


def measured(
    body: Flotation, some: FloatingPlanes
) -> tuple[ImmersedIntegrals, np.ndarray, np.ndarray, np.ndarray]:
    """What is measured below a plane."""
    stations, moment = body.stations_and_moments(some)
    return body.measure(some), stations.area, moment, body.transom(some)


@pytest.mark.usefixtures("compiled")
def test_many_planes_are_measured_as_each_by_itself(shipped: Callable[[str], Hull]) -> None:
    """Upright and heeled ones together, more than are taken at a time."""
    body = flotation(shipped("wigley").state)
    heights = np.linspace(1.0, 7.0, 80)
    heel = np.where(np.arange(80) % 3 == 0, 0.2, 0.0)
    together = body.measure(FloatingPlanes(heights, 0.01 * heel, heel))
    for k in (0, 1, 41, 79):
        some = slice(k, k + 1)
        alone = body.measure(FloatingPlanes(heights[some], 0.01 * heel[some], heel[some]))
        for each in FIELDS:
            np.testing.assert_allclose(
                getattr(together, each)[k], getattr(alone, each)[0], rtol=1e-12, atol=1e-9
            )


@pytest.mark.usefixtures("compiled")
def test_compiled_hulls_of_lines_have_the_bits_of_compiled_hulls_of_tables(
    shipped: Callable[[str], Hull],
) -> None:
    """A hull put on lines is measured as one that is laid out anew."""
    hull = shipped("seaking_ship")
    base = flotation(hull.state)
    assert edited(hull, 7, 0.01)
    wanted = flotation(hull.state)
    hull.undo()
    for _ in range(25):  # who asks often has compiled code put the cells
        found = on_lines_of(base, wanted)
    assert found is not None
    agree(found, Flotation(wanted.state, wanted.net, wanted.surface, wanted.kinds))
    assert list(found.layout.frames) == list(wanted.layout.frames)


@pytest.mark.usefixtures("compiled")
def test_a_level_deck_half_under_water_is_as_broad_in_compiled_code(
    shipped: Callable[[str], Hull],
) -> None:
    """There the waterplane ends at the edge of the deck, as high as its middle but for rounding."""
    body = flotation(shipped("sfolds_ship").state)
    fast, slow = (Flotation(body.state, body.net, body.surface, body.kinds) for _ in range(2))
    for draught in (9.05, 9.2, 9.4):
        some = planes_of([FloatingPosition(draught, draught)], body.particulars.length)
        set_backend("numba")
        one = measured(fast, some)[0]
        set_backend("numpy")
        other = measured(slow, some)[0]
        assert one.y_most[0] == pytest.approx(other.y_most[0], rel=1e-12)
        assert one.y_least[0] == pytest.approx(other.y_least[0], rel=1e-12)
