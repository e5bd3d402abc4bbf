"""Cuts of the varied hull are made with the parent's curves, exactly and without missing any."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.variation.fields.bounded_functions import CUBIC, QUINTIC, Blend, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, Axis, StackedField, level_boundaries
from assoc_hull.variation.fields.image_intersections import intersect_images, plane_source
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.fields.space_map import VariationMap
from tests.long_forms import draws
from tests.variation_strategies import field_layers, maps, places

AXES: tuple[Axis, ...] = ("x", "y", "z")


def raised(blend: Blend = QUINTIC) -> VariationMap:
    """A plateau about a shaft raised by 1 m, full at the stern, fading forward."""
    fade = BlendChain.through([4.37, 62.0], [1.0, 0.0], blend)
    pieces = tuple(AffinePiece.along(fade, 0.0, d) for d in (0.0, 1.0, 1.0, 0.0))
    levels = level_boundaries(["base", "h-r", "h+r", "T"], [0.0, 3.27, 4.73, 10.8])
    return VariationMap((FieldLayer("S", (StackedField("S", "z", levels, pieces, blend),)),))


def hill() -> VariationMap:
    """Everything within 0.5 m of x = 100.5 m is raised, by 1 m at most."""
    course = BlendChain.through([100.0, 100.5, 101.0], [0.0, 1.0, 0.0])
    field = StackedField(
        "hill", "z", level_boundaries(["0"], [0.0]), (AffinePiece.along(course, 0.0, 1.0),)
    )
    return VariationMap((FieldLayer("hill", (field,)),))


def line(*xyz: tuple[float, float, float]) -> SplineBatch:
    """One curve through places."""
    return loft(CurveData.single(np.array(xyz, np.float64)))


def passed(
    vmap: VariationMap, batch: SplineBatch, row: int, value: float, t: FloatArray
) -> FloatArray:
    """Between which places of one curve its image changes sides, (n - 1,) 0 or 1."""
    above = vmap(evaluate(batch, np.zeros(len(t), np.int64), t))[:, row] >= value
    return np.asarray(above[1:] != above[:-1], np.float64)


@pytest.mark.parametrize("axis", AXES)
@settings(max_examples=draws(20))
@given(vmap=maps(), knots=places(5), part=st.floats(0.05, 0.95))
def test_every_crossing_is_found(
    axis: Axis, vmap: VariationMap, knots: FloatArray, part: float
) -> None:
    """An odd number wherever dense samples change sides; each in the plane and on the image."""
    batch, row = loft(CurveData.single(knots)), "xyz".index(axis)
    image = vmap(knots)[:, row]
    value = float(image.min() + part * np.ptp(image))
    found = intersect_images(vmap, batch, axis, value)
    t = np.linspace(0.0, batch.knot[-1], 5001)
    count, _ = np.histogram(found.t, t)
    assert (count % 2 == passed(vmap, batch, row, value, t)).all()
    assert_allclose(found.xyz[:, row], value, rtol=0, atol=1e-12)
    assert (vmap(evaluate(batch, found.curve, found.t)) == found.xyz).all()
    assert (np.diff(found.t) > 0.0).all()
    assert (found.sign[1:] == -found.sign[:-1]).all()


def test_two_crossings_between_two_samples_are_found() -> None:
    """A curve that passes a plane by a micrometre and comes back meets it twice."""
    arch = line((0.0, 1.0, 4.0), (5.0, 1.0, 5.0), (10.0, 1.0, 4.2))
    t = np.linspace(0.0, arch.knot[-1], 200_001)
    top = raised()(evaluate(arch, np.zeros(len(t), np.int64), t))[:, 2].max()
    found = intersect_images(raised(), arch, "z", float(top) - 1e-6)
    assert found.sign.tolist() == [1, -1]
    assert np.ptp(found.t) < 0.1
    assert len(intersect_images(raised(), arch, "z", float(top) + 1e-6).t) == 0


def test_a_narrow_region_on_a_long_segment_is_found() -> None:
    """One metre of a straight line of 240 m is raised; planes through it meet it twice."""
    found = intersect_images(hill(), line((0.0, 3.0, 5.0), (240.0, 3.0, 5.0)), "z", 5.25)
    assert found.sign.tolist() == [1, -1]
    assert_allclose(found.xyz[:, 0].mean(), 100.5, rtol=0, atol=1e-12)
    assert_allclose(QUINTIC.value(2.0 * (found.xyz[:1, 0] - 100.0)), [0.25], rtol=0, atol=1e-12)


def test_a_narrow_strip_on_a_long_segment_is_found() -> None:
    """Two centimetres of a post of 18 m are pushed forward; a plane through them meets it twice."""
    levels, full = (
        level_boundaries(["low", "middle", "high"], [5.0, 5.01, 5.02]),
        BlendChain.constant(1.0),
    )
    pieces = tuple(AffinePiece.along(full, 0.0, d) for d in (0.0, 0.5, 0.0))
    vmap = VariationMap((FieldLayer("rib", (StackedField("rib", "x", levels, pieces),)),))
    found = intersect_images(vmap, line((100.0, 0.0, 0.0), (100.0, 0.0, 18.0)), "x", 100.25)
    assert found.sign.tolist() == [1, -1]
    assert_allclose(found.xyz[:, 2], [5.005, 5.015], rtol=0, atol=1e-12)


def test_curves_of_a_batch_keep_their_own_crossings() -> None:
    """Sorted by curve; one that lies below the plane has none."""
    batch = SplineBatch.join([line((6.0, 0, 0), (6.0, 0, 18)), line((6.0, 1, 0), (6.0, 1, 2)),
                              line((90.0, 0, 18), (90.0, 0, 0))])  # fmt: skip
    found = intersect_images(raised(), batch, "z", 5.0)
    assert found.curve.tolist() == [0, 2]
    assert found.sign.tolist() == [1, -1]
    assert_allclose(found.xyz[:, 2], 5.0, rtol=0, atol=1e-13)


@settings(max_examples=draws(20))
@given(layer=field_layers(), knots=places(5), value=st.floats(2.0, 12.0))
def test_the_source_of_a_plane_cuts_the_parent_alike(
    layer: FieldLayer, knots: FloatArray, value: float
) -> None:
    """A waterplane of the varied hull comes from a cylinder: crossings lie on it."""
    vmap, batch = VariationMap((layer,)), loft(CurveData.single(knots))
    found = intersect_images(vmap, batch, "z", value)
    if len(found.t):
        before = np.asarray(evaluate(batch, found.curve, found.t))
        source = plane_source(vmap, "z", value, before)
        assert_allclose(source, before[:, 2], rtol=0, atol=2e-12)
        elsewhere = before + np.array([0.0, 7.0, 0.0])
        assert (plane_source(vmap, "z", value, elsewhere) == source).all()


@pytest.mark.parametrize("axis", AXES)
@settings(max_examples=draws(20))
@given(vmap=maps(), xyz=places(), value=st.floats(1.0, 12.0))
def test_the_source_of_a_plane_is_mapped_into_it(
    axis: Axis, vmap: VariationMap, xyz: FloatArray, value: float
) -> None:
    """Through up to three layers, also those that couple y and z."""
    row, before = "xyz".index(axis), xyz.copy()
    before[:, row] = plane_source(vmap, axis, value, xyz)
    assert_allclose(vmap(before)[:, row], value, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("blend", "height"), [(CUBIC, 6.770699679629), (QUINTIC, 6.718671220422)])
def test_the_source_of_a_plane_has_its_value(blend: Blend, height: float) -> None:
    """Of z' = 7.2 m at x = 30 m, computed beforehand; outside the region the plane itself."""
    found = plane_source(raised(blend), "z", 7.2, [[30.0, 1.0, 0.0], [62.0, 1.0, 0.0]])
    assert_allclose(found[0], height, rtol=0, atol=5e-13)
    assert found[1] == 7.2


def test_a_plane_that_is_none_is_refused() -> None:
    """The axis and the value are checked."""
    post = line((6.0, 0.0, 0.0), (6.0, 0.0, 18.0))
    with pytest.raises(BadInputError, match="axis is 'w', in cut"):
        intersect_images(raised(), post, "w", 5.0)  # type: ignore[arg-type]
    with pytest.raises(BadInputError, match="value is nan, in plane_source"):
        plane_source(raised(), "z", float("nan"), [[0.0, 0.0, 0.0]])
