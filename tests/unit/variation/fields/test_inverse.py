"""The inverse undoes the map, by Newton's rule or by nested bracketed roots alike."""

from __future__ import annotations

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from numpy.testing import assert_allclose

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields import space_map as module
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import (
    AffinePiece,
    FieldRegion,
    StackedField,
    level_boundaries,
)
from assoc_hull.variation.fields.layers import FieldLayer, Layer
from assoc_hull.variation.fields.space_map import VariationMap
from tests.long_forms import draws
from tests.variation_strategies import layers, maps, places


@attrs.frozen
class Wrapped:
    """A layer of a kind that the inverse does not know."""

    inner: Layer
    name: str = "wrapped"

    def displacement(self, xyz: FloatArray) -> FloatArray:
        return self.inner.displacement(xyz)

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        return self.inner.jacobian(xyz)

    def regions(self) -> tuple[FieldRegion, ...]:
        return self.inner.regions()


def collapsed() -> VariationMap:
    """All heights come to 3 m."""
    piece = AffinePiece(BlendChain.constant(-1.0), 0.0, BlendChain.constant(3.0))
    return VariationMap(
        (
            FieldLayer(
                "flat", (StackedField("flat", "z", level_boundaries(["0"], [0.0]), (piece,)),)
            ),
        )
    )


@given(vmap=maps(), xyz=places())
def test_the_inverse_undoes_the_map(vmap: VariationMap, xyz: FloatArray) -> None:
    """To 1e-12 m, through up to three layers of every kind."""
    assert_allclose(vmap.inverse(vmap(xyz)), xyz, rtol=0, atol=1e-12)


@settings(max_examples=draws(25))
@given(vmap=maps(), xyz=places())
def test_the_map_undoes_the_inverse(vmap: VariationMap, xyz: FloatArray) -> None:
    """To 1e-12 m; every place of the varied hull comes from somewhere."""
    assert_allclose(vmap(vmap.inverse(xyz)), xyz, rtol=0, atol=1e-12)


@settings(max_examples=draws(25))
@given(layer=layers(), xyz=places(12))
def test_a_layer_of_unknown_kind_is_undone(layer: Layer, xyz: FloatArray) -> None:
    """All three coordinates at once, from displacement and Jacobian alone."""
    vmap = VariationMap((Wrapped(layer),))
    assert_allclose(vmap.inverse(vmap(xyz)), xyz, rtol=0, atol=1e-12)


def test_nested_brackets_find_the_same() -> None:
    """With Newton's rule switched off, for layers of known and unknown kind."""

    @settings(max_examples=draws(25))
    @given(layer=layers(), xyz=places(6))
    def check(layer: Layer, xyz: FloatArray) -> None:
        for vmap in (VariationMap((layer,)), VariationMap((Wrapped(layer),))):
            assert_allclose(vmap.inverse(vmap(xyz)), xyz, rtol=0, atol=1e-12)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_newton", lambda layer, image, *rest: np.arange(len(image)))
        check()


@settings(max_examples=draws(25))
@given(vmap=maps(), xyz=places(20))
def test_a_place_is_undone_by_itself(vmap: VariationMap, xyz: FloatArray) -> None:
    """The same bits, whatever other places are asked with it."""
    both = vmap.inverse(xyz)
    assert (vmap.inverse(xyz[7]) == both[7:8]).all()
    assert not both.flags.writeable


def test_a_map_that_folds_is_refused() -> None:
    """The message names place, layer and what is missing."""
    with pytest.raises(BadInputError) as caught:
        collapsed().inverse([[10.0, 1.0, 3.0], [30.0, 1.0, 7.5]])
    assert str(caught.value) == (
        "inverse did not converge at (x', z') = (30.000, 7.500): 4.5 m after nested bracketing, "
        "in layer 'flat'; certify the map: one that folds has no inverse"
    )


@pytest.mark.parametrize("given_", [[[1.0, 2.0]], [[1.0, 2.0, float("nan")]], "place"])
def test_what_is_no_place_is_refused(given_: object) -> None:
    """Before any layer sees it."""
    with pytest.raises(BadInputError, match="in inverse"):
        collapsed().inverse(given_)  # type: ignore[arg-type]


def test_no_places_have_no_sources() -> None:
    """An empty array is mapped back to one."""
    assert collapsed().inverse(np.zeros((0, 3))).shape == (0, 3)
