"""Maps in compiled form: the bits of layers, bilges and circles in numpy, wherever a place lies."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.carrying.admissible_values import AdmissibleValues, requested_radii
from assoc_hull.variation.features.flat_map import FlatMap
from assoc_hull.variation.features.redrawn_bilges import BilgeArc
from assoc_hull.variation.features.redrawn_circles import (
    FeatureMap,
    RedrawnCircle,
    SpaceCircle,
    redraw_circle,
)
from assoc_hull.variation.features.redrawn_features import RedrawnFeatures, redraw_features
from assoc_hull.variation.fields.bounded_functions import (
    BlendChain,
    BoundedFunction,
    Contour,
    Polynomial,
    Ramp,
)
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.layers import AdditiveLayer, FieldLayer, Layer, Rake
from assoc_hull.variation.fields.shift_shapes import Polyline
from assoc_hull.variation.fields.space_map import SlopedMap, VariationMap
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.request import TOLERANCE
from tests import variation_strategies as vs
from tests.conftest import Shipped
from tests.long_forms import draws

pytest.importorskip("numba")

from assoc_hull.variation.features.compiled_map import CompiledMap, kernels
from assoc_hull.variation.fields.compiled_layers import displacement_slopes_at

MAY = "assoc_hull.variation.features.redrawn_features.is_compiled"


def compiled(
    layers: Sequence[Layer],
    arcs: Sequence[tuple[BilgeArc, BlendChain]] = (),
    circles: Sequence[RedrawnCircle] = (),
) -> CompiledMap:
    """The compiled form, which there must be."""
    flat = FlatMap.of(layers, arcs, circles)
    assert flat is not None
    return CompiledMap(flat)


def assert_same(quick: SlopedMap, usual: SlopedMap, xyz: FloatArray) -> None:
    """Places and Jacobians to the last bit, of all at once and of each alone."""
    assert quick(xyz).tobytes() == usual(xyz).tobytes()
    assert quick.jacobian(xyz).tobytes() == usual.jacobian(xyz).tobytes()
    for place in xyz[:: max(len(xyz) // 2, 1)]:
        assert quick(place[None]).tobytes() == usual(place[None]).tobytes()
        one = quick.jacobian(place[None])
        assert one.tobytes() == usual.jacobian(place[None]).tobytes()


# --------------------------------------------------------------------------------------
# Layers of every kind.


@st.composite
def functions(draw: DrawFn) -> BoundedFunction:
    """Functions of every kind that has a flat form."""
    numbers = draw(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=4))
    x = np.cumsum([draw(st.floats(-10.0, 60.0)), *(10.0 + abs(each) for each in numbers)])
    return draw(
        st.one_of(
            vs.chains(-1.0, 1.0), vs.bumps(), st.just(Polynomial.of(numbers)),
            st.just(Polyline(x, np.array([*numbers, 0.5]))),
            st.builds(Ramp, st.floats(0.0, 20.0), st.sampled_from([-4.0, 3.0]),
                      st.floats(-0.1, 0.1), vs.blends),
        )
    )  # fmt: skip


@st.composite
def additive_layers(draw: DrawFn) -> AdditiveLayer:
    """Additive functions of every kind; the centre plane stays."""
    none_inside: list[BoundedFunction] = [Polynomial.of([0.0, 0.1]), Ramp(2.0, 3.0, 0.1)]
    out = st.sampled_from(none_inside)
    y = draw(st.one_of(st.none(), st.tuples(functions(), out, functions())))
    z = draw(st.one_of(st.none(), st.tuples(functions(), functions(), functions())))
    return AdditiveLayer("additive", draw(st.one_of(st.none(), functions())), y, z)


layers = st.one_of(vs.layers(), vs.layers(), additive_layers())


def edges(regions: Sequence[FieldRegion]) -> FloatArray:
    """Places at the corners of regions, and next to them."""
    found = [
        (x + dx, y, z + dz) for each in regions for x in each.x for z in each.z
        for y in (0.0, -0.0, -7.0) for dx in (-1e-9, 0.0, 1e-9) for dz in (0.0, -1e-9)
        if np.isfinite([x, z]).all()
    ]  # fmt: skip
    return np.array(found).reshape(-1, 3)


@settings(max_examples=draws(60), deadline=None)
@given(st.lists(layers, min_size=0, max_size=3), vs.places(), st.integers(0, 60))
def test_maps_of_layers_have_the_bits_of_numpy(
    given_: list[Layer], xyz: FloatArray, count: int
) -> None:
    """In and outside regions, on their edges, on both sides, at zeros of both signs."""
    vmap = VariationMap(tuple(given_))
    xyz = np.concatenate([xyz[:count], edges(vmap.regions()), xyz[:4] * 0.0, xyz[:4] * -0.0])
    assert_same(compiled(vmap.layers), vmap, xyz)


def test_more_places_than_a_block_has() -> None:
    """Each is mapped as if it were alone."""
    field = Rake("rake", BlendChain.through([20.0, 90.0], [0.0, 1.0]), 0.1, 5.0, 3.0)
    vmap = VariationMap((FieldLayer("one", (field,)), FieldLayer("two", (field,))))
    spread = np.random.default_rng(3)
    for count in (255, 256, 257, 1000):
        xyz = spread.uniform([0.0, -20.0, 0.0], [240.0, 20.0, 20.0], (count, 3))
        assert_same(compiled(vmap.layers), vmap, xyz)
        assert_same(compiled(vmap.layers), vmap, np.asfortranarray(xyz))


# --------------------------------------------------------------------------------------
# Circles and bilges.


def around(circles: Sequence[RedrawnCircle], spread: np.random.Generator) -> Iterator[FloatArray]:
    """Places on circles, next to them, on their axes, and in their neighbourhood."""
    for each in circles:
        old = each.before
        unit = old.unit(old.centre + spread.normal(size=(6, 3)))[0]
        rim = old.at(unit)
        yield rim
        yield rim + each.gap * spread.uniform(-2.0, 2.0, (6, 1)) * spread.normal(size=(6, 3))
        yield old.centre + np.array([[0.0], [1e-7], [0.3], [-2.0]]) * old.normal
        yield old.centre + old.radius * spread.uniform(-7.0, 7.0, (12, 3))


def along(arcs: Sequence[BilgeArc], spread: np.random.Generator) -> Iterator[FloatArray]:
    """Places on bilge arcs, at their ends, along floor and side, at the centre, and around."""
    part = np.array([0.0, 1e-12, 0.2, 0.5, 0.9, 1.0])
    for each in arcs:
        old = each.before
        yz = np.concatenate([
            old.at(part), old.at(part) * (1.0 + 1e-7), [[old.y, old.z]],
            old.floor - [[0.0, 0.0], [0.5, 0.0], [each.reach[0], 0.0]],
            old.side + np.array([[0.0, 1e-9], [0.0, 0.5], [0.0, each.reach[1]]]),
            [old.y, old.z] + old.radius * spread.uniform(-1.6, 1.6, (12, 2)),
        ])  # fmt: skip
        for x in (each.x, each.x - 3.0):
            for side in (1.0, -1.0):
                yield np.column_stack([np.full(len(yz), x), side * yz[:, 0], yz[:, 1]])


def assert_features_same(anew: RedrawnFeatures, more: FloatArray, seed: int) -> None:
    """At places around all that is drawn anew, and at more."""
    spread = np.random.default_rng(seed)
    parts = [*around(anew.map.circles, spread), *along(anew.bilges.arcs, spread), more]
    arcs = list(zip(anew.bilges.arcs, anew.bilges.shares(), strict=True))
    assert_same(compiled(anew.layers, arcs, anew.map.circles), anew.map, np.concatenate(parts))


@settings(max_examples=draws(8), deadline=None)
@given(vs.maps(0.1, 2), st.integers(1, 10), st.integers(0, 10**6))
def test_circles_have_the_bits_of_numpy(vmap: VariationMap, count: int, seed: int) -> None:
    """Of any number, in planes across the ship and oblique ones, some as large as asked for."""
    spread = np.random.default_rng(seed)
    circles = []
    for k in range(count):
        normal = [1.0, 0.0, 0.0] if k % 2 else spread.normal(size=3)
        old = SpaceCircle.of([30.0 + 4.0 * k, 0.0, 6.0], 0.8, normal)
        radius = None if k % 3 else 0.81
        circles.append(redraw_circle(f"c{k}", old, vmap, vmap.jacobian, radius=radius))
    usual = FeatureMap(vmap, vmap.jacobian, tuple(circles))
    xyz = np.concatenate([*around(circles, spread), spread.uniform(0.0, 60.0, (40, 3))])
    assert_same(compiled(vmap.layers, (), circles), usual, xyz)


def drawn_alike(one: RedrawnFeatures, other: RedrawnFeatures) -> bool:
    """Tell whether the same is drawn anew, to the last bit."""
    circles = [[(c.name, c.after.centre.tolist(), c.after.radius, c.carried)
                for c in each.map.circles] for each in (one, other)]  # fmt: skip
    arcs = [[(a.name, a.x, a.after.y, a.after.z, a.after.radius, a.after.floor.tolist())
             for a in each.bilges.arcs] for each in (one, other)]  # fmt: skip
    same = one.keys == other.keys and one.hosts == other.hosts
    return same and circles[0] == circles[1] and arcs[0] == arcs[1]


CONTOURED = {"fore_frame_height", "aft_frame_height"}
"""Parameters whose fields follow contours, which have no flat form: their maps stay with numpy."""


@pytest.mark.parametrize("name", ["bulk_carrier", "series60_70"])
def test_maps_of_named_parameters_have_the_bits_of_numpy(name: str, shipped: Shipped) -> None:
    """Of each parameter alone, and of several at once; what is drawn anew is the same as well."""
    state = shipped(name).state
    room, spread = AdmissibleValues.of(state, Layout(), TOLERANCE), np.random.default_rng(1)
    xyz = state.rows.xyz[state.live("rows")]
    names, found, drawn = list(room.present), 0, 0
    asks = [[each] for each in names]
    asks += [spread.choice(names, 3, replace=False).tolist() for _ in range(4)]
    for k, several in enumerate(asks):
        asked = {
            each: room.present[each] + spread.uniform(-1.0, 1.0) * 0.02 * (1.0 + room.present[each])
            for each in several
        }
        try:
            vmap = room.map(asked)
            radii = requested_radii(state, room.parent, asked, room.present)
            with mock.patch(MAY, return_value=False):
                usual = redraw_features(state, vmap, radii)
        except AssocHullError:
            continue
        with mock.patch(MAY, return_value=True):
            quick = redraw_features(state, vmap, radii)
            assert isinstance(quick.quick, CompiledMap) is CONTOURED.isdisjoint(several), several
        assert drawn_alike(usual, quick), several
        found += 1
        if not CONTOURED.isdisjoint(several):
            continue
        some = xyz[spread.integers(0, len(xyz), 25)]
        more = np.concatenate([some, some * [1.0, -1.0, 1.0], edges(vmap.regions())])
        assert_features_same(usual, more, k)
        drawn += len(usual.map.circles) + len(usual.bilges.arcs)
    assert found >= len(names) - 2
    assert drawn > 0 or name != "bulk_carrier"


# --------------------------------------------------------------------------------------
# What has no flat form.


@attrs.frozen(eq=False)
class OwnLayer:
    """A layer that a user has written."""

    name: str = "own"

    def displacement(self, xyz: FloatArray) -> FloatArray:
        return 0.01 * np.column_stack([xyz[:, 2] * 0.0, xyz[:, 1], xyz[:, 2] * 0.0])

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        return np.tile(np.diag([1.0, 1.01, 1.0]), (len(xyz), 1, 1))

    def regions(self) -> tuple[FieldRegion, ...]:
        return (FieldRegion("own", (-np.inf, np.inf), (-np.inf, np.inf)),)


@attrs.frozen(eq=False)
class OwnRake(Rake):
    """A field of a class of its own may move places otherwise than its base."""


CONTOUR = Contour(np.array([0.0, 100.0, 200.0]), np.array([0.0, 0.1, 0.0]))


@pytest.mark.parametrize(
    "layer",
    [
        OwnLayer(),
        AdditiveLayer("contour", CONTOUR),
        FieldLayer("own", (OwnRake("own", BlendChain.constant(1.0), 0.1, 5.0, 3.0),)),
    ],
    ids=["layer", "function", "field"],
)
def test_what_is_of_an_unknown_kind_stays_with_numpy(layer: Layer, shipped: Shipped) -> None:
    """The whole map does, also where other layers of it are known."""
    state, known = shipped("wigley").state, Rake("known", BlendChain.constant(1.0), 0.01, 1.0, 1.0)
    vmap = VariationMap((FieldLayer("known", (known,)), layer))
    with mock.patch(MAY, return_value=True):
        anew = redraw_features(state, vmap)
        assert anew.quick is anew.map
        assert anew.space.call is anew.map
    xyz = state.rows.xyz.data[:40]
    assert anew.space.places(xyz).tobytes() == vmap(xyz).tobytes()


def test_nothing_is_compiled_twice() -> None:
    """Whatever kind of array places come in; else some call would wait for seconds."""
    flat = FlatMap.of(())
    assert flat is not None
    quick = CompiledMap(attrs.evolve(flat, arcs=True, circles=True))
    frozen = np.ones((4, 3))
    frozen.setflags(write=False)
    for xyz in (np.ones((4, 3)), frozen, np.ones((3, 4)).T, np.ones((8, 6))[::2, ::2]):
        quick(xyz)
        quick.jacobian(xyz)
        assert not displacement_slopes_at(flat.code, flat.number, xyz).any()
    assert {len(getattr(each, "signatures", ())) for each in kernels()} == {1}
