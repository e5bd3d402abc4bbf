"""The map itself: identity, affine maps, derivatives, bits outside its regions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.bounded_functions import QUINTIC, Blend, BlendChain
from assoc_hull.variation.fields.field import AffinePiece, Axis, StackedField, level_boundaries
from assoc_hull.variation.fields.image_intersections import creases
from assoc_hull.variation.fields.layers import FieldLayer, Layer
from assoc_hull.variation.fields.space_map import VariationMap
from tests.long_forms import draws
from tests.variation_strategies import (
    blends,
    corner_layers,
    deadrise_layers,
    field_layers,
    fields,
    hats,
    layers,
    maps,
    places,
    rakes,
)

FULL = BlendChain.constant(1.0)
ratios = st.floats(0.5, 2.0)


def differences(layer: Layer | VariationMap, xyz: FloatArray) -> FloatArray:
    """The Jacobian by central differences over 0.1 mm."""
    step, found = 1e-4, np.zeros((len(xyz), 3, 3))
    for k in range(3):
        aside = np.eye(3)[k] * step
        ends = [
            (place if isinstance(layer, VariationMap) else place + layer.displacement(place))
            for place in (xyz + aside, xyz - aside)
        ]
        if isinstance(layer, VariationMap):
            ends = [layer(place) for place in ends]
        found[:, :, k] = (ends[0] - ends[1]) / (2.0 * step)
    return found


def smooth_places(vmap: VariationMap, xyz: FloatArray) -> FloatArray:
    """Places of which no layer has a crease within a millimetre."""
    clear, now = np.abs(xyz[:, 1]) > 1e-3, xyz
    for layer in vmap.layers:
        clear &= (np.abs(creases(layer, now)) > 1e-3).all(axis=1)
        now = now + layer.displacement(now)
    return xyz[clear]


@settings(max_examples=draws(25))
@given(field=st.one_of(fields(), hats(), rakes()), layer=field_layers(0.0), xyz=places())
def test_a_map_without_departure_is_the_identity(
    field: StackedField, layer: FieldLayer, xyz: FloatArray
) -> None:
    """To the last bit, whatever its boundaries, pivots and chains; the Jacobian too."""
    for each in (layer, FieldLayer("nil", (field.scaled(0.0),))):
        vmap = VariationMap((each,))
        assert (vmap(xyz) == xyz).all()
        assert (vmap.jacobian(xyz) == np.eye(3)).all()
        assert (vmap.inverse(xyz) == xyz).all()


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@given(ratio=ratios, blend=blends, xyz=places())
def test_one_ratio_is_an_affine_map(
    axis: Axis, ratio: float, blend: Blend, xyz: FloatArray
) -> None:
    """Length or breadth alone: the coordinate times the ratio to one unit in the last place."""
    field = StackedField(
        "all",
        axis,
        level_boundaries(["0"], [0.0]),
        (AffinePiece.along(FULL, ratio - 1.0, 0.0),),
        blend,
    )
    found, k = VariationMap((FieldLayer("main", (field,)),))(xyz), "xyz".index(axis)
    asked = xyz[:, k] * ratio
    assert (np.abs(found[:, k] - asked) <= np.spacing(np.abs(asked))).all()
    others = [i for i in range(3) if i != k]
    assert (found[:, others] == xyz[:, others]).all()


@given(ratio=st.floats(0.8, 1.25), xyz=places())
def test_the_draught_scales_what_is_immersed(ratio: float, xyz: FloatArray) -> None:
    """Up to T, the height times the ratio to one unit in the last place; a shift high above."""
    draught = 10.0
    pieces = (
        AffinePiece.along(FULL, ratio - 1.0, 0.0),
        AffinePiece.along(FULL, 0.0, draught * (ratio - 1.0)),
    )
    field = StackedField(
        "T", "z", level_boundaries(["T", "1.6 T"], [draught, 1.6 * draught]), pieces, QUINTIC
    )
    xyz = np.vstack([xyz, [[0.0, 0.0, draught]]])
    found, asked = VariationMap((FieldLayer("main", (field,)),))(xyz)[:, 2], xyz[:, 2] * ratio
    wet, high = xyz[:, 2] <= draught, xyz[:, 2] >= 1.6 * draught
    assert (np.abs(found - asked)[wet] <= np.spacing(np.abs(asked[wet]))).all()
    assert_allclose(found[high] - xyz[high, 2], draught * (ratio - 1.0), rtol=0, atol=4e-15)


@pytest.mark.parametrize("kind", [field_layers, corner_layers, deadrise_layers])
@settings(max_examples=draws(25))
@given(data=st.data(), xyz=places())
def test_the_jacobian_of_a_layer_is_its_derivative(
    kind: type, data: st.DataObject, xyz: FloatArray
) -> None:
    """By central differences, for every kind of layer."""
    layer = data.draw(kind())
    xyz = smooth_places(VariationMap((layer,)), xyz)
    assert_allclose(layer.jacobian(xyz), differences(layer, xyz), rtol=0, atol=1e-7)


@settings(max_examples=draws(25))
@given(vmap=maps(), xyz=places())
def test_the_jacobian_of_a_map_is_its_derivative(vmap: VariationMap, xyz: FloatArray) -> None:
    """By the chain rule through all layers."""
    xyz = smooth_places(vmap, xyz)
    assert_allclose(vmap.jacobian(xyz), differences(vmap, xyz), rtol=0, atol=2e-7)


@settings(max_examples=draws(25))
@given(layer=layers(), xyz=places())
def test_places_outside_the_regions_keep_their_bits(layer: Layer, xyz: FloatArray) -> None:
    """The displacement is exactly nil and the Jacobian exactly the unit matrix."""
    x, z, out = xyz[:, 0], xyz[:, 2], np.ones(len(xyz), bool)
    for region in layer.regions():
        inside = (x >= region.x[0]) & (x <= region.x[1]) & (z >= region.z[0]) & (z <= region.z[1])
        out &= ~inside
    vmap, still = VariationMap((layer,)), xyz[out]
    assert (vmap(still) == still).all()
    assert (vmap.jacobian(still) == np.eye(3)).all()
    assert (vmap.inverse(still) == still).all()


@settings(max_examples=draws(25))
@given(vmap=maps(), xyz=places())
def test_port_and_starboard_stay_mirrored(vmap: VariationMap, xyz: FloatArray) -> None:
    """To the last bit, and what lies on the centre plane stays on it."""
    mirror = np.array([1.0, -1.0, 1.0])
    assert (vmap(xyz * mirror) == vmap(xyz) * mirror).all()
    centre = xyz * [1.0, 0.0, 1.0]
    assert (vmap(centre)[:, 1] == 0.0).all()
